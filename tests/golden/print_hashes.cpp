// Prints a hash of the runs, contours and masks of some layers, under every SIMD target of this machine.
// Compilers, optimisation levels and machines must all print the same.
#include <cstdio>
#include <cstring>
#include <map>

#include "engine/coverage.h"
#include "engine/csg.h"
#include "engine/layer.h"
#include "engine/mesh_field.h"
#include "engine/mesh_reader.h"
#include "engine/primitives.h"
#include "engine/shell.h"
#include "engine/simd_target.h"
#include "procedural/tpms.h"
#include "procedural/voronoi_foam.h"

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

FieldPtr gyroid(const Box& region) {
    TpmsSettings settings;
    settings.period = make_constant_grading(4);
    settings.thickness = make_constant_grading(0.8);
    settings.region = region;
    return make_tpms(settings);
}

std::map<std::string, FieldPtr> solids() {
    const MeshFile koala = read_mesh(LAMELLA_SOURCE_DIR "/examples/models/koala_mm.obj", MeshReadOptions{});
    const FieldPtr ball = make_sphere({0.1, 0.2, 0.3}, 9);
    return {
        {"primitives",
         make_union({make_torus({0, 0, 0}, 7, 2), make_round_cone({{-6, -6, -3}, 2, {6, 5, 4}, 0.7}),
                     make_cylinder({-5, 4, -4}, {3, -6, 5}, 1.5), make_box({{-8, 3, -2}, {-3, 8, 3}}, 1)})},
        {"gyroid in a ball", make_intersection({ball, gyroid(ball->bounds())})},
        {"smooth union", make_smooth_union(ball, make_sphere({8, 3, 1}, 5), 2)},
        {"foam ball", foam_in(ball, 2, 0.25, 0.7)},
        {"foam koala", foam_in(make_mesh_field(close_mesh(koala.mesh)), 4, 0.4, 0.8)},
    };
}

std::uint64_t hash_of(const FieldPtr& solid) {
    Hash hash;
    Job job;
    job.part = solid;
    job.bounds = solid->bounds();
    job.layer_height = 2.3;
    job.layer_count = count_layers(job.bounds.size().z, job.layer_height);
    const dvec3 lo = job.bounds.lo, size = job.bounds.size();
    for (int i = 0; i < job.layer_count; i += 2) {
        const Layer layer(job, i);
        for (const Axis axis : {Axis::x, Axis::y}) {
            const bool row = axis == Axis::x;
            RowBand band{axis, row ? lo.x : lo.y, 0.05, row ? lo.y : lo.x, 0.05};
            band.sub = 2;
            band.hi = static_cast<int>((row ? size.x : size.y) / 0.05) + 1;
            const int rows = static_cast<int>((row ? size.y : size.x) / 0.05) + 1;
            SpanRows runs;
            for (band.first = 0; band.first < rows; band.first += 64) {
                band.count = std::min(64, rows - band.first);
                layer.spans(band, runs);
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

}  // namespace

int main() {
    const auto all = solids();
    std::map<std::string, std::uint64_t> first;
    bool same = true;
    for (const std::string& target : simd_targets()) {
        force_simd_target(target);
        for (const auto& [name, solid] : all) {
            const std::uint64_t hash = hash_of(solid);
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
