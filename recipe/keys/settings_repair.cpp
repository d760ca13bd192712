// The rows of the settings table about repairs before printing.
#include "recipe/keys/settings_rows.h"

namespace lamella {

namespace {

constexpr Limits lengths{0, 100};

template <auto member>
void add_repair_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    facts.unit = "mm";
    facts.fallback = format_value(RepairRecipe{}.*member);
    t.push_back(optional_row<&Recipe::repair, member>("repair", key, flag, std::move(facts)));
}

}  // namespace

void add_repair_settings(std::vector<Setting>& table) {
    using R = RepairRecipe;
    add_repair_row<&R::thickness>(
        table, "thickness", "--repair-thickness",
        {.limits = lengths,
         .help = "Walls thinner than this within a layer are thickened to it; 0: no change."});
    add_repair_row<&R::gap>(
        table, "gap", "--repair-gap",
        {.limits = lengths, .help = "Gaps narrower than this within a layer are filled; 0: no change."});
    add_repair_row<&R::join>(
        table, "join", "--repair-join",
        {.limits = lengths,
         .help = "Diameter of struts that join disconnected pieces of the part; 0: pieces are not joined."});
    add_repair_row<&R::trim>(
        table, "trim", "--repair-trim",
        {.limits = {-1, lengths.hi},
         .help =
             "Tips that begin in the air are removed up to where they join the part, if they are no higher "
             "than this or a single layer; 0: none; negative: the default, a quarter of the struts of a "
             "self-supporting skin, else 0."});
    add_repair_row<&R::hold>(
        table, "hold", "--repair-hold",
        {.limits = {-1, lengths.hi},
         .help =
             "Diameter of struts from the tips that begin in the air and stay, down to the part or the bed, "
             "within the body; 0: none; negative: the default, the struts of a self-supporting skin, else "
             "0."});
}

}  // namespace lamella
