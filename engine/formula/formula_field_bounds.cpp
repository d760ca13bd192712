// Bounding box of a formula's solid: cells whose range proves them empty are discarded, coarse cells first,
// then finer ones within the rest.
#include <algorithm>

#include "engine/formula/formula_field.h"
#include "engine/formula/formula_inputs.h"
#include "engine/formula/formula_prune.h"

namespace lamella {
namespace {

constexpr double reach = 1e4;    // mm
constexpr int box_halvings = 5;  // per side, from the searched box to a cell
constexpr int max_passes = 60;   // a pass can narrow a side 32-fold
constexpr double enough = 0.02;  // the last pass is the one that narrows every side by less than this

/// One pass: finds the box around all cells that may hold part of the solid.
class CellSearch {
  public:
    CellSearch(const Formula& formula, std::span<const GradingPtr> others)
        : stack_(formula), others_(others), read_(read_others(formula)) {}

    Box search(const Box& box) {
        found_ = {};
        visit(box, box_halvings);
        return found_;
    }

  private:
    void visit(const Box& cell, int left) {
        if (found_.contains(cell.lo) && found_.contains(cell.hi)) return;
        fill_ranges(cell, others_, read_, inputs_);
        const FormulaRange r = stack_.enter(inputs_);
        if (!r.values.empty() && !(r.values.lo > 0)) {
            if (left == 0) {
                found_ = unite(found_, cell);
            } else {
                divide(cell, left);
            }
        }
        stack_.leave();
    }

    void divide(const Box& cell, int left) {
        const dvec3 middle = cell.center();
        for (int octant = 0; octant < 8; ++octant) {
            Box part = cell;
            for (int axis = 0; axis < 3; ++axis) {
                double& side = (octant >> axis & 1) == 0 ? part.hi[axis] : part.lo[axis];
                side = middle[axis];
            }
            visit(part, left - 1);
        }
    }

    FormulaStack stack_;
    std::span<const GradingPtr> others_;
    std::vector<std::size_t> read_;
    std::vector<FormulaRange> inputs_;
    Box found_;
};

bool narrowed(const Box& before, const Box& after) {
    const dvec3 b = before.size(), a = after.size();
    return a.x < b.x * (1 - enough) || a.y < b.y * (1 - enough) || a.z < b.z * (1 - enough);
}

}  // namespace

Box formula_bounds(const Formula& formula, std::span<const GradingPtr> others) {
    require_inputs(formula, others);
    CellSearch cells(formula, others);
    Box box{dvec3(-reach), dvec3(reach)};
    for (int pass = 0; pass < max_passes; ++pass) {
        const Box found = cells.search(box);
        if (found.empty())
            throw InputError("the formula's solid is empty: it is negative nowhere within 10 m");
        const bool go_on = narrowed(box, found);
        box = found;
        if (!go_on) break;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (box.lo[axis] <= -reach || reach <= box.hi[axis])
            throw InputError(std::string("the formula's solid is not bounded along ") + "xyz"[axis] +
                             " within 10 m: give its bounds, or cut it to a box");
    }
    return box;
}

}  // namespace lamella
