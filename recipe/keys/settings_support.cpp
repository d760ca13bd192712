// The rows of the settings table about supports.
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(SupportKind) {
    static const std::vector<std::string> list{"none", "bridges", "pillars"};
    return list;
}

namespace {

constexpr Limits thickness{0.05, 100};
constexpr Limits amount_limits{0, 1000};

/// Adds a row of the section. Setting one enables supports unless support.kind says otherwise.
template <auto place>
void add_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    Setting s = row<place>("support", key, flag, std::move(facts));
    s.store = [](Recipe& r, std::size_t, const Value& value) {
        using Held = std::remove_reference_t<decltype(place(r))>;
        place(r) = from_value<Held>(value);
        if (r.support == SupportKind::none) r.support = SupportKind::bridges;
    };
    t.push_back(std::move(s));
}

/// Adds a row of the printer's supports.
template <auto member>
void add_support_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    constexpr auto place = [](Recipe & r) -> auto& { return r.printer.support.*member; };
    add_row<place>(t, key, flag, std::move(facts));
}

/// The overhangs to support.
void add_needs(std::vector<Setting>& t) {
    using P = SupportProfile;
    add_support_row<&P::overhang>(
        t, "overhang", "--support-overhang",
        {.unit = "mm",
         .limits = {0, 100},
         .help = "Largest overhang of a layer over the one below that needs no support; 0: half a line's "
                 "width with filament, one layer height on other machines."});
    add_support_row<&P::spacing>(
        t, "spacing", "--support-spacing",
        {.unit = "mm",
         .limits = {0.1, 100},
         .help = "Radius around a support point within which overhangs are supported."});
    add_support_row<&P::free_stretch>(
        t, "free_stretch", "--support-free-stretch",
        {.unit = "mm", .limits = amount_limits, .help = "Length of unsupported outline that is tolerated."});
    add_support_row<&P::own_bridge>(t, "own_bridge", "--support-own-bridge",
                                    {.unit = "mm",
                                     .limits = amount_limits,
                                     .help = "Longest straight span of the part, supported at both ends, "
                                             "that bridges a gap without supports."});
    add_support_row<&P::margin>(t, "margin", "--support-margin",
                                {.unit = "mm",
                                 .limits = amount_limits,
                                 .help = "Distance by which the centre of mass must lie inside the convex "
                                         "hull of the contacts with bed and supports."});
    add_support_row<&P::push>(
        t, "push", "--support-push",
        {.unit = "N", .limits = amount_limits, .help = "Sideways force that a print must withstand."});
    add_support_row<&P::adhesion>(
        t, "adhesion", "--support-adhesion",
        {.unit = "MPa", .limits = amount_limits, .help = "Strength of the bond between part and bed."});
    add_support_row<&P::bond>(t, "bond", "--support-bond",
                              {.unit = "MPa",
                               .limits = amount_limits,
                               .help = "Strength of the bond between part and support point."});
    add_support_row<&P::density>(t, "density", "--support-density",
                                 {.unit = "g/cm3", .limits = {0.01, 30}, .help = "Density of the material."});
}

