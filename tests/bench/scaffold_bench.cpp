// Scaffolds of many points: how the time grows with their number.
#include <benchmark/benchmark.h>

#include <cmath>

#include "engine/csg.h"
#include "engine/primitives.h"
#include "procedural/scaffold_synthesis.h"

namespace {

using namespace lamella;

/// Points 3 mm apart under a ceiling of balls over a square plate, with columns in between.
struct Hall {
    FieldPtr part;
    std::vector<SupportPoint> points;
};

Hall hall(std::size_t count) {
    const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    const double width = 3.0 * side;
    std::vector<FieldPtr> solids{make_box({{-1, -1, 45}, {width + 1, width + 1, 50}})};
    for (double y = 15; y < width; y += 30) {
        for (double x = 15; x < width; x += 30) {
            solids.push_back(make_sphere({x, y, 44}, 9));
            solids.push_back(make_cylinder({x + 15, y + 15, 0}, {x + 15, y + 15, 46}, 2));
        }
    }
    Hall made{make_union(solids), {}};
    for (int i = 0; made.points.size() < count; ++i) {
        const double x = 3.0 * (i % side) + 0.5 * (i / side % 3), y = 3.0 * (i / side);
        double z = 45;
        while (z > 0 && made.part->value({x, y, z - 0.2}) <= 0) z -= 0.2;
        made.points.push_back({{x, y, z}, SupportReason::overhang});
    }
    return made;
}

void scaffold(benchmark::State& state) {
    const Hall made = hall(static_cast<std::size_t>(state.range(0)));
    Scaffold scaffold;
    for (auto _ : state) scaffold = build_scaffold(made.points, *made.part, ScaffoldShape{});
    state.counters["bars"] = static_cast<double>(scaffold.bars.size());
    state.counters["pillars"] = static_cast<double>(scaffold.pillars.size());
    state.counters["unheld"] = static_cast<double>(scaffold.unheld.size());
}
BENCHMARK(scaffold)->Arg(100)->Arg(500)->Arg(2000)->Arg(10000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
