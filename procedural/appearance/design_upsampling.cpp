// Bilinear interpolation by position, over free elements.
#include "procedural/appearance/design_upsampling.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/base/error.h"
#include "procedural/optimization/design_grid.h"

namespace lamella {
namespace {

/// Two neighbours along an axis and their shares.
struct Neighbours {
    std::array<int, 2> at;
    std::array<double, 2> share;
};

/// Returns the coarse elements about the centre of a fine one. Positions are whole quarters of a coarse
/// element, so the arithmetic is exact.
Neighbours neighbours_of(int fine, int fine_count, int coarse_count) {
    const double place = 0.25 * (2 * fine + 1 - fine_count) + 0.5 * (coarse_count - 1);
    const int below = static_cast<int>(place + 1) - 1;  // place is above -1
    const double share = place - below;
    const auto inside = [&](int i) { return std::clamp(i, 0, coarse_count - 1); };
    return {{inside(below), inside(below + 1)}, {1 - share, share}};
}

}  // namespace

glm::ivec3 halved_size(glm::ivec3 size) { return {(size.x + 1) / 2, (size.y + 1) / 2, 1}; }

std::vector<double> upsampled_design(const PlaneDesign& coarse, glm::ivec3 size,
                                     std::span<const ElementUse> use, double otherwise) {
    if (coarse.size != halved_size(size))
        throw InputError("a design of " + std::to_string(coarse.size.x) + " x " +
                         std::to_string(coarse.size.y) + " elements; expected half of " +
                         std::to_string(size.x) + " x " + std::to_string(size.y));
    const auto count = [](glm::ivec3 s) {
        return static_cast<std::size_t>(s.x) * static_cast<std::size_t>(s.y);
    };
    if (coarse.use.size() != count(coarse.size) || coarse.values.size() != count(coarse.size) ||
        use.size() != count(size))
        throw InputError("a design has another number of elements than its grid");
    std::vector<double> fine(use.size(), 0.0);
    std::size_t element = 0;
    for (int y = 0; y < size.y; ++y) {
        const Neighbours rows = neighbours_of(y, size.y, coarse.size.y);
        for (int x = 0; x < size.x; ++x, ++element) {
            if (use[element] != ElementUse::free) continue;
            const Neighbours columns = neighbours_of(x, size.x, coarse.size.x);
            double sum = 0, weight = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto place =
                    static_cast<std::size_t>(rows.at[k / 2]) * static_cast<std::size_t>(coarse.size.x) +
                    static_cast<std::size_t>(columns.at[k % 2]);
                if (coarse.use[place] != ElementUse::free) continue;
                const double share = rows.share[k / 2] * columns.share[k % 2];
                sum += share * coarse.values[place];
                weight += share;
            }
            fine[element] = weight > 0 ? sum / weight : otherwise;
        }
    }
    return fine;
}

}  // namespace lamella
