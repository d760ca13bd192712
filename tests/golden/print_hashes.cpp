// Prints a hash of the runs, contours and masks of some layers, and of the designs that searches end with,
// under every SIMD target of this machine. Compilers, optimisation levels and machines must all print the
// same.
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>

#include "engine/base/simd_target.h"
#include "engine/contours/coverage.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_grading.h"
#include "engine/formula/formula_parser.h"
#include "engine/io/mesh_reader.h"
#include "engine/layers/layer.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "procedural/appearance/appearance_optimizer.h"
#include "procedural/foam/closed_foam.h"
#include "procedural/foam/nearest_foam.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/lattice/strut_lattice.h"
#include "procedural/lattice/tpms.h"
#include "procedural/pattern/surface_pattern.h"
#include "tests/procedural/optimization/topology_problems.h"

using namespace lamella;

namespace {

class Hash {
  public:
    template <typename Number>
    void add(Number v) {
        unsigned char bytes[sizeof v];
        std::memcpy(bytes, &v, sizeof v);
        for (const unsigned char b : bytes) state_ = (state_ ^ b) * 1099511628211ULL;
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 14695981039346656037ULL;
};

FieldPtr foam_in(const FieldPtr& body, double cell, double beam, double skin) {
    FoamSettings settings;
    settings.cell = cell;
    settings.beam_radius = beam;
    settings.seed = 7;
    settings.region = body->bounds();
    return make_intersection({body, make_union({make_voronoi_foam(settings), make_shell(body, skin)})});
}

FieldPtr framed_foam(const FieldPtr& body) {
    FoamSettings settings;
    settings.cell = 4;
    settings.beam_radius = 0.3;
    settings.seed = 5;
    settings.region = body->bounds();
    settings.frame = FrameSettings{body, 0.5, true};
    return make_filled_body(body, make_voronoi_foam(settings), 0);
}

FieldPtr gyroid(const Box& region) {
    TpmsSettings settings;
    settings.period = make_constant_grading(4);
    settings.thickness = make_constant_grading(0.8);
    settings.region = region;
    return make_tpms(settings);
}

GradingPtr graded(const char* text, const FieldPtr& body) {
    const std::vector<std::string> names{"x", "y", "z", "d"};
    return make_formula_grading(parse_formula(text, names), {make_depth_grading(body)});
}

FoamSettings graded_settings(const FieldPtr& body) {
    FoamSettings settings;
    settings.cell = graded("clamp(1.5 + 0.1*x + 0.2*sin(y), 1, 4)", body);
    settings.beam_radius = graded("0.1 + 0.02*max(d, 0) + 0.03*exp(-z^2/20)", body);
    settings.seed = 11;
    settings.region = body->bounds();
    return settings;
}

FieldPtr turned_foam(const FieldPtr& body) {
    NearestFoamSettings settings;
    settings.foam = graded_settings(body);
    settings.stretch[2] = graded("1 + 0.1*abs(x)", body);
    settings.turn[1] = graded("5*z", body);
    return std::make_shared<NearestFoam>(settings);
}

/// A skin that is cut by waves, drawn in whole steps.
FieldPtr skin_by_example(const FieldPtr& body) {
    Volume picture;
    picture.size = {96, 96, 1};
    picture.full_scale = 255;
    std::vector<std::uint8_t> grey;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const int wave = (y + x * (24 - x % 24) / 12) % 16;
            grey.push_back(wave < 8 || (x + y) % 31 < 5 ? std::uint8_t{0} : std::uint8_t{255});
        }
    }
    picture.samples = std::move(grey);
    SurfacePatternSettings settings;
    settings.example.size = 12;
    settings.example.strut = 0.8;
    settings.example.gap = 0.4;
    return make_patterned_shell(make_shell(body, 1), std::make_shared<const SurfacePattern>(
                                                         synthesise_on_surface(picture, *body, settings)));
}

std::map<std::string, FieldPtr> solids() {
    const MeshFile koala = read_mesh(LAMELLA_SOURCE_DIR "/examples/models/koala_mm.obj", MeshReadOptions{});
    const FieldPtr ball = make_sphere({0.1, 0.2, 0.3}, 9);
    const FieldPtr koala_body = make_mesh_field(close_mesh(koala.mesh));
    const std::vector<std::string> xyz{"x", "y", "z"};
    return {
        {"closed foam", make_intersection({ball, make_closed_foam({graded_settings(ball), 0.3, 0.4})})},
        {"foam in a frame", framed_foam(koala_body)},
        {"formula", make_formula_field(parse_formula("min(max(x^2 + y^2 + z^2 - 64, 2 - hypot(x, y)), "
                                                     "atan2(sin(x)*cos(y), 1 + z^2) + ln(1 + y^2) - 0.2)",
                                                     xyz),
                                       {}, {dvec3(-9), dvec3(9)})},
        {"graded foam", make_intersection({ball, make_voronoi_foam(graded_settings(ball))})},
        {"graded gyroid",
         make_intersection({ball, make_tpms({TpmsKind::gyroid, false, graded("4 + 0.1*z", ball),
                                             graded("0.6 + 0.02*x", ball), ball->bounds()})})},
        {"graded lattice",
         make_intersection({ball, make_strut_lattice({unit_cell("octet"), graded("3 + 0.1*x", ball),
                                                      graded("0.2 + 0.01*y", ball), ball->bounds()})})},
        {"graded skin", make_filled_body(koala_body, nullptr, graded("0.6 + 0.02*y", koala_body), {0.1, 3})},
        {"nearest foam", make_intersection({ball, turned_foam(ball)})},
        {"primitives",
         make_union({make_torus({0, 0, 0}, 7, 2), make_round_cone({{-6, -6, -3}, 2, {6, 5, 4}, 0.7}),
                     make_cylinder({-5, 4, -4}, {3, -6, 5}, 1.5), make_box({{-8, 3, -2}, {-3, 8, 3}}, 1)})},
        {"gyroid in a ball", make_intersection({ball, gyroid(ball->bounds())})},
        {"skin by example", skin_by_example(make_torus({0, 0, 0}, 6, 2.5))},
        {"smooth union", make_smooth_union(ball, make_sphere({8, 3, 1}, 5), 2)},
        {"foam ball", foam_in(ball, 2, 0.25, 0.7)},
        {"foam koala", foam_in(koala_body, 4, 0.4, 0.8)},
    };
}

