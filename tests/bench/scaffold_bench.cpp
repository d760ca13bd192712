// Scaffolds of many points: how the time grows with their number.
#include <benchmark/benchmark.h>

#include <cmath>

#include "procedural/scaffold/scaffold_synthesis.h"

namespace {

using namespace lamella;

/// A ceiling at 45 mm with a ball every 30 mm hanging half out of it, and columns between them: as much part
/// for each point, however many there are.
class Hall : public Field {
  public:
    explicit Hall(double side) : side_(side) {}
    double value(dvec3 p) const override {
        const dvec2 ball = dvec2(p) - nearest(dvec2(p), 15), column = dvec2(p) - nearest(dvec2(p), 0);
        const double to_ball = std::sqrt(glm::dot(ball, ball) + (p.z - 44) * (p.z - 44)) - 9;
        const double to_column = std::sqrt(glm::dot(column, column)) - 2;
        return std::min(45 - p.z, std::min(to_ball, to_column));
    }
    Metric metric() const override { return Metric::exact; }
    Box bounds() const override { return {{-2, -2, 0}, {side_ + 2, side_ + 2, 50}}; }

  private:
    static dvec2 nearest(dvec2 p, double first) {
        const dvec2 steps = (p - first) / 30.0;
        return dvec2(std::round(steps.x), std::round(steps.y)) * 30.0 + first;
    }
    double side_;
};

/// Points 3 mm apart under all of it.
std::vector<SupportPoint> points_under(const Hall& hall, std::size_t count, int side) {
    std::vector<SupportPoint> points;
    for (int i = 0; points.size() < count; ++i) {
        const double x = 3.0 * (i % side) + 0.5 * (i / side % 3), y = 3.0 * (i / side);
        double z = 45;
        while (z > 0 && hall.value({x, y, z - 0.2}) <= 0) z -= 0.2;
        if (z > 1) points.push_back({{x, y, z}, SupportReason::overhang});
    }
    return points;
}

void scaffold(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0));
    const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    const Hall hall(3.0 * side);
    const std::vector<SupportPoint> points = points_under(hall, count, side);
    Scaffold scaffold;
    for (auto _ : state) scaffold = build_scaffold(points, hall, ScaffoldShape{});
    state.counters["bars"] = static_cast<double>(scaffold.bars.size());
    state.counters["pillars"] = static_cast<double>(scaffold.pillars.size());
    state.counters["unheld"] = static_cast<double>(scaffold.unheld.size());
}
BENCHMARK(scaffold)->Arg(100)->Arg(500)->Arg(2000)->Arg(10000)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
