// Rounds of bisection: every triangle that is not linear marks its long edges, and all triangles at a marked
// edge are divided there.
#include "engine/mesh/graded_mesh.h"

#include <array>
#include <cmath>
#include <unordered_map>

namespace lamella {
namespace {

constexpr double radius_tolerance = 0.02;     // share of the largest number on the triangle
constexpr double smallest_in_lengths = 0.25;  // shorter edges need no division
constexpr double halved_with_longest =
    0.5;  // edges at least this share of the longest one are halved with it
constexpr int edge_halvings = 10;
constexpr int fewest_steps = 4, max_steps = 16;  // of the lattice along an edge
constexpr std::size_t max_new_triangles = 8'000'000;

using Corners = std::array<std::uint32_t, 3>;

class Refinement {
  public:
    Refinement(const Grading& lengths, const TriangleMesh& mesh) : lengths_(lengths), result_{mesh, {}} {
        result_.numbers.reserve(mesh.vertices.size());
        for (const dvec3 v : mesh.vertices) result_.numbers.push_back(lengths.at(v));
        open_.assign(mesh.triangles.size(), true);
        max_triangles_ = mesh.triangles.size() + max_new_triangles;
    }

    GradedMesh run() {
        for (int round = 0; round < edge_halvings && mark() && triangles().size() < max_triangles_; ++round) {
            divide();
        }
        return std::move(result_);
    }

  private:
    std::vector<Corners>& triangles() { return result_.mesh.triangles; }
    dvec3 place(std::uint32_t v) const { return result_.mesh.vertices[v]; }

    /// Marks the edges to halve; returns false when there are none.
    bool mark() {
        middles_.clear();
        for (std::size_t k = 0; k < triangles().size(); ++k) {
            if (!open_[k]) continue;
            const Corners& t = triangles()[k];
            std::array<double, 3> edges{};
            for (std::size_t e = 0; e < 3; ++e) edges[e] = length(place(t[(e + 1) % 3]) - place(t[e]));
            const double longest = std::max(edges[0], std::max(edges[1], edges[2]));
            open_[k] = !is_linear(t, longest);
            if (!open_[k]) continue;
            for (std::size_t e = 0; e < 3; ++e) {
                if (edges[e] >= halved_with_longest * longest) halve(t[e], t[(e + 1) % 3]);
            }
        }
        return !middles_.empty();
    }

    bool is_linear(const Corners& t, double longest) const {
        Box box;
        for (const std::uint32_t v : t) box.include(place(v));
        const Interval enclosure = lengths_.range(box);
        if (enclosure.width() <= radius_tolerance * enclosure.hi) return true;
        const double spacing = std::max(enclosure.hi / 2, longest / max_steps);
        const int steps = std::max(fewest_steps, static_cast<int>(std::ceil(longest / spacing)));
        double largest = 0, deviation = 0;
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const double a = i / static_cast<double>(steps), b = j / static_cast<double>(steps);
                const auto mean = [&](auto u, auto v, auto w) { return u + (v - u) * a + (w - u) * b; };
                const double number = lengths_.at(mean(place(t[0]), place(t[1]), place(t[2])));
                const auto& known = result_.numbers;
                largest = std::max(largest, number);
                deviation =
                    std::max(deviation, std::abs(number - mean(known[t[0]], known[t[1]], known[t[2]])));
            }
        }
        return deviation <= radius_tolerance * largest || longest <= smallest_in_lengths * largest;
    }

    static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
        return static_cast<std::uint64_t>(std::min(a, b)) << 32U | std::max(a, b);
    }

    void halve(std::uint32_t a, std::uint32_t b) {
        const auto [found, fresh] =
            middles_.try_emplace(key(a, b), static_cast<std::uint32_t>(result_.mesh.vertices.size()));
        if (!fresh) return;
        const dvec3 middle = (place(std::min(a, b)) + place(std::max(a, b))) * 0.5;
        result_.mesh.vertices.push_back(middle);
        result_.numbers.push_back(lengths_.at(middle));
    }

    /// Divides every triangle at its marked edges.
    void divide() {
        std::vector<Corners> old;
        old.swap(triangles());
        open_.clear();
        constexpr std::uint32_t none = 0xffffffffU;
        for (std::size_t k = 0; k < old.size(); ++k) {
            Corners t = old[k], middle{};
            std::size_t marked = 0;
            for (std::size_t e = 0; e < 3; ++e) {
                const auto found = middles_.find(key(t[e], t[(e + 1) % 3]));
                middle[e] = found == middles_.end() ? none : found->second;
                marked += middle[e] != none;
            }
            // Rotate the corners so that edge 0 is marked, and edge 2 is not if two are.
            const auto fits = [&] {
                return marked % 3 == 0 || (middle[0] != none && (marked == 1 || middle[1] != none));
            };
            while (!fits()) {
                t = {t[1], t[2], t[0]};
                middle = {middle[1], middle[2], middle[0]};
            }
            const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                triangles().push_back({a, b, c});
                // A triangle divided for its neighbour's sake may have been sampled too coarsely.
                open_.push_back(marked > 0);
            };
            if (marked == 0) {
                add(t[0], t[1], t[2]);
            } else if (marked == 1) {
                add(t[0], middle[0], t[2]);
                add(middle[0], t[1], t[2]);
            } else if (marked == 2) {
                add(middle[0], t[1], middle[1]);
                add(t[0], middle[0], middle[1]);
                add(t[0], middle[1], t[2]);
            } else {
                for (std::size_t e = 0; e < 3; ++e) add(t[e], middle[e], middle[(e + 2) % 3]);
                add(middle[0], middle[1], middle[2]);
            }
        }
    }

    const Grading& lengths_;
    GradedMesh result_;
    std::vector<bool> open_;  ///< by triangle: may still need division
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
    std::size_t max_triangles_ = 0;
};

}  // namespace

GradedMesh read_on_mesh(const Grading& lengths, const TriangleMesh& mesh) {
    return Refinement(lengths, mesh).run();
}

}  // namespace lamella
