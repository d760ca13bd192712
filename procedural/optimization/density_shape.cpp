// Trilinear samples inside elements, counted.
#include "procedural/optimization/density_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/disjoint_sets.h"
#include "engine/base/parallel.h"

namespace lamella {

namespace {

/// Samples along an axis: 4 in space, 8 in the plane.
int samples_along(glm::ivec3 size) { return size.z == 1 ? 8 : 4; }

/// Where a sample lies along an axis: between two neighbouring centres, at this share of the way.
struct Between {
    std::size_t first;
    double share;
};

/// Calls visit(density) for the samples of an element.
template <typename Visit>
void for_each_sample(const DensityGrid& grid, glm::ivec3 element, const Visit& visit) {
    const int count = samples_along(grid.size), planes = grid.size.z == 1 ? 1 : count;
    std::array<double, 27> near{};
    for (int k = 0; k < 27; ++k) {
        glm::ivec3 at = element + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        at = glm::clamp(at, glm::ivec3(0), grid.size - 1);
        near[static_cast<std::size_t>(k)] = grid.density[grid.place(at)];
    }
    const auto split = [&](int i) {
        const double at = (i + 0.5) / count - 0.5;  // from the centre
        return at < 0 ? Between{0, at + 1} : Between{1, at};
    };
    for (int k = 0; k < planes; ++k) {
        const Between z = planes == 1 ? Between{1, 0} : split(k);
        for (int j = 0; j < count; ++j) {
            const Between y = split(j);
            for (int i = 0; i < count; ++i) {
                const Between x = split(i);
                const auto along = [&](std::size_t b, std::size_t c) {
                    const std::size_t first = x.first + 3 * b + 9 * c;
                    return near[first] + x.share * (near[first + 1] - near[first]);
                };
                const auto in_plane = [&](std::size_t c) {
                    const double below = along(y.first, c);
                    return below + y.share * (along(y.first + 1, c) - below);
                };
                const double below = in_plane(z.first);
                visit(z.share == 0 ? below : below + z.share * (in_plane(z.first + 1) - below));
            }
        }
    }
}

bool in_body(ElementUse use) { return use != ElementUse::outside; }

}  // namespace

void extend_outside(DensityGrid& grid, int layers) {
    std::vector<std::uint8_t> known(grid.use.size());
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = in_body(grid.use[i]);
    for (int layer = 0; layer < layers; ++layer) {
        std::vector<std::uint8_t> now = known;
        for (std::size_t i = 0; i < known.size(); ++i) {
            if (known[i] != 0) continue;
            const glm::ivec3 at = grid.element(i);
            double sum = 0;
            int count = 0;
            for (int k = 0; k < 27; ++k) {
                const glm::ivec3 other = at + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
                if (glm::clamp(other, glm::ivec3(0), grid.size - 1) != other) continue;
                const std::size_t place = grid.place(other);
                if (known[place] == 0) continue;
                sum += grid.density[place];
                ++count;
            }
            if (count == 0) continue;
            grid.density[i] = sum / count;
            now[i] = 1;
        }
        known = std::move(now);
    }
}

namespace {

/// How many parts an element has along each axis.
glm::ivec3 parts_along(glm::ivec3 size, int factor) { return {factor, factor, size.z == 1 ? 1 : factor}; }

/// The weights of four centres in a row.
struct Taps {
    int first = 0;
    std::array<double, 4> weights{};
};

/// Returns the taps at `at`, elements from the first centre.
Taps taps_at(double at, Interpolation method) {
    const double floor = std::floor(at), t = at - floor;
    Taps taps{static_cast<int>(floor) - 1, {0, 1 - t, t, 0}};
    if (method == Interpolation::cubic) {
        taps.weights = {0.5 * t * (t * (2 - t) - 1), 0.5 * (t * t * (3 * t - 5) + 2),
                        0.5 * t * (t * (4 - 3 * t) + 1), 0.5 * t * t * (t - 1)};
    }
    return taps;
}

/// Returns the weighted sum of the densities at 4 x 4 x 4 centres; beyond the grid they are those at its
/// border.
double tapped(const DensityGrid& grid, const std::array<Taps, 3>& along) {
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t j = 0; j < 4; ++j) {
            for (std::size_t i = 0; i < 4; ++i) {
                const double share = along[0].weights[i] * along[1].weights[j] * along[2].weights[k];
                if (share == 0) continue;
                const glm::ivec3 tap(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
                const glm::ivec3 centre(along[0].first, along[1].first, along[2].first);
                sum +=
                    share * grid.density[grid.place(glm::clamp(centre + tap, glm::ivec3(0), grid.size - 1))];
            }
        }
    }
    return sum;
}

}  // namespace