std::uint64_t hash_of(const FieldPtr& solid) {
    Hash hash;
    Job job;
    job.part = solid;
    job.bounds = solid->bounds();
    job.layers = equal_layers(job.bounds.size().z, 2.3);
    const dvec3 lo = job.bounds.lo, size = job.bounds.size();
    for (int i = 0; i < job.layers.count(); i += 2) {
        const Layer layer(job, i);
        for (const Axis axis : {Axis::x, Axis::y}) {
            const bool row = axis == Axis::x;
            RowBand band{axis, row ? lo.x : lo.y, 0.05, row ? lo.y : lo.x, 0.05};
            band.sub = 2;
            band.hi = static_cast<int>((row ? size.x : size.y) / 0.05) + 1;
            const int rows = static_cast<int>((row ? size.y : size.x) / 0.05) + 1;
            RunRows runs;
            for (band.first = 0; band.first < rows; band.first += 64) {
                band.count = std::min(64, rows - band.first);
                layer.runs(band, runs);
                for (std::size_t l = 0; l < runs.lines(); ++l) {
                    hash.add(static_cast<std::uint32_t>(runs.line(l).size()));
                    for (const Run& run : runs.line(l)) {
                        hash.add(run.begin);
                        hash.add(run.end);
                    }
                }
            }
        }
        for (const Contour& contour : layer.contours(0.1)) {
            hash.add(contour.parent);
            for (const dvec2 p : contour.points) {
                hash.add(p.x);
                hash.add(p.y);
            }
        }
    }
    return hash.value();
}

template <std::size_t Dim>
std::uint64_t hash_of_search(const TopologyProblem<Dim>& problem, const TopologySettings& settings) {
    TopologyOptimizer<Dim> optimizer(problem, settings);
    while (!optimizer.is_finished()) optimizer.iterate();
    Hash hash;
    for (const double x : optimizer.state().design) hash.add(x);
    return hash.value();
}

std::uint64_t hash_of_appearance() {
    GreyImage stripes(24, 24);
    for (int y = 0; y < stripes.height; ++y) {
        for (int x = 0; x < stripes.width; ++x) stripes.values[stripes.index(x, y)] = (x + y) % 8 < 4 ? 1 : 0;
    }
    AppearanceSettings settings;
    settings.match.neighbourhood = 5;
    settings.levels = 2;
    settings.steps = 3;
    settings.sharpness = 1;
    settings.steps_a_sharpness = 2;
    const auto beam = [](glm::ivec3 size, int) { return half_mbb_beam(size.x, size.y, 0.4); };
    AppearanceOptimizer optimizer(beam, {24, 12, 1}, stripes, 24, settings);
    while (!optimizer.is_finished()) optimizer.iterate();
    Hash hash;
    const AppearanceResult found = optimizer.result();
    for (const double x : found.design) hash.add(x);
    return hash.value();
}

std::map<std::string, std::function<std::uint64_t()>> searches() {
    TopologySettings settings;
    settings.iterations = 6;
    settings.tolerance = 0;
    settings.sharpness = 4;
    settings.iterations_a_sharpness = 2;
    TopologySettings robust = settings;
    robust.method = TopologyMethod::mma;
    robust.density.length_scale = LengthScale{};
    TopologySettings printable = settings;
    printable.density.overhang.emplace();
    printable.iterations = 3;
    return {
        {"appearance", hash_of_appearance},
        {"topology by moving asymptotes", [=] { return hash_of_search(half_mbb_beam(24, 8, 0.5), robust); }},
        {"topology by optimality criteria",
         [=] { return hash_of_search(half_mbb_beam(24, 8, 0.5), settings); }},
        {"topology without overhangs",
         [=] { return hash_of_search(solid_cantilever(8, 4, 4, 0.3, 1e-6), printable); }},
    };
}

}  // namespace

int main() {
    std::map<std::string, std::function<std::uint64_t()>> all = searches();
    for (const auto& [name, solid] : solids()) all[name] = [solid = solid] { return hash_of(solid); };
    std::map<std::string, std::uint64_t> first;
    bool same = true;
    for (const std::string& target : simd_targets()) {
        force_simd_target(target);
        for (const auto& [name, make_hash] : all) {
            const std::uint64_t hash = make_hash();
            const auto [place, added] = first.try_emplace(name, hash);
            if (added) std::printf("%016llx %s\n", static_cast<unsigned long long>(hash), name.c_str());
            if (place->second != hash) {
                std::fprintf(stderr, "%s differs on %s\n", name.c_str(), target.c_str());
                same = false;
            }
        }
    }
    return same ? 0 : 1;
}
