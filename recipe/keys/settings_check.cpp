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
void add_size(std::vector<Setting>& t, const char* key, const char* flag, const std::string& unit,
              const std::string& what, const std::string& usual) {
    add_check_row<member>(t, key, flag,
                          {.unit = unit,
                           .limits = unit == "mm" ? size_limits : volume_limits,
                           .help = what + "; negative: the default, " + usual + "."});
}

template <std::size_t check>
void add_concern(std::vector<Setting>& t) {
    static constexpr auto place = [](Recipe & r) -> auto& { return r.printer.check.concerns[check]; };
    const auto which = static_cast<Check>(check);
    const std::string key = check_name(which);
    std::string flag = "--check-" + key;
    for (char& c : flag) c = c == '_' ? '-' : c;
    t.push_back(row<place>("check", key, flag, {.help = "Severity when " + check_fault(which) + "."}));
}

template <std::size_t... checks>
void add_concerns(std::vector<Setting>& t, std::index_sequence<checks...> /*all*/) {
    (add_concern<checks>(t), ...);
}

void add_sizes(std::vector<Setting>& t) {
    using C = CheckProfile;
    add_size<&C::min_piece>(t, "least_piece", "--check-least-piece", "mm3",
                            "Minimum volume of a loose piece that is a fault",
                            "a dot of the nozzle for filament, a cube of a pixel's side for resin, 0.001 for "
                            "powder, else 0");
    add_size<&C::min_island>(
        t, "least_island", "--check-least-island", "mm2",
        "Minimum area of an island that is a fault, unless it is higher than it is wide; a "
        "smaller one joins the part above",
        "a square of the nozzle's width for filament, of half the least thickness for "
        "resin, else 0");
    add_size<&C::min_thickness>(
        t, "least_thickness", "--check-least-thickness", "mm",
        "Minimum thickness of walls and struts within layers",
        "the nozzle's width for filament, 0.4 or two pixels for resin, 0.8 for powder, 1 for sheets");
    add_size<&C::min_thickness_up>(t, "least_thickness_up", "--check-least-thickness-up", "mm",
                                   "Minimum thickness along z; 0: each layer is checked alone",
                                   "0.8 for powder, else 0");
    add_size<&C::min_gap>(t, "least_gap", "--check-least-gap", "mm", "Minimum width of gaps within layers",
                          "the nozzle's width for filament, 0.5 or two pixels for resin, 0.5 for powder, the "
                          "kerf or 0.2 for sheets");
    add_size<&C::min_gap_up>(t, "least_gap_up", "--check-least-gap-up", "mm",
                             "Minimum width of gaps along z; 0: each layer is checked alone",
                             "0.5 for powder, else 0");
    add_size<&C::min_neck>(t, "least_neck", "--check-least-neck", "mm",
                           "Minimum thickness of necks between large parts",
                           "two lines for filament, 0.6 for resin, 2 for powder and sheets");
    add_size<&C::large_part>(t, "large_part", "--check-large-part", "mm3", "Minimum volume of a large part",
                             "1000");
    add_size<&C::min_cavity>(t, "least_cavity", "--check-least-cavity", "mm3",
                             "Minimum volume of a closed void that is a fault", "1");
    add_size<&C::min_cup>(t, "least_cup", "--check-least-cup", "mm3",
                          "Minimum volume of a suction cup that is a fault", "10");
    add_size<&C::max_peel>(t, "most_peel", "--check-most-peel", "",
                           "Maximum area peeled off the vat's film at once, over the area of a section that "
                           "carries the pull",
                           "60");
}

}  // namespace

void add_check_settings(std::vector<Setting>& table) {
    using C = CheckProfile;
    add_check_row<&C::process>(table, "process", "--check-process",
                               {.help = "Manufacturing process, which decides the default limits and "
                                        "severities; usual: that of the machine's kind, resin for png."});
    add_check_row<&C::pitch>(table, "pitch", "--check-pitch",
                             {.unit = "mm",
                              .limits = {0, 100},
                              .help = "Row spacing of a check; 0: a fifth of the smallest limit, or a value "
                                      "near it that puts the rows on lines of the masks."});
    add_check_row<&C::places>(
        table, "places", "--check-places",
        {.limits = {1, 1000}, .help = "Number of faults of each kind that are reported, the worst first."});
    add_sizes(table);
    add_concerns(table, std::make_index_sequence<check_count>());
}

}  // namespace lamella
