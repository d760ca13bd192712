// The rows of the settings table about print checks: the machine's limits, and the severity of each fault.
#include "recipe/keys/check_words.h"
#include "recipe/keys/settings_rows.h"

namespace lamella {

const std::vector<std::string>& choice_names(Process) {
    static const std::vector<std::string> list{"usual", "filament", "resin", "powder", "cutting"};
    return list;
}
const std::vector<std::string>& choice_names(SeverityOverride) {
    static const std::vector<std::string> list{"usual", "off", "warn", "fail"};
    return list;
}

namespace {

constexpr Limits size_limits{-1, 1000};
constexpr Limits volume_limits{-1, 1e9};

template <auto member>
void add_check_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    static constexpr auto place = [](Recipe & r) -> auto& { return r.printer.check.*member; };
    t.push_back(row<place>("check", key, flag, std::move(facts)));
}

/// Adds a size. A negative value selects the default, which `usual` describes.
template <auto member>
void add_size(std::vector<Setting>& t, const char* key, const char* flag, bool is_volume,
              const std::string& what, const std::string& usual) {
    add_check_row<member>(t, key, flag,
                          {.unit = is_volume ? "mm3" : "mm",
                           .limits = is_volume ? volume_limits : size_limits,
                           .help = what + "; negative: as usual, " + usual + "."});
}

template <std::size_t check>
void add_concern(std::vector<Setting>& t) {
    static constexpr auto place = [](Recipe & r) -> auto& { return r.printer.check.concerns[check]; };
    const auto which = static_cast<Check>(check);
    const std::string key = check_name(which);
    std::string flag = "--check-" + key;
    for (char& c : flag) c = c == '_' ? '-' : c;
    t.push_back(
        row<place>("check", key, flag, {.help = "What it comes to where " + check_fault(which) + "."}));
}

template <std::size_t... checks>
void add_concerns(std::vector<Setting>& t, std::index_sequence<checks...> /*all*/) {
    (add_concern<checks>(t), ...);
}

void add_sizes(std::vector<Setting>& t) {
    using C = CheckProfile;
    add_size<&C::min_thickness>(t, "least_thickness", "--check-least-thickness", false,
                                "Least thickness of walls and struts within layers",
                                "of filament the nozzle's width, of resin 0.4 or two pixels, of powder "
                                "0.8, of sheets 1");
    add_size<&C::min_thickness_up>(t, "least_thickness_up", "--check-least-thickness-up", false,
                                   "Least thickness upright, 0: layers are looked at one by one",
                                   "of powder 0.8, else 0");
    add_size<&C::min_gap>(t, "least_gap", "--check-least-gap", false, "Least width of void within layers",
                          "of filament the nozzle's width, of resin 0.5 or two pixels, of powder 0.5, of "
                          "sheets the kerf or 0.2");
    add_size<&C::min_gap_up>(t, "least_gap_up", "--check-least-gap-up", false,
                             "Least width of void upright, 0: layers are looked at one by one",
                             "of powder 0.5, else 0");
    add_size<&C::min_neck>(t, "least_neck", "--check-least-neck", false,
                           "Least thickness of what joins large parts",
                           "of filament two lines, of resin 0.6, of powder and sheets 2");
    add_size<&C::large_part>(t, "large_part", "--check-large-part", true, "Volume from which a part is large",
                             "1000");
    add_size<&C::min_cavity>(t, "least_cavity", "--check-least-cavity", true,
                             "Volume from which a closed void matters", "1");
    add_size<&C::min_cup>(t, "least_cup", "--check-least-cup", true,
                          "Volume from which a suction cup matters", "10");
}

}  // namespace

void add_check_settings(std::vector<Setting>& table) {
    using C = CheckProfile;
    add_check_row<&C::process>(
        table, "process", "--check-process",
        {.help = "How the machine makes parts, which decides what matters and all that is usual; usual: as "
                 "its kind says, png being resin."});
    add_check_row<&C::pitch>(
        table, "pitch", "--check-pitch",
        {.unit = "mm",
         .limits = {0, 100},
         .help = "Distance of the rows that a check looks at; 0: a fifth of the least size, "
                 "or the nearest that puts them on lines that masks are made of."});
    add_check_row<&C::places>(
        table, "places", "--check-places",
        {.limits = {1, 1000}, .help = "Faults of each kind that are told of, the worst."});
    add_sizes(table);
    add_concerns(table, std::make_index_sequence<check_count>());
}

}  // namespace lamella