DensityGrid refined(const DensityGrid& grid, int factor, Interpolation method) {
    const glm::ivec3 parts = parts_along(grid.size, factor);
    DensityGrid fine{grid.size * parts, {}, {}};
    const std::size_t count = fine.place({0, 0, fine.size.z});
    fine.use.resize(count);
    fine.density.resize(count);
    parallel_for(fine.size.y * fine.size.z, [&](int row) {
        for (int x = 0; x < fine.size.x; ++x) {
            const glm::ivec3 at(x, row % fine.size.y, row / fine.size.y);
            std::array<Taps, 3> along;
            for (int axis = 0; axis < 3; ++axis)
                along[static_cast<std::size_t>(axis)] = taps_at((at[axis] + 0.5) / parts[axis] - 0.5, method);
            const double density = tapped(grid, along);
            fine.density[fine.place(at)] =
                method == Interpolation::cubic ? std::clamp(density, 0.0, 1.0) : density;
            fine.use[fine.place(at)] = grid.use[grid.place(at / parts)];
        }
    });
    return fine;
}

std::vector<double> coarsened(std::span<const double> values, glm::ivec3 size, int factor) {
    const glm::ivec3 parts = parts_along(size, factor);
    const DensityGrid grid{size, {}, {}}, fine{size * parts, {}, {}};
    std::vector<double> means(grid.place({0, 0, size.z}));
    parallel_for(means.size(), [&](std::size_t i) {
        const glm::ivec3 first = grid.element(i) * parts;
        double sum = 0;
        for (int z = 0; z < parts.z; ++z) {
            for (int y = 0; y < parts.y; ++y) {
                for (int x = 0; x < parts.x; ++x) sum += values[fine.place(first + glm::ivec3(x, y, z))];
            }
        }
        means[i] = sum / (parts.x * parts.y * parts.z);
    });
    return means;
}

double volume_keeping_level(const DensityGrid& grid, double share) {
    constexpr int bins = 1 << 14;
    std::vector<std::vector<std::int64_t>> counts(static_cast<std::size_t>(grid.size.z));
    parallel_for(grid.size.z, [&](int z) {
        auto& mine = counts[static_cast<std::size_t>(z)];
        mine.assign(bins, 0);
        for (int y = 0; y < grid.size.y; ++y) {
            for (int x = 0; x < grid.size.x; ++x) {
                if (!in_body(grid.use[grid.place({x, y, z})])) continue;
                for_each_sample(grid, {x, y, z}, [&](double density) {
                    ++mine[static_cast<std::size_t>(std::clamp(density * bins, 0.0, bins - 1.0))];
                });
            }
        }
    });
    std::vector<std::int64_t> sum(bins);
    std::int64_t total = 0;
    for (const auto& plane : counts) {
        for (std::size_t b = 0; b < plane.size(); ++b) sum[b] += plane[b], total += plane[b];
    }
    const double wanted = share * static_cast<double>(total);
    std::int64_t above = 0;
    for (std::size_t b = bins; b-- > 0;) {
        if (static_cast<double>(above + sum[b]) >= wanted) {
            // Samples of a bin count as spread evenly over it.
            const double part =
                sum[b] == 0 ? 0 : (wanted - static_cast<double>(above)) / static_cast<double>(sum[b]);
            return (static_cast<double>(b) + 1 - part) / bins;
        }
        above += sum[b];
    }
    return 0;
}

