// A layer of periodic surfaces and of strut lattices, 2048 x 2048 pixels on one core.
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/lattice/strut_lattice.h"
#include "procedural/lattice/tpms.h"

namespace {

using namespace lamella;

constexpr int side = 2048;
constexpr double pitch = 0.05;      // mm
constexpr double ball_radius = 50;  // mm
constexpr double plane = 3.7;       // mm

/// base + slope * x
class Slope : public Grading {
  public:
    Slope(double base, double slope) : base_(base), slope_(slope) {}
    double at(dvec3 p) const override { return base_ + slope_ * p.x; }
    Interval range(const Box& box) const override {
        const double a = base_ + slope_ * box.lo.x, b = base_ + slope_ * box.hi.x;
        return {std::min(a, b), std::max(a, b)};
    }

  private:
    double base_, slope_;
};

Box region() { return {dvec3(-ball_radius), dvec3(ball_radius)}; }

/// Spans of the layer in bands of 64 rows; counts pixels per second.
void layer_spans(benchmark::State& state, const FieldPtr& solid) {
    Scratch scratch;
    RunRows rows;
    std::size_t runs = 0;
    for (auto _ : state) {
        runs = 0;
        SliceContext context;
        const SliceField& slice = context.slice(*solid, plane);
        RowBand band{Axis::x, -side * pitch / 2, pitch, -side * pitch / 2, pitch};
        band.hi = side;
        band.count = 64;
        for (band.first = 0; band.first < side; band.first += 64) {
            slice.runs(band, scratch, rows);
            runs += rows.runs().size();
        }
    }
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["pixels"] = benchmark::Counter(static_cast<double>(state.iterations()) * side * side,
                                                  benchmark::Counter::kIsRate);
}

void tpms_2k(benchmark::State& state, TpmsKind kind, const GradingPtr& period, const GradingPtr& thickness) {
    const FieldPtr ball = make_sphere(dvec3(0), ball_radius);
    layer_spans(state, make_intersection({ball, make_tpms({kind, false, period, thickness, region()})}));
}

GradingPtr constant(double v) { return make_constant_grading(v); }
GradingPtr slope(double base, double slope) { return std::make_shared<Slope>(base, slope); }

BENCHMARK_CAPTURE(tpms_2k, gyroid, TpmsKind::gyroid, constant(4), constant(0.5))
    ->Unit(benchmark::kMillisecond)
    ->Name("tpms_gyroid_2k");
BENCHMARK_CAPTURE(tpms_2k, neovius, TpmsKind::neovius, constant(4), constant(0.3))
    ->Unit(benchmark::kMillisecond)
    ->Name("tpms_neovius_2k");
BENCHMARK_CAPTURE(tpms_2k, graded_thickness, TpmsKind::gyroid, constant(4), slope(0.5, 0.005))
    ->Unit(benchmark::kMillisecond)
    ->Name("tpms_gyroid_graded_thickness_2k");
BENCHMARK_CAPTURE(tpms_2k, graded_period, TpmsKind::gyroid, slope(4, 0.02), constant(0.5))
    ->Unit(benchmark::kMillisecond)
    ->Name("tpms_gyroid_graded_period_2k");

/// An octet lattice of 4 mm cells, or of 2 to 8 mm, with the beams of the layer found anew each time.
void octet_lattice_2k(benchmark::State& state) {
    const bool graded = state.range(0) != 0;
    const auto lattice = make_strut_lattice(
        {unit_cell("octet"), graded ? slope(5, 0.06) : constant(4), constant(0.3), region()});
    layer_spans(state, make_intersection({make_sphere(dvec3(0), ball_radius), lattice}));
}
BENCHMARK(octet_lattice_2k)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
