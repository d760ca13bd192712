// Each cube falls into six tetrahedra round its diagonal, which agree with those of its neighbours. Vertices
// lie on edges between samples on either side of the level, so neighbours share them.
#include "procedural/optimization/density_surface.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace lamella {

namespace {

/// Samples at the centres of a grid's elements, and of some layers of elements beyond it.
struct Samples {
    std::array<std::vector<double>, 3> along;  ///< coordinates, mm
    std::vector<double> density;

    std::array<std::size_t, 3> size() const { return {along[0].size(), along[1].size(), along[2].size()}; }
    std::size_t number(std::size_t x, std::size_t y, std::size_t z) const {
        return x + along[0].size() * (y + along[1].size() * z);
    }
    dvec3 position(std::size_t number) const {
        const std::size_t nx = along[0].size(), ny = along[1].size();
        return {along[0][number % nx], along[1][number / nx % ny], along[2][number / (nx * ny)]};
    }
};

constexpr int more = 3;  ///< layers of samples beyond the box, of which the last is empty

Samples sampled(const DensityGrid& grid, const Box& box) {
    Samples samples;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = box.size()[axis] / grid.size[axis];
        for (int i = -more; i < grid.size[axis] + more; ++i)
            samples.along[static_cast<std::size_t>(axis)].push_back(box.lo[axis] + (i + 0.5) * step);
    }
    const auto [nx, ny, nz] = samples.size();
    samples.density.assign(nx * ny * nz, 0.0);
    for (std::size_t z = 1; z + 1 < nz; ++z) {
        for (std::size_t y = 1; y + 1 < ny; ++y) {
            for (std::size_t x = 1; x + 1 < nx; ++x) {
                const glm::ivec3 at = glm::clamp(
                    glm::ivec3(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)) - more,
                    glm::ivec3(0), grid.size - 1);
                samples.density[samples.number(x, y, z)] = grid.density[grid.place(at)];
            }
        }
    }
    return samples;
}

class Marcher {
  public:
    Marcher(const Samples& samples, double level) : samples_(samples), level_(level) {}

    TriangleMesh run() {
        const auto [nx, ny, nz] = samples_.size();
        for (std::size_t z = 0; z + 1 < nz; ++z) {
            for (std::size_t y = 0; y + 1 < ny; ++y) {
                for (std::size_t x = 0; x + 1 < nx; ++x) add_cube(x, y, z);
            }
        }
        return std::move(mesh_);
    }

  private:
    using Tetrahedron = std::array<std::size_t, 4>;

    bool is_dense(std::size_t sample) const { return samples_.density[sample] > level_; }

    void add_cube(std::size_t x, std::size_t y, std::size_t z) {
        std::array<std::size_t, 8> corners;
        int dense = 0;
        for (std::size_t i = 0; i < 8; ++i) {
            corners[i] = samples_.number(x + (i & 1U), y + (i >> 1 & 1U), z + (i >> 2));
            dense += is_dense(corners[i]) ? 1 : 0;
        }
        if (dense == 0 || dense == 8) return;
        // The ways from corner 0 to corner 7, one axis after another.
        constexpr std::array<std::array<std::size_t, 2>, 6> ways{
            {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}}};
        for (const auto& [first, second] : ways)
            add_tetrahedron({corners[0], corners[first], corners[second], corners[7]});
    }

    void add_tetrahedron(Tetrahedron corners) {
        const auto middle = std::stable_partition(corners.begin(), corners.end(),
                                                  [&](std::size_t corner) { return is_dense(corner); });
        const auto dense = middle - corners.begin();
        const auto& [a, b, c, d] = corners;
        const dvec3 outward = 0.5 * (samples_.position(c) + samples_.position(d)) -
                              0.5 * (samples_.position(a) + samples_.position(b));
        switch (dense) {
            case 1:
                return add_triangle({crossing(a, b), crossing(a, c), crossing(a, d)},
                                    samples_.position(b) - samples_.position(a));
            case 2:
                add_triangle({crossing(a, c), crossing(a, d), crossing(b, d)}, outward);
                return add_triangle({crossing(a, c), crossing(b, d), crossing(b, c)}, outward);
            case 3:
                return add_triangle({crossing(a, d), crossing(b, d), crossing(c, d)},
                                    samples_.position(d) - samples_.position(a));
            default:
                return;
        }
    }

    /// Adds a triangle whose front is where `outward` points to.
    void add_triangle(std::array<std::uint32_t, 3> corners, dvec3 outward) {
        const auto& at = mesh_.vertices;
        const dvec3 normal = glm::cross(at[corners[1]] - at[corners[0]], at[corners[2]] - at[corners[0]]);
        if (glm::dot(normal, outward) < 0) std::swap(corners[1], corners[2]);
        mesh_.triangles.push_back(corners);
    }

    /// Returns the vertex on the edge between a dense sample and one that is not.
    std::uint32_t crossing(std::size_t dense, std::size_t empty) {
        const std::uint64_t edge =
            std::uint64_t{std::min(dense, empty)} * samples_.density.size() + std::max(dense, empty);
        const auto [known, is_new] =
            vertices_.emplace(edge, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) {
            const double above = samples_.density[dense] - level_, below = level_ - samples_.density[empty];
            // Away from the samples, where triangles would have no area.
            constexpr double least = 1e-4;
            const double way = std::clamp(above / (above + below), least, 1 - least);
            mesh_.vertices.push_back(glm::mix(samples_.position(dense), samples_.position(empty), way));
        }
        return known->second;
    }

    const Samples& samples_;
    double level_;
    TriangleMesh mesh_;
    std::unordered_map<std::uint64_t, std::uint32_t> vertices_;  ///< by edge
};

}  // namespace

TriangleMesh density_surface(const DensityGrid& grid, const Box& box, double level, int parts) {
    DensityGrid whole = grid;
    whole.use.assign(grid.density.size(), ElementUse::free);
    return Marcher(sampled(refined(whole, parts), box), level).run();
}

}  // namespace lamella
