// Best-first division of a box.
#include "engine/solid_search.h"

#include <queue>

namespace lamella {
namespace {

constexpr int most_boxes = 20'000;

struct Open {
    double rank;  ///< the lower, the sooner
    int number;   ///< in the order of making, so that the search is the same everywhere
    Box box;
    friend bool operator<(const Open& a, const Open& b) {
        return a.rank > b.rank || (a.rank == b.rank && a.number > b.number);
    }
};

}  // namespace

std::optional<dvec3> find_solid_point(const Field& solid, const Box& box) {
    if (box.empty()) return std::nullopt;
    std::priority_queue<Open> open;
    int made = 0;
    const auto add = [&](const Box& part) {
        const double value = solid.value(part.center());
        ++made;
        if (value < 0) return true;
        // What the value could be in the part where it changes by at most 1 per mm.
        const double rank = (std::isnan(value) ? 0 : value) - diagonal(part) / 2;
        if (!(solid.range(part).lo >= 0)) open.push({rank, made, part});
        return false;
    };
    if (add(box)) return box.center();
    while (!open.empty() && made < most_boxes) {
        const Box worst = open.top().box;
        open.pop();
        const dvec3 size = worst.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const double middle = worst.center()[axis];
        for (const bool upper : {false, true}) {
            Box half = worst;
            (upper ? half.lo : half.hi)[axis] = middle;
            if (add(half)) return half.center();
        }
    }
    return std::nullopt;
}

}  // namespace lamella
