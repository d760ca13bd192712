// Builds formulas from sums and products, node by node.
#include "procedural/volume/platform_formula.h"

#include "engine/formula/formula_inputs.h"

namespace lamella {

namespace {

using Node = FormulaBuilder::Node;

}  // namespace

GraphValue mapped(FormulaBuilder& f, const GraphValue& place, const Transform3mf& map) {
    GraphValue out{GraphType::vector};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Node sum = -1;
        for (std::size_t i = 0; i < 3; ++i) {
            const double factor = map.m[3 * i + axis];
            if (factor == 0) continue;
            const Node term = f.binary(FormulaOp::mul, place.parts[i], f.constant(factor));
            sum = sum < 0 ? term : f.binary(FormulaOp::add, sum, term);
        }
        const double shift = map.m[9 + axis];
        if (sum < 0) {
            sum = f.constant(shift);
        } else if (shift != 0) {
            sum = f.binary(FormulaOp::add, sum, f.constant(shift));
        }
        out.parts[axis] = sum;
    }
    return out;
}

GraphValue platform(FormulaBuilder& f) {
    GraphValue place{GraphType::vector};
    for (int axis = 0; axis < 3; ++axis) place.parts[static_cast<std::size_t>(axis)] = f.input(axis);
    return place;
}

Transform3mf scaled(Transform3mf map, double factor) {
    for (double& m : map.m) m *= factor;
    return map;
}

bool keeps_axes(const Transform3mf& t) {
    for (std::size_t row = 0; row < 3; ++row) {
        int entries = 0;
        for (std::size_t column = 0; column < 3; ++column) entries += t.m[3 * row + column] != 0 ? 1 : 0;
        if (entries != 1) return false;
    }
    return true;
}

std::optional<double> scale_of(const Transform3mf& map) {
    constexpr double rounding = 1e-9;
    const auto row = [&](std::size_t i) { return dvec3(map.m[3 * i], map.m[3 * i + 1], map.m[3 * i + 2]); };
    const double square = glm::dot(row(0), row(0));
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            const double wanted = i == j ? square : 0.0;
            if (!(std::abs(glm::dot(row(i), row(j)) - wanted) <= rounding * square)) return std::nullopt;
        }
    }
    return std::sqrt(square);
}

Box image_of(const Box& box, const Transform3mf& map) {
    Box image;
    for (int corner = 0; corner < 8; ++corner) {
        image.include(map({(corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
                           (corner & 4) != 0 ? box.hi.z : box.lo.z}));
    }
    return image;
}

FormulaBuilder::Node within_box(FormulaBuilder& f, FormulaBuilder::Node value, const GraphValue& place,
                                const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int i = static_cast<int>(axis);
        const Node below = f.binary(FormulaOp::sub, f.constant(box.lo[i]), place.parts[axis]);
        const Node above = f.binary(FormulaOp::sub, place.parts[axis], f.constant(box.hi[i]));
        value = f.binary(FormulaOp::max, value, f.binary(FormulaOp::max, below, above));
    }
    return value;
}

bool is_box(const TriangleMesh& mesh, const Box& box) {
    double six_volumes = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        for (const std::uint32_t corner : {a, b, c}) {
            const dvec3 p = mesh.vertices[corner];
            for (int i = 0; i < 3; ++i) {
                if (p[i] != box.lo[i] && p[i] != box.hi[i]) return false;
            }
        }
        const dvec3 o = box.lo;
        six_volumes += glm::dot(mesh.vertices[a] - o, glm::cross(mesh.vertices[b] - o, mesh.vertices[c] - o));
    }
    const dvec3 size = box.size();
    const double volume = size.x * size.y * size.z;
    constexpr double rounding = 1e-9;
    return std::abs(six_volumes / 6 - volume) <= rounding * volume;
}

FormulaBuilder::Node or_else(FormulaBuilder& f, Node value, double fallback) {
    return f.select(f.binary(FormulaOp::equal, value, value), value, f.constant(fallback));
}

bool maybe_undefined(const Formula& formula, std::span<const GradingPtr> others) {
    constexpr double reach = 1e6;
    std::vector<FormulaRange> inputs;
    fill_ranges({dvec3(-reach), dvec3(reach)}, others, read_others(formula), inputs);
    return range(formula, inputs).maybe_nan;
}

}  // namespace lamella
