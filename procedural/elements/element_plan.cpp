// Numbers in their shortest exact form, a line each.
#include "procedural/elements/element_plan.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"
#include "procedural/elements/number_line.h"

namespace lamella {

namespace {

/// Its number is raised whenever the same recipe places elements otherwise, so that plans of older versions
/// are not taken.
constexpr std::string_view title = "lamella elements 4";

constexpr double most_shapes = 10'000;

[[noreturn]] void refuse(const std::string& name) {
    throw InputError(name + ": damaged or cut off; accepted: a plan of elements as Lamella writes it");
}

/// Returns the numbers of a line, which has to have `count` of them.
std::vector<double> numbers_of(std::istream& in, std::size_t count, const std::string& name) {
    std::string line;
    std::getline(in, line);
    std::vector<double> numbers = numbers_of_line(line);
    if (!in || numbers.size() != count) refuse(name);
    return numbers;
}

std::size_t count_of(double number, const std::string& name, double most = 1e9) {
    if (!(number >= 0 && number <= most) || number != std::floor(number)) refuse(name);
    return static_cast<std::size_t>(number);
}

}  // namespace

void write_elements(std::ostream& out, const std::vector<PlacedElement>& elements) {
    for (const PlacedElement& e : elements)
        out << fmt::format("{},{},{},{},{},{},{},{},{}\n", e.shape, e.at.x, e.at.y, e.at.z, e.turn.w,
                           e.turn.x, e.turn.y, e.turn.z, e.scale);
}

void write_element_plan(const std::filesystem::path& file, const ElementPlan& plan) {
    write_complete_file(file, [&](std::ostream& out) {
        out << title << '\n';
        out << fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", plan.elements.size(), plan.bridges.size(),
                           plan.pieces, plan.moved, plan.dropped, plan.volume, plan.compliance,
                           plan.full_compliance, plan.optimum, plan.overlap, plan.thickness);
        write_elements(out, plan.elements);
        for (const ElementBridge& b : plan.bridges)
            out << fmt::format("{},{},{},{},{},{}\n", b.from.x, b.from.y, b.from.z, b.to.x, b.to.y, b.to.z);
    });
}

ElementPlan read_element_plan(std::istream& in, const std::string& name) {
    std::string first;
    std::getline(in, first);
    if (first != title) throw InputError(name + ": no plan of elements; accepted: one that Lamella wrote");
    const std::vector<double> known = numbers_of(in, 11, name);
    ElementPlan plan{.elements = {},
                     .bridges = {},
                     .pieces = count_of(known[2], name),
                     .moved = count_of(known[3], name),
                     .dropped = count_of(known[4], name),
                     .volume = known[5],
                     .compliance = known[6],
                     .full_compliance = known[7],
                     .optimum = known[8],
                     .overlap = known[9],
                     .thickness = known[10]};
    if (!(plan.thickness >= 0)) refuse(name);
    const std::size_t count = count_of(known[0], name), bridges = count_of(known[1], name);
    for (std::size_t k = 0; k < count; ++k) {
        const std::vector<double> n = numbers_of(in, 9, name);
        const glm::dquat turn(n[4], n[5], n[6], n[7]);
        if (!(std::abs(glm::dot(turn, turn) - 1) < 1e-9) || !(n[8] > 0)) refuse(name);
        plan.elements.push_back({.shape = static_cast<std::uint32_t>(count_of(n[0], name, most_shapes)),
                                 .at = {n[1], n[2], n[3]},
                                 .turn = turn,
                                 .scale = n[8]});
    }
    for (std::size_t k = 0; k < bridges; ++k) {
        const std::vector<double> n = numbers_of(in, 6, name);
        plan.bridges.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    }
    return plan;
}

}  // namespace lamella
