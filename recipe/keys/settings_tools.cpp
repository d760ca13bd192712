// The rows of the settings table about tools (extruders) and the tower in which they are purged.
#include "recipe/keys/settings_rows.h"

namespace lamella {

namespace {

constexpr Limits degrees{0, 500};

/// Makes a row of the [[tool]] entries, which are part of the machine.
template <auto member>
void add_tool_row(std::vector<Setting>& t, const char* key, SettingSpec facts) {
    using Held = std::remove_reference_t<decltype(std::declval<ToolProfile&>().*member)>;
    Setting s = described<Held>("tool", key, "", std::move(facts));
    s.store = [](Recipe& r, std::size_t entry, const Value& value) {
        std::vector<ToolProfile>& tools = r.printer.tools;
        if (tools.size() <= entry) tools.resize(entry + 1);
        tools[entry].*member = from_value<Held>(value);
    };
    s.load = [](const Recipe& r, std::size_t entry) {
        const std::vector<ToolProfile>& tools = r.printer.tools;
        return to_value<Held>(entry < tools.size() ? tools[entry].*member : ToolProfile{}.*member);
    };
    t.push_back(std::move(s));
}

template <auto member>
void add_purge_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    constexpr auto place = [](Recipe & r) -> auto& { return r.printer.purge.*member; };
    t.push_back(row<place>("purge", key, flag, std::move(facts)));
}

}  // namespace

void add_tool_settings(std::vector<Setting>& t) {
    using T = ToolProfile;
    add_tool_row<&T::name>(
        t, "name",
        {.fallback = "required", .help = "Name, for part, foam, skin, support and regions to use."});
    add_tool_row<&T::nozzle_temperature>(t, "nozzle_temperature",
                                         {.unit = "degrees Celsius",
                                          .limits = degrees,
                                          .fallback = "printer.nozzle_temperature",
                                          .help = "Temperature of the nozzle with this tool."});
    add_tool_row<&T::first_layer_nozzle_temperature>(
        t, "first_layer_nozzle_temperature",
        {.unit = "degrees Celsius",
         .limits = degrees,
         .fallback = "as for other layers",
         .help = "Temperature of the nozzle with this tool in the first layer."});
    add_tool_row<&T::standby_temperature>(
        t, "standby_temperature",
        {.unit = "degrees Celsius",
         .limits = degrees,
         .fallback = "it stays hot",
         .help = "Temperature while other tools print, for machines with a nozzle for each tool."});
    add_tool_row<&T::density>(t, "density",
                              {.unit = "g/cm3",
                               .limits = {0, 30},
                               .fallback = "support.density",
                               .help = "Density of the tool's filament, for its weight in the file."});
}

void add_purge_settings(std::vector<Setting>& t) {
    using P = PurgeProfile;
    add_purge_row<&P::volume>(
        t, "volume", "--purge-volume",
        {.unit = "mm3",
         .limits = {0, 1000},
         .fallback = format_value(P{}.volume),
         .help = "Volume extruded into the tower after each change of tools; 0: no tower."});
    add_purge_row<&P::width>(t, "width", "--purge-width",
                             {.unit = "mm",
                              .limits = {1, 1000},
                              .fallback = format_value(P{}.width),
                              .help = "Width of the tower along x; its depth follows from the volume."});
    add_purge_row<&P::gap>(t, "gap", "--purge-gap",
                           {.unit = "mm",
                            .limits = {0, 1000},
                            .fallback = format_value(P{}.gap),
                            .help = "Gap between part and tower."});
    add_purge_row<&P::density>(t, "density", "--purge-density",
                               {.limits = {0.05, 1},
                                .fallback = format_value(P{}.density),
                                .help = "Filled share of the tower where nothing is purged."});
}

}  // namespace lamella
