// Lines of nine numbers; distances by a tree of points.
#include "procedural/elements/element_arrangement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "procedural/elements/number_line.h"
#include "procedural/voronoi/point_tree.h"

namespace lamella {

namespace {

constexpr std::size_t most_elements = 1'000'000;

/// Returns the element of a line. Throws InputError with what is wrong about it.
PlacedElement element_of(std::string_view line, const ArrangementLimits& limits) {
    const std::vector<double> n = numbers_of_line(line);
    constexpr std::size_t columns_of_element = 9;
    if (n.size() != columns_of_element)
        throw InputError(fmt::format(
            "{} is no element; accepted: nine numbers, shape,x,y,z,qw,qx,qy,qz,scale", excerpt(line)));
    if (!(n[0] >= 0 && n[0] < limits.shapes) || n[0] != std::floor(n[0]))
        throw InputError(
            fmt::format("there is no shape {}; accepted: whole numbers from 0 to {}, as there "
                        "are [[element]]s",
                        n[0], limits.shapes - 1));
    constexpr double farthest = 1e9;  // mm
    if (std::max({std::abs(n[1]), std::abs(n[2]), std::abs(n[3])}) > farthest)
        throw InputError("a place beyond a billion mm; accepted: one nearer to the origin");
    const glm::dquat turn(n[4], n[5], n[6], n[7]);
    const double squared = glm::dot(turn, turn);
    if (!(squared > 1e-12 && squared < 1e12))
        throw InputError("a quaternion of length 0 turns nothing; accepted: one of length 1");
    constexpr double rounding = 1e-6;
    const Interval& scales = limits.scales;
    if (!(n[8] >= scales.lo * (1 - rounding) && n[8] <= scales.hi * (1 + rounding)))
        throw InputError(
            fmt::format("a scale of {} is outside of elements.scale_min and scale_max; "
                        "accepted: {} to {}",
                        n[8], scales.lo, scales.hi));
    return {.shape = static_cast<std::uint32_t>(n[0]),
            .at = {n[1], n[2], n[3]},
            .turn = glm::normalize(turn),
            .scale = std::clamp(n[8], scales.lo, scales.hi)};
}

}  // namespace

std::vector<PlacedElement> read_arrangement(std::string_view text, const std::string& name,
                                            const ArrangementLimits& limits) {
    std::vector<PlacedElement> elements;
    std::size_t number = 0;
    for (std::string_view rest = without_byte_order_mark(text); !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++number;
        const bool is_header = number == 1 && line.starts_with("shape");
        if (line.empty() || is_header) continue;
        try {
            elements.push_back(element_of(line, limits));
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:{}: {}", name, number, error.what()));
        }
        if (elements.size() > most_elements)
            throw InputError(fmt::format("{}: more than a million elements; accepted: fewer", name));
    }
    if (elements.size() < 2)
        throw InputError(fmt::format("{}: {}; accepted: an arrangement of two or more", name,
                                     counted(elements.size(), "element")));
    return elements;
}

double spacing_variation(std::span<const PlacedElement> elements) {
    std::vector<dvec3> places;
    Box box;
    places.reserve(elements.size());
    for (const PlacedElement& element : elements) {
        places.push_back(element.at);
        box.include(element.at);
    }
    const PointTree tree(places);
    const double whole = length(box.size()),
                 mean_spacing = whole / std::sqrt(static_cast<double>(places.size()));
    std::vector<double> distances(places.size());
    parallel_for(places.size(), [&](std::size_t k) {
        std::vector<std::uint32_t> near;
        for (double reach = mean_spacing; near.size() < 2 && whole > 0; reach *= 2) {
            near.clear();
            tree.within(places[k], reach, near);
        }
        double nearest = infinity;
        for (const std::uint32_t i : near) {
            if (i != k) nearest = std::min(nearest, length(places[i] - places[k]));
        }
        distances[k] = whole > 0 ? nearest : 0;
    });
    double sum = 0, squares = 0;
    for (const double d : distances) sum += d;
    const double mean = sum / static_cast<double>(distances.size());
    for (const double d : distances) squares += (d - mean) * (d - mean);
    return mean > 0 ? std::sqrt(squares / static_cast<double>(distances.size())) / mean : 0;
}

}  // namespace lamella
