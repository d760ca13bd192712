// Best-first division of a box; each part is followed down to a point.
#include "engine/field/solid_search.h"

#include <queue>
#include <vector>

namespace lamella {
namespace {

constexpr int max_parts = 20'000;
constexpr double smallest = 1e-9;  // relative to the box's diagonal

struct Part {
    Box box;
    double value;  ///< at the centre; infinite where the field is NaN
    double bound;  ///< lower bound of the values in the part if they change by at most 1 per mm
    int number;    ///< order of creation; breaks ties, so that the search is deterministic
};

struct ByBound {
    bool operator()(const Part& a, const Part& b) const {
        return a.bound > b.bound || (a.bound == b.bound && a.number > b.number);
    }
};

class HalvingSearch {
  public:
    HalvingSearch(const Field& solid, const Box& box) : solid_(solid), box_(box) {}

    std::optional<dvec3> run() {
        std::optional<Part> part = add(box_);
        while (!found_ && made_ < max_parts && (part || !open_.empty())) {
            if (!part) {
                part = open_.top();
                open_.pop();
            }
            part = descend(*part);
        }
        return found_;
    }

  private:
    /// Samples a part; returns it if it may hold some of the solid.
    std::optional<Part> add(const Box& box) {
        const double value = solid_.value(box.center()), size = diagonal(box);
        ++made_;
        if (value < 0) found_ = box.center();
        if (solid_.range(box).lo >= 0 || !(size > smallest * diagonal(box_))) return std::nullopt;
        return Part{box, std::isnan(value) ? infinity : value, (std::isnan(value) ? 0 : value) - size / 2,
                    made_};
    }

    /// Halves the part and returns the half with the lower value; queues the other one.
    std::optional<Part> descend(const Part& part) {
        const dvec3 size = part.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        Box lower = part.box, upper = part.box;
        lower.hi[axis] = upper.lo[axis] = part.box.center()[axis];
        std::optional<Part> a = add(lower), b = add(upper);
        if (!a || !b) return a ? a : b;
        if (b->value < a->value) std::swap(a, b);
        open_.push(*b);
        return a;
    }

    const Field& solid_;
    Box box_;
    int made_ = 0;
    std::optional<dvec3> found_;
    std::priority_queue<Part, std::vector<Part>, ByBound> open_;
};

}  // namespace

std::optional<dvec3> find_solid_point(const Field& solid, const Box& box) {
    return box.empty() ? std::nullopt : HalvingSearch(solid, box).run();
}

}  // namespace lamella
