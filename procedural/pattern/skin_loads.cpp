// Squeezes and weight, balanced by inertia relief.
#include "procedural/pattern/skin_loads.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "procedural/optimization/density_shape.h"
#include "procedural/optimization/topology_problem.h"

namespace lamella {

namespace {

constexpr double poisson = 0.3;
constexpr double outermost = 0.05;  // of the skin's size

/// A node of the body: its place in edges, and the solid volume that it stands for.
struct Node {
    std::size_t number;
    dvec3 place;
    double mass;
};

/// Flags the elements of the largest piece.
std::vector<std::uint8_t> largest_piece(glm::ivec3 size, std::span<const float> shares) {
    const std::vector<std::int32_t> piece =
        pieces_by_faces(size, [&](std::size_t i) { return shares[i] > 0; });
    std::vector<std::size_t> sizes;
    for (const std::int32_t p : piece) {
        if (p < 0) continue;
        sizes.resize(std::max(sizes.size(), static_cast<std::size_t>(p) + 1));
        ++sizes[static_cast<std::size_t>(p)];
    }
    if (sizes.empty()) throw InputError("no element of the skin is solid; accepted: a thicker skin");
    const auto largest = static_cast<std::int32_t>(std::ranges::max_element(sizes) - sizes.begin());
    std::vector<std::uint8_t> kept;
    kept.reserve(piece.size());
    for (const std::int32_t p : piece) kept.push_back(p == largest ? 1 : 0);
    return kept;
}

std::vector<Node> nodes_of(glm::ivec3 size, const NodeGrid<3>& grid, std::span<const std::uint8_t> kept,
                           std::span<const float> shares) {
    constexpr double corners = 8;
    std::vector<double> mass(grid.size(), 0);
    const DensityGrid places{size, {}, {}};
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i] == 0) continue;
        const glm::ivec3 at = places.element(i);
        for (int c = 0; c < 8; ++c)
            mass[grid.number(at.x + (c & 1), at.y + (c >> 1 & 1), at.z + (c >> 2))] +=
                static_cast<double>(shares[i]) / corners;
    }
    std::vector<Node> nodes;
    for (int z = 0; z <= size.z; ++z) {
        for (int y = 0; y <= size.y; ++y) {
            for (int x = 0; x <= size.x; ++x) {
                const std::size_t number = grid.number(x, y, z);
                if (mass[number] > 0) nodes.push_back({number, dvec3(x, y, z), mass[number]});
            }
        }
    }
    return nodes;
}

/// Spreads a force of 1 over the nodes on one end of the body along an axis, by their mass.
void push_end(const std::vector<Node>& nodes, int axis, bool upper, double force,
              NodalVector<3, double>& forces) {
    double lo = infinity, hi = -infinity;
    for (const Node& node : nodes) {
        lo = std::min(lo, node.place[axis]);
        hi = std::max(hi, node.place[axis]);
    }
    const double depth = outermost * (hi - lo);
    const auto is_on_end = [&](const Node& node) {
        return upper ? node.place[axis] >= hi - depth : node.place[axis] <= lo + depth;
    };
    double mass = 0;
    for (const Node& node : nodes) mass += is_on_end(node) ? node.mass : 0;
    for (const Node& node : nodes) {
        if (is_on_end(node))
            forces.along[static_cast<std::size_t>(axis)][node.number] += force * node.mass / mass;
    }
}

/// Adds the inertia forces of the motion that the forces would give to the body, so that they balance.
void balance(const std::vector<Node>& nodes, NodalVector<3, double>& forces) {
    const auto at = [&](std::size_t node) {
        return dvec3(forces.along[0][node], forces.along[1][node], forces.along[2][node]);
    };
    double mass = 0;
    dvec3 middle(0), force(0), moment(0);
    for (const Node& node : nodes) {
        mass += node.mass;
        middle += node.mass * node.place;
        force += at(node.number);
    }
    middle /= mass;
    glm::dmat3 inertia(0);
    for (const Node& node : nodes) {
        const dvec3 arm = node.place - middle;
        moment += glm::cross(arm, at(node.number));
        inertia += node.mass * (glm::dot(arm, arm) * glm::dmat3(1) - glm::outerProduct(arm, arm));
    }
    const dvec3 turn = glm::inverse(inertia) * moment;
    for (const Node& node : nodes) {
        const dvec3 relief = node.mass * (force / mass + glm::cross(turn, node.place - middle));
        for (int axis = 0; axis < 3; ++axis)
            forces.along[static_cast<std::size_t>(axis)][node.number] -= relief[axis];
    }
}

/// Returns the axis along which a vector is longest.
int longest_axis(dvec3 v) {
    const dvec3 a = glm::abs(v);
    return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

/// Holds three nodes far from each other so that no rigid motion is left, and nothing else is held.
void hold_lightly(const std::vector<Node>& nodes, std::vector<std::uint8_t>& fixed) {
    const Node& first = nodes.front();
    const auto farthest = [&](const auto& square) {
        return *std::ranges::max_element(nodes,
                                         [&](const Node& a, const Node& b) { return square(a) < square(b); });
    };
    const Node second = farthest([&](const Node& node) {
        const dvec3 way = node.place - first.place;
        return glm::dot(way, way);
    });
    const dvec3 line = second.place - first.place;
    const Node third = farthest([&](const Node& node) {
        const dvec3 beside = glm::cross(line, node.place - first.place);
        return glm::dot(beside, beside);
    });
    constexpr unsigned all = 7;
    fixed[first.number] = all;
    fixed[second.number] |= static_cast<std::uint8_t>(all & ~(1U << longest_axis(line)));
    fixed[third.number] |=
        static_cast<std::uint8_t>(1U << longest_axis(glm::cross(line, third.place - first.place)));
}

}  // namespace

LoadedSkin squeezed_skin(const SkinElements& elements, std::span<const float> shares) {
    const glm::ivec3 size = elements.size();
    const NodeGrid<3> grid(size);
    LoadedSkin loaded{ElasticBody<3>(grid, make_solid_element({1, poisson})), {}};
    const std::vector<std::uint8_t> kept = largest_piece(size, shares);
    const std::vector<std::size_t> numbers = element_numbers(grid);
    for (std::size_t i = 0; i < kept.size(); ++i) loaded.body.present[numbers[i]] = kept[i];
    const std::vector<Node> nodes = nodes_of(size, grid, kept, shares);
    hold_lightly(nodes, loaded.body.fixed);
    for (int axis = 0; axis < 3; ++axis) {
        NodalVector<3, double>& squeeze = loaded.cases.emplace_back(grid.size());
        push_end(nodes, axis, false, 1, squeeze);
        push_end(nodes, axis, true, -1, squeeze);
        balance(nodes, squeeze);
    }
    // Under gravity a body that floats falls without strain: what strains it is the ground's push.
    NodalVector<3, double>& weight = loaded.cases.emplace_back(grid.size());
    push_end(nodes, 2, false, 1, weight);
    balance(nodes, weight);
    return loaded;
}

}  // namespace lamella
