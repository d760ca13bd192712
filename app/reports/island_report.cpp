// Formats islands as JSON and as a sentence.
#include "app/reports/island_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "recipe/build/json_triple.h"

namespace lamella {

namespace {

nlohmann::ordered_json island_json(const Island& island) {
    return {{"volume_mm3", island.volume},
            {"box_mm", {{"lo", json_triple(island.box.lo)}, {"hi", json_triple(island.box.hi)}}},
            {"first_layer", island.first_layer},
            {"end_layer", island.end_layer},
            {"dropped", island.dropped}};
}

}  // namespace

nlohmann::ordered_json islands_json(const IslandReport& islands) {
    auto largest = nlohmann::ordered_json::array();
    for (const Island& island : islands.largest) largest.push_back(island_json(island));
    return {{"components", islands.components},
            {"bodies", islands.bodies},
            {"islands", islands.count},
            {"too_large_to_drop", islands.too_large},
            {"island_volume_mm3", islands.volume},
            {"part_volume_mm3", islands.part_volume},
            {"largest", std::move(largest)}};
}

std::string islands_text(const IslandReport& islands) {
    if (islands.count == 0) return "nothing floats free";
    std::string text = fmt::format("{} of {:.3f} mm3 {} free", islands.count, islands.volume,
                                   islands.count == 1 ? "floats" : "float");
    if (!islands.largest.empty()) {
        const Island& island = islands.largest.front();
        const dvec3 middle = island.box.center();
        text += fmt::format(", the largest, of {:.3f} mm3, about ({:.2f}, {:.2f}, {:.2f}) mm", island.volume,
                            middle.x, middle.y, middle.z);
    }
    if (islands.too_large > 0) {
        text += fmt::format("; {} too large to be debris {} left", islands.too_large,
                            islands.too_large == 1 ? "is" : "are");
    }
    return text;
}

}  // namespace lamella
