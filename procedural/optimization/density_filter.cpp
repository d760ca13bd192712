// The density filter: mirrored or empty padding, sums of rings of rows, then weights along x.
#include "procedural/optimization/density_filter.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/common.hpp>

#include "engine/base/parallel.h"

namespace lamella {
namespace {

/// Returns the place in [0, size) that a place beyond the borders is the mirror image of.
int mirrored_place(int i, int size) {
    const int period = 2 * size;
    const int inside = ((i % period) + period) % period;
    return inside < size ? inside : period - 1 - inside;
}

}  // namespace

DensityFilter::DensityFilter(glm::ivec3 size, std::span<const std::uint8_t> domain, double radius,
                             FilterPadding padding)
    : grid_(size, domain), radius_(radius), padding_(padding) {
    if (!(radius >= 1 && radius <= max_radius))
        throw InputError("a filter radius of " + std::to_string(radius) + " elements: it must lie in 1 to " +
                         std::to_string(static_cast<int>(max_radius)));
    const int reach = static_cast<int>(std::ceil(radius)) - 1;
    pad_ = glm::ivec3(reach, reach, grid_.flat() ? 0 : reach);
    if (padding == FilterPadding::cut) pad_ = glm::min(pad_, size - 1);  // what lies beyond is empty

    std::map<int, Ring> by_distance;
    for (int dz = -pad_.z; dz <= pad_.z; ++dz)
        for (int dy = -pad_.y; dy <= pad_.y; ++dy) {
            const int squared = dy * dy + dz * dz;
            if (!(std::sqrt(static_cast<double>(squared)) < radius)) continue;
            by_distance[squared].rows.emplace_back(dy, dz);
        }
    for (auto& [squared, ring] : by_distance) {
        for (int dx = 0; dx <= pad_.x; ++dx) {
            const double weight = radius - std::sqrt(static_cast<double>(squared + dx * dx));
            if (!(weight > 0)) break;
            ring.weights.push_back(weight);
        }
        rings_.push_back(std::move(ring));
    }

    weight_sums_.assign(grid_.elements(), 0);
    smooth([](std::size_t) { return 1.0; }, [](std::size_t, double sum) { return sum; }, weight_sums_);
}

void DensityFilter::open_border(std::span<const std::uint8_t> elements) {
    grid_.check(elements.size(), "the mask of open elements");
    const int reach = static_cast<int>(std::ceil(radius_)) - 1, reach_z = grid_.flat() ? 0 : reach;
    double whole = 0;
    for (int dz = -reach_z; dz <= reach_z; ++dz) {
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx)
                whole += std::max(0.0, radius_ - std::sqrt(static_cast<double>(dx * dx + dy * dy + dz * dz)));
        }
    }
    for (std::size_t i = 0; i < weight_sums_.size(); ++i) {
        if (elements[i] != 0 && grid_.inside(i)) weight_sums_[i] = whole;
    }
}

/// Returns source(element) for the elements of the domain and 0 for others, with the padding around.
template <class Source>
std::vector<double> DensityFilter::padded(const Source& source) const {
    const glm::ivec3 size = grid_.size(), wide = size + 2 * pad_;
    const auto width = static_cast<std::size_t>(wide.x);
    const auto rows = static_cast<std::size_t>(wide.y) * static_cast<std::size_t>(wide.z);
    std::vector<double> values(width * rows, 0.0);
    const bool mirror = padding_ == FilterPadding::mirror;
    parallel_for(rows, [&](std::size_t row) {
        int y = static_cast<int>(row % static_cast<std::size_t>(wide.y)) - pad_.y;
        int z = static_cast<int>(row / static_cast<std::size_t>(wide.y)) - pad_.z;
        if (mirror) {
            y = mirrored_place(y, size.y);
            z = mirrored_place(z, size.z);
        } else if (y < 0 || y >= size.y || z < 0 || z >= size.z) {
            return;
        }
        double* to = values.data() + row * width + pad_.x;
        const std::size_t first = grid_.place(0, y, z);
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = first + static_cast<std::size_t>(x);
            if (grid_.inside(i)) to[x] = source(i);
        }
        if (!mirror) return;
        for (int x = 1; x <= pad_.x; ++x) {
            to[-x] = to[mirrored_place(-x, size.x)];
            to[size.x - 1 + x] = to[mirrored_place(size.x - 1 + x, size.x)];
        }
    });
    return values;
}

