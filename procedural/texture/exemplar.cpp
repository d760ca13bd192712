// Exact distances at the picture's own resolution, then means over pixels of the grid.
#include "procedural/texture/exemplar.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "procedural/skin/raster.h"

namespace lamella {

namespace {

/// Returns the pixels of an image that are solid, or not, with its border repeated on a margin all around.
TiledMask with_margin(const GreyImage& image, bool solid, int margin) {
    TiledMask mask(image.width + 2 * margin, image.height + 2 * margin);
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            const std::size_t at = image.index(std::clamp(x - margin, 0, image.width - 1),
                                               std::clamp(y - margin, 0, image.height - 1));
            mask.marked[mask.index(x, y)] = (image.values[at] >= 0.5) == solid ? 1 : 0;
        }
    }
    return mask;
}

}  // namespace

Exemplar make_exemplar(const GreyImage& black_and_white, int width) {
    const GreyImage& image = black_and_white;
    if (width > image.width)
        throw InputError("an exemplar of " + std::to_string(width) + " pixels of a picture of " +
                         std::to_string(image.width) + "; expected no more than it has");
    Exemplar exemplar{box_filtered(image, width), GreyImage(image.width, image.height)};
    const double pixels = static_cast<double>(image.width) / width;  // of the picture in one of the grid
    const double limit = Exemplar::reach * pixels;
    const int margin = static_cast<int>(std::ceil(limit)) + 1;
    const TiledMask solid = with_margin(image, true, margin);
    const auto to_solid = squared_distances(solid),
               to_void = squared_distances(with_margin(image, false, margin));
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = solid.index(x + margin, y + margin);
            const bool is_solid = solid.marked[at] != 0;
            const double away = std::sqrt(static_cast<double>(is_solid ? to_void[at] : to_solid[at])) - 0.5;
            exemplar.distance.values[image.index(x, y)] =
                std::clamp(0.5 + 0.5 * (is_solid ? away : -away) / limit, 0.0, 1.0);
        }
    }
    exemplar.distance = box_filtered(exemplar.distance, width);
    exemplar.parts.push_back({0, exemplar.solid.width, exemplar.solid.height});
    return exemplar;
}

Exemplar stacked(const std::vector<Exemplar>& parts, std::vector<float> weights) {
    if (parts.size() < 2 || weights.empty() || weights.size() % parts.size() != 0)
        throw InputError("weights of " + std::to_string(weights.size()) +
                         " sites and parts; expected some of " + std::to_string(parts.size()) +
                         " parts each");
    Exemplar all;
    int width = 0, height = 0;
    for (const Exemplar& part : parts) {
        all.parts.push_back({height, part.solid.width, part.solid.height, 0});
        width = std::max(width, part.solid.width);
        height += part.solid.height;
    }
    all.solid = all.distance = GreyImage(width, height);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const ExemplarPart& part = all.parts[p];
        for (int y = 0; y < part.height; ++y) {
            for (int x = 0; x < part.width; ++x) {
                const std::size_t from = parts[p].solid.index(x, y),
                                  to = all.solid.index(x, part.first_row + y);
                all.solid.values[to] = parts[p].solid.values[from];
                all.distance.values[to] = parts[p].distance.values[from];
            }
        }
    }
    const std::size_t count = weights.size() / parts.size();
    const auto sites = static_cast<double>(count);
    for (std::size_t i = 0; i < weights.size(); ++i)
        all.parts[i % parts.size()].weight += static_cast<double>(weights[i]) / sites;
    all.weights = std::move(weights);
    return all;
}

double mean_of(const GreyImage& image) {
    return std::accumulate(image.values.begin(), image.values.end(), 0.0) /
           static_cast<double>(image.values.size());
}

}  // namespace lamella