/// The shape of the scaffold.
void add_shape(std::vector<Setting>& t) {
    using P = SupportProfile;
    add_support_row<&P::bridge>(
        t, "bridge", "--support-bridge",
        {.unit = "mm", .limits = {0.5, 1000}, .help = "Longest bar between two pillars."});
    add_support_row<&P::bar_width>(t, "bar_width", "--support-bar-width",
                                   {.unit = "mm", .limits = thickness, .help = "Width of a bar."});
    add_support_row<&P::bar_height>(t, "bar_height", "--support-bar-height",
                                    {.unit = "mm", .limits = thickness, .help = "Height of a bar."});
    add_support_row<&P::connector>(
        t, "connector", "--support-connector",
        {.unit = "mm", .limits = {0.1, 1000}, .help = "Minimum height of a connector."});
    add_support_row<&P::longest_connector>(
        t, "longest_connector", "--support-longest-connector",
        {.unit = "mm", .limits = {0.2, 1000}, .help = "Maximum height of a connector on a bar."});
    add_support_row<&P::reach>(
        t, "reach", "--support-reach",
        {.unit = "mm", .limits = {0.01, 1000}, .help = "Largest sideways offset of a connector."});
    add_support_row<&P::tip>(
        t, "tip", "--support-tip",
        {.unit = "mm", .limits = thickness, .help = "Diameter of a connector where it meets the part."});
    add_support_row<&P::gap>(
        t, "gap", "--support-gap",
        {.unit = "mm", .limits = {0, 100}, .help = "Gap between the tip of a connector and the part."});
    add_support_row<&P::clearance>(t, "clearance", "--support-clearance",
                                   {.unit = "mm",
                                    .limits = {0, 100},
                                    .help = "Distance between part and supports, except at contacts."});
    add_support_row<&P::pillar>(
        t, "pillar", "--support-pillar",
        {.unit = "mm",
         .limits = thickness,
         .help = "Width of a pillar: the diameter of a round one, the arms of a cross."});
    add_support_row<&P::round_pillars>(t, "round_pillars", "--support-round-pillars",
                                       {.help = "Round pillars instead of crosses of two walls."});
    add_support_row<&P::wall>(
        t, "wall", "--support-wall",
        {.unit = "mm", .limits = {0, 100}, .help = "Thickness of a cross's walls; 0: a line's width."});
    add_support_row<&P::foot>(t, "foot", "--support-foot",
                              {.unit = "mm", .limits = {0.05, 1000}, .help = "Diameter of a pillar's foot."});
    add_support_row<&P::foot_height>(
        t, "foot_height", "--support-foot-height",
        {.unit = "mm", .limits = {0.01, 100}, .help = "Height of a pillar's foot."});
    add_support_row<&P::lift>(
        t, "lift", "--support-lift",
        {.unit = "mm",
         .limits = amount_limits,
         .help = "Height by which the part is raised above the bed, carried by supports alone."});
}

/// The way supports are printed.
void add_printing(std::vector<Setting>& t) {
    using P = SupportProfile;
    add_support_row<&P::speed>(
        t, "speed", "--support-speed",
        {.unit = "mm/s", .limits = {0.1, 2000}, .help = "Speed of printing supports."});
    add_support_row<&P::grey>(
        t, "grey", "--support-grey",
        {.limits = {0, 1}, .help = "Grey value of supports in image stacks; 1: white like the part."});
}

/// The tools that make supports.
void add_tools(std::vector<Setting>& t) {
    add_row < [](Recipe & r) -> auto& { return r.support_tools.tool; }
    > (t, "tool", "--support-tool",
       {.fallback = "that of the part", .help = "Name of the [[tool]] that makes the supports."});
    add_row < [](Recipe & r) -> auto& { return r.support_tools.interface_tool; }
    > (t, "interface_tool", "--support-interface-tool",
       {.fallback = "support.tool",
        .help = "Name of the [[tool]] that makes supports near the part, such as one of soluble filament."});
    add_row < [](Recipe & r) -> auto& { return r.support_tools.interface; }
    > (t, "interface", "--support-interface",
       {.unit = "mm",
        .limits = {0.01, 1000},
        .fallback = "1",
        .help = "Distance from the part within which interface_tool makes the supports."});
}

}  // namespace

void add_support_settings(std::vector<Setting>& table) {
    table.push_back(row<[](Recipe & r) -> auto& { return r.support; }>(
        "support", "kind", "--support",
        {.fallback = "bridges in [support], else none",
         .help = "Kind of supports: bars on pillars (bridges), or a pillar under every support point."}));
    add_needs(table);
    add_shape(table);
    add_printing(table);
    add_tools(table);
}

}  // namespace lamella
