// The mesh field and its offsets.
#include "engine/mesh/mesh_field.h"

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"
#include "engine/mesh/graded_mesh.h"
#include "engine/mesh/grown_mesh.h"
#include "engine/mesh/mesh_section.h"
#include "engine/mesh/round_triangle_tree.h"
#include "engine/solids/closed_slice.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"

namespace lamella {
namespace {

/// Data that a mesh's field and its offsets share.
struct MeshData {
    explicit MeshData(SolidMesh closed)
        : solid(std::make_shared<const SolidMesh>(std::move(closed))),
          tree(solid->mesh),
          bounds(solid->mesh.bounds()) {
        const TriangleMesh& mesh = solid->mesh;
        std::vector<Interval> heights;
        heights.reserve(mesh.triangles.size());
        for (const auto& t : mesh.triangles) {
            const double a = mesh.vertices[t[0]].z, b = mesh.vertices[t[1]].z, c = mesh.vertices[t[2]].z;
            heights.push_back({std::min(a, std::min(b, c)), std::max(a, std::max(b, c))});
        }
        by_height = IntervalIndex(heights, std::vector<double>(heights.size(), 0.0));
    }

    std::shared_ptr<const SolidMesh> solid;
    TriangleTree tree;
    IntervalIndex by_height;
    Box bounds;
};

using MeshDataPtr = std::shared_ptr<const MeshData>;

class MeshSlice : public SampledSlice {
  public:
    MeshSlice(const Field& field, const MeshData& data, double z)
        : SampledSlice(field, z), section_(section(data, z)) {}
    void runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const override {
        section_.runs(band, out);
    }
    Rect bounds() const override { return section_.bounds(); }

  private:
    static MeshSection section(const MeshData& data, double z) {
        std::vector<std::uint32_t> triangles;
        data.by_height.query({z, z}, triangles);
        return MeshSection(data.solid->mesh, triangles, z);
    }
    MeshSection section_;
};

/// All points within a fixed distance of a mesh's surface.
class GrownMeshField : public Field {
  public:
    GrownMeshField(MeshDataPtr data, double distance, bool inside_only)
        : data_(std::move(data)), distance_(distance), grown_(data_->solid, distance, inside_only) {}
    double value(dvec3 p) const override { return data_->tree.distance(p) - distance_; }
    Interval range(const Box& box) const override { return lipschitz_range(*this, box); }
    Metric metric() const override { return Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<GrownMeshSlice>(*this, grown_, z);
    }
    Box bounds() const override { return grown(data_->bounds, distance_); }

  private:
    MeshDataPtr data_;
    double distance_;
    GrownMesh grown_;
};

/// All points within a distance of a mesh's surface that varies over it.
class GradedMeshShell : public Field {
  public:
    GradedMeshShell(const SolidMesh& solid, GradedMesh graded, bool inside_only)
        : solid_(std::make_shared<const SolidMesh>(divided(solid, std::move(graded.mesh)))),
          radii_(graded.numbers),
          tree_(solid_->mesh, radii_),
          grown_(solid_, std::move(graded.numbers), tree_, inside_only) {}
    double value(dvec3 p) const override { return tree_.distance(p); }
    Interval range(const Box& box) const override { return lipschitz_range(*this, box); }
    Metric metric() const override { return Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<GrownMeshSlice>(*this, grown_, z);
    }
    Box bounds() const override { return tree_.bounds(); }

  private:
    static SolidMesh divided(const SolidMesh& solid, TriangleMesh mesh) {
        SolidMesh divided;
        divided.mesh = std::move(mesh);
        divided.oriented_manifold = solid.oriented_manifold;
        return divided;
    }

    std::shared_ptr<const SolidMesh> solid_;
    std::vector<double> radii_;
    RoundTriangleTree tree_;
    GrownMesh grown_;
};

class MeshField : public Field, public ShellMaker {
  public:
    explicit MeshField(MeshDataPtr data) : data_(std::move(data)) {}

    double value(dvec3 p) const override { return value_within(p, infinity); }
    double value_within(dvec3 p, double limit) const override {
        const double d = data_->tree.distance(p, limit);
        return data_->tree.winding(p) != 0 ? -d : d;
    }
    bool clear_of_surface(dvec3 p, double distance) const override {
        return !data_->tree.any_within(p, distance);
    }
    Interval range(const Box& box) const override { return lipschitz_range(*this, box); }
    // Only a bound, because triangles inside the solid, where shells overlap, count too.
    Metric metric() const override { return Metric::bound; }
    FieldPtr offset(double d) const override {
        if (d == 0) return shared_from_this();
        auto band = std::make_shared<GrownMeshField>(data_, std::abs(d), d < 0);
        return d > 0 ? make_union({shared_from_this(), band}) : make_difference(shared_from_this(), band);
    }
    FieldPtr shell(double thickness) const override {
        return std::make_shared<GrownMeshField>(data_, thickness, true);
    }
    FieldPtr graded_shell(const Grading& thickness) const override { return graded_band(thickness, true); }
    FieldPtr graded_outer_shell(const Grading& thickness) const override {
        return graded_band(thickness, false);
    }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<MeshSlice>(*this, *data_, z);
    }
    Box bounds() const override { return data_->bounds; }

  private:
    FieldPtr graded_band(const Grading& thickness, bool inside_only) const {
        GradedMesh graded = read_on_mesh(thickness, data_->solid->mesh);
        const auto& radii = graded.numbers;
        if (std::all_of(radii.begin(), radii.end(), [](double r) { return r == 0; })) return make_empty();
        return std::make_shared<GradedMeshShell>(*data_->solid, std::move(graded), inside_only);
    }

    MeshDataPtr data_;
};

}  // namespace

FieldPtr make_mesh_field(SolidMesh mesh) {
    if (mesh.mesh.triangles.empty()) throw InputError("a mesh without triangles encloses nothing");
    return std::make_shared<MeshField>(std::make_shared<const MeshData>(std::move(mesh)));
}

}  // namespace lamella