/// Computes out_i = finish(i, sum_j w_ij source(j)) for the elements of the domain and 0 for others.
template <class Source, class Finish>
void DensityFilter::smooth(const Source& source, const Finish& finish, std::span<double> out) const {
    const std::vector<double> values = padded(source);
    const glm::ivec3 size = grid_.size(), wide = size + 2 * pad_;
    const auto width = static_cast<std::size_t>(wide.x), inner = static_cast<std::size_t>(size.x);
    const auto before = static_cast<std::size_t>(pad_.x);
    const auto row_of = [&](int y, int z) {
        return values.data() +
               width * (static_cast<std::size_t>(y + pad_.y) +
                        static_cast<std::size_t>(wide.y) * static_cast<std::size_t>(z + pad_.z));
    };
    const auto rows = static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    parallel_for(rows, [&](std::size_t row) {
        const int y = static_cast<int>(row % static_cast<std::size_t>(size.y));
        const int z = static_cast<int>(row / static_cast<std::size_t>(size.y));
        std::vector<double> ring_sum(width), sum(inner, 0.0);
        for (const Ring& ring : rings_) {
            std::fill(ring_sum.begin(), ring_sum.end(), 0.0);
            for (const glm::ivec2 offset : ring.rows) {
                const double* from = row_of(y + offset.x, z + offset.y);
                for (std::size_t x = 0; x < width; ++x) ring_sum[x] += from[x];
            }
            const double* centre = ring_sum.data() + before;
            for (std::size_t x = 0; x < inner; ++x) sum[x] += ring.weights[0] * centre[x];
            for (std::size_t dx = 1; dx < ring.weights.size(); ++dx) {
                const double weight = ring.weights[dx];
                const double *left = centre - dx, *right = centre + dx;
                for (std::size_t x = 0; x < inner; ++x) sum[x] += weight * (left[x] + right[x]);
            }
        }
        const std::size_t first = grid_.place(0, y, z);
        for (std::size_t x = 0; x < inner; ++x)
            out[first + x] = grid_.inside(first + x) ? finish(first + x, sum[x]) : 0.0;
    });
}

void DensityFilter::forward(std::span<const double> values, std::span<double> out) const {
    grid_.check(values.size(), "the field to be filtered");
    grid_.check(out.size(), "the filtered field");
    smooth([&](std::size_t j) { return values[j]; },
           [&](std::size_t i, double sum) { return sum / weight_sums_[i]; }, out);
}

// The weights are symmetric, mirrored ones too: an image of j is as far from i as that image of i from j.
void DensityFilter::backward(std::span<const double> gradient, std::span<double> out) const {
    grid_.check(gradient.size(), "the gradient");
    grid_.check(out.size(), "the filtered gradient");
    smooth([&](std::size_t i) { return gradient[i] / weight_sums_[i]; },
           [](std::size_t, double sum) { return sum; }, out);
}

void DensityFilter::sensitivities(std::span<const double> values, std::span<const double> gradient,
                                  std::span<double> out) const {
    constexpr double least_value = 1e-3;  // of the paper
    grid_.check(values.size(), "the field of densities");
    grid_.check(gradient.size(), "the gradient");
    grid_.check(out.size(), "the filtered gradient");
    smooth(
        [&](std::size_t j) { return values[j] * gradient[j]; },
        [&](std::size_t i, double sum) { return sum / (weight_sums_[i] * std::max(least_value, values[i])); },
        out);
}

}  // namespace lamella