std::vector<double> solid_shares(const DensityGrid& grid, double level) {
    std::vector<double> shares(grid.density.size());
    parallel_for(grid.size.y * grid.size.z, [&](int row) {
        for (int x = 0; x < grid.size.x; ++x) {
            const glm::ivec3 at(x, row % grid.size.y, row / grid.size.y);
            const std::size_t place = grid.place(at);
            if (!in_body(grid.use[place])) continue;
            int solid = 0, count = 0;
            for_each_sample(grid, at, [&](double density) {
                solid += density > level ? 1 : 0;
                ++count;
            });
            shares[place] = static_cast<double>(solid) / count;
        }
    });
    return shares;
}

double solid_volume(const DensityGrid& grid, double level) {
    double sum = 0, elements = 0;
    for (const double share : solid_shares(grid, level)) sum += share;
    for (const ElementUse use : grid.use) elements += in_body(use) ? 1 : 0;
    return sum / elements;
}

std::vector<std::int32_t> pieces_by_faces(glm::ivec3 size, const std::function<bool(std::size_t)>& is_solid) {
    const auto x_step = std::size_t{1}, y_step = static_cast<std::size_t>(size.x),
               z_step = y_step * static_cast<std::size_t>(size.y);
    const std::size_t count = z_step * static_cast<std::size_t>(size.z);
    std::vector<std::uint8_t> solid(count);
    for (std::size_t i = 0; i < count; ++i) solid[i] = is_solid(i);
    DisjointSets sets(count);
    std::size_t i = 0;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x, ++i) {
                if (solid[i] == 0) continue;
                const auto join = [&](std::size_t step) {
                    if (solid[i - step] != 0)
                        sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i - step));
                };
                if (x > 0) join(x_step);
                if (y > 0) join(y_step);
                if (z > 0) join(z_step);
            }
        }
    }
    std::vector<std::int32_t> number(count, -1), piece(count, -1);
    std::int32_t next = 0;
    for (std::size_t e = 0; e < count; ++e) {
        if (solid[e] == 0) continue;
        std::int32_t& of_set = number[sets.find(static_cast<std::uint32_t>(e))];
        if (of_set < 0) of_set = next++;
        piece[e] = of_set;
    }
    return piece;
}

StrayPieces drop_stray_pieces(DensityGrid& grid, double level, std::span<const std::uint8_t> anchored,
                              std::span<const std::uint8_t> loaded) {
    const std::vector<std::int32_t> piece = pieces_by_faces(
        grid.size, [&](std::size_t i) { return in_body(grid.use[i]) && grid.density[i] > level; });
    const std::int32_t pieces = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
    std::vector<std::uint8_t> is_held(static_cast<std::size_t>(pieces)), is_loaded(is_held.size());
    const bool any_load = std::ranges::any_of(loaded, [](std::uint8_t l) { return l != 0; });
    for (std::size_t i = 0; i < piece.size(); ++i) {
        if (piece[i] < 0) continue;
        const auto p = static_cast<std::size_t>(piece[i]);
        is_held[p] = is_held[p] != 0 || anchored[i] != 0;
        is_loaded[p] = is_loaded[p] != 0 || !any_load || loaded[i] != 0;
    }
    const auto is_stray = [&](std::size_t p) { return is_held[p] == 0 || is_loaded[p] == 0; };
    StrayPieces dropped;
    for (std::size_t p = 0; p < is_held.size(); ++p) dropped.pieces += is_stray(p) ? 1 : 0;
    std::vector<std::uint8_t> goes(piece.size());
    for (std::size_t i = 0; i < piece.size(); ++i) {
        if (piece[i] < 0 || !is_stray(static_cast<std::size_t>(piece[i]))) continue;
        goes[i] = 1;
        ++dropped.elements;
    }
    for (std::size_t i = 0; i < piece.size(); ++i) {
        if (goes[i] != 0) grid.density[i] = 0;
    }
    return dropped;
}

}  // namespace lamella
