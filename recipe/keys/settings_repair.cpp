// The rows of the settings table about repairs before printing.
#include "recipe/keys/settings_rows.h"

namespace lamella {

namespace {

template <auto member>
void add_repair_row(std::vector<Setting>& t, const char* key, const char* flag, SettingSpec facts) {
    facts.unit = "mm";
    facts.limits = {0, 100};
    facts.fallback = format_value(RepairRecipe{}.*member);
    t.push_back(optional_row<&Recipe::repair, member>("repair", key, flag, std::move(facts)));
}

}  // namespace

void add_repair_settings(std::vector<Setting>& table) {
    using R = RepairRecipe;
    add_repair_row<&R::thickness>(
        table, "thickness", "--repair-thickness",
        {.help = "Walls thinner than this within a layer are thickened to it; 0: no change."});
    add_repair_row<&R::gap>(table, "gap", "--repair-gap",
                            {.help = "Gaps narrower than this within a layer are filled; 0: no change."});
    add_repair_row<&R::join>(
        table, "join", "--repair-join",
        {.help = "Diameter of struts that join disconnected pieces of the part; 0: pieces are not joined."});
}

}  // namespace lamella
