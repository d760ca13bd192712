// Layers of formulas: tiles with shortened programs beside brute force, a `.vm` program of 8,000 operations,
// and a gyroid.
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "engine/formula/formula_batch.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/formula/formula_vm.h"
#include "procedural/voronoi/counter_hash.h"

namespace {

using namespace lamella;

const std::vector<std::string> xyz{"x", "y", "z"};

double uniform(int i, int draw, double lo, double hi) {
    const CounterHash hash(5, 1, i, draw, 0);
    return lo + (hi - lo) * hash.uniform(0);
}

std::string number(double v) { return "(" + std::to_string(v) + ")"; }

/// The union of 200 capsules of 1 mm radius, near one plane of a cube of 100 mm.
Formula capsules() {
    std::string text = "min(";
    for (int i = 0; i < 200; ++i) {
        dvec3 a, d;
        for (int axis = 0; axis < 3; ++axis) {
            a[axis] = axis < 2 ? uniform(i, axis, 10, 90) : uniform(i, axis, 49, 51);
            d[axis] = axis < 2 ? uniform(i, axis + 3, -8, 8) : uniform(i, axis + 3, -1, 1);
        }
        const double dd = glm::dot(d, d);
        const auto off = [&](char name, int axis) {
            return "(" + std::string(1, name) + "-" + number(a[axis]) + ")";
        };
        const std::string x = off('x', 0), y = off('y', 1), z = off('z', 2);
        const std::string t = "clamp((" + x + "*" + number(d.x) + "+" + y + "*" + number(d.y) + "+" + z +
                              "*" + number(d.z) + ")/" + number(dd) + ",0,1)";
        text += std::string(i > 0 ? "," : "") + "length(" + x + "-" + t + "*" + number(d.x) + "," + y + "-" +
                t + "*" + number(d.y) + "," + z + "-" + t + "*" + number(d.z) + ")-1";
    }
    return parse_formula(text + ")", xyz);
}

/// `.vm` text of lettering: glyphs of strokes and bowls, each a maximum of lines and circles, as CAD text is.
std::string lettering() {
    std::string text = "# lettering\n_x var-x\n_y var-y\n";
    int next = 0;
    const auto add = [&](const std::string& operation) {
        const std::string label = "_" + std::to_string(next++);
        text += label + " " + operation + "\n";
        return label;
    };
    const auto value = [&](double v) { return add("const " + std::to_string(v)); };
    const auto offset = [&](const char* axis, double at) {
        return add(std::string("sub ") + axis + " " + value(at));
    };
    const auto box = [&](double x0, double y0, double x1, double y1) {
        const auto side = [&](const char* axis, double lo, double hi) {
            return add("max " + add("neg " + offset(axis, lo)) + " " + offset(axis, hi));
        };
        return add("max " + side("_x", x0, x1) + " " + side("_y", y0, y1));
    };
    const auto disc = [&](double x, double y, double r) {
        const std::string squares =
            add("add " + add("square " + offset("_x", x)) + " " + add("square " + offset("_y", y)));
        return add("sub " + add("sqrt " + squares) + " " + value(r));
    };
    const auto bowl = [&](double x, double y, double outer, double inner) {
        return add("max " + disc(x, y, outer) + " " + add("neg " + disc(x, y, inner)));
    };
    std::string all;
    for (int row = 0; row < 16; ++row) {
        for (int column = 0; column < 17; ++column) {
            const int i = row * 17 + column;
            const double x = 1 + 5.8 * column + uniform(i, 0, 0, 1), y = 1 + 6.1 * row + uniform(i, 1, 0, 1);
            std::string glyph = box(x, y, x + 0.9, y + 5);
            glyph = add("min " + glyph + " " + bowl(x + 1.4, y + 3.4, 1.6, 0.8 + uniform(i, 2, 0, 0.2)));
            glyph = add("min " + glyph + " " + box(x + 0.5, y, x + 3.2, y + 0.5 + uniform(i, 3, 0, 0.4)));
            all = all.empty() ? glyph : add("min " + all + " " + glyph);
        }
    }
    return text;
}

const char* const gyroid = "max(sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x), x*x + y*y + z*z - 2400)";

RowBand whole_layer(int pixels, double side, double origin) {
    RowBand band;
    band.along_origin = band.across_origin = origin;
    band.along_pitch = band.across_pitch = side / pixels;
    band.hi = pixels;
    return band;
}

/// The spans of one layer in bands of 128 rows, as masks ask for them.
void spans_of(benchmark::State& state, const FieldPtr& field, double z, int pixels, double side,
              double origin) {
    Scratch scratch;
    RunRows rows;
    std::int64_t length = 0;
    for (auto _ : state) {
        SliceContext context;
        const SliceField& slice = context.slice(*field, z);
        RowBand band = whole_layer(pixels, side, origin);
        for (band.first = 0; band.first < pixels; band.first += 128) {
            band.count = std::min(128, pixels - band.first);
            slice.runs(band, scratch, rows);
            length += rows.total_length();
        }
    }
    benchmark::DoNotOptimize(length);
    state.counters["solid"] =
        static_cast<double>(length) / run_unit / static_cast<double>(state.iterations()) / pixels / pixels;
    state.counters["Mpx/s"] = benchmark::Counter(
        1e-6 * pixels * pixels * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void formula_prune_2k(benchmark::State& state) {
    const FieldPtr field = make_formula_field(capsules(), {}, {dvec3(0), dvec3(100)});
    spans_of(state, field, 50, 2048, 100, 0);
}
BENCHMARK(formula_prune_2k)->Unit(benchmark::kMillisecond);

/// Every pixel of every 64th row by the batch evaluator; `time` stands for 1/64 of the layer.
void formula_brute_2k(benchmark::State& state) {
    const Formula formula = capsules();
    const RowBand band = whole_layer(2048, 100, 0);
    FormulaBatch batch;
    batch.prepare({formula.instructions(), formula.constants()});
    std::vector<double> x, out(512);
    for (int i = 0; i < 2048; ++i) x.push_back(band.along(256.0 * i + 128));
    const double z = 50;
    int inside = 0;
    for (auto _ : state) {
        for (int row = 0; row < 2048; row += 64) {
            const double y = (row + 0.5) * band.across_pitch;
            for (std::size_t i = 0; i < 2048; i += 512) {
                const BatchInput inputs[3] = {
                    {x.data() + i, false, true}, {&y, false, false}, {&z, false, false}};
                batch.run(inputs, 1, 512, out);
                for (const double v : out) inside += v < 0;
            }
        }
    }
    benchmark::DoNotOptimize(inside);
    state.counters["Mpx/s"] = benchmark::Counter(1e-6 * 2048 * 32 * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate);
}
BENCHMARK(formula_brute_2k)->Unit(benchmark::kMillisecond);

void formula_vm_1k(benchmark::State& state) {
    const Formula formula = read_vm(lettering(), "lettering.vm");
    state.counters["operations"] = static_cast<double>(formula.size());
    const FieldPtr field = make_formula_field(formula, {}, {{0, 0, -1}, {100, 100, 1}});
    spans_of(state, field, 0.1, 1024, 100, 0);
}
BENCHMARK(formula_vm_1k)->Unit(benchmark::kMillisecond);

void formula_gyroid(benchmark::State& state) {
    const FieldPtr field = make_formula_field(parse_formula(gyroid, xyz), {}, {dvec3(-50), dvec3(50)});
    spans_of(state, field, 0.3, static_cast<int>(state.range(0)), 100, -50);
}
BENCHMARK(formula_gyroid)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond);

}  // namespace
