// Walks along the runs of equal layers.
#include "printers/common/layer_heights.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"

namespace lamella {

namespace {

/// Whether the layers of a range, without its first `skipped`, have one height.
bool are_equal(const LayerPlan& layers, LayerRange range, int skipped) {
    if (layers.equal() || range.count() <= skipped + 1) return true;
    int first = 0;
    for (const EqualLayers& run : layers.runs()) {
        if (range.first + skipped < first + run.count) return range.last <= first + run.count;
        first += run.count;
    }
    return true;
}

}  // namespace

void check_layer_heights(LayerHeights allowed, const LayerPlan& layers, LayerRange range,
                         std::string_view format) {
    if (allowed == LayerHeights::any || are_equal(layers, range, allowed == LayerHeights::first ? 1 : 0))
        return;
    throw InputError(
        fmt::format("[layers]: heights of {}, but {} has layers of one height{}; accepted: layers.height{}",
                    layers.heights_text(), format, allowed == LayerHeights::first ? " above the first" : "",
                    allowed == LayerHeights::first ? " and layers.first" : " alone"));
}

double equal_layer_height(const LayerPlan& layers, LayerRange range, std::string_view format) {
    check_layer_heights(LayerHeights::equal, layers, range, format);
    return layers.height(range.first);
}

nlohmann::ordered_json layer_heights_json(const LayerPlan& layers) {
    if (layers.equal()) return layers.least_height();
    auto runs = nlohmann::ordered_json::array();
    for (const EqualLayers& run : layers.runs()) runs.push_back({run.count, run.height});
    return runs;
}

}  // namespace lamella
