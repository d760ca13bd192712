// Values that change by at most 1 per unit: over a box they differ from the centre's by at most half its
// diagonal.
#include "engine/mesh/distance_grading.h"

#include "engine/base/error.h"
#include "engine/mesh/triangle_tree.h"
#include "engine/solids/closed_slice.h"

namespace lamella {
namespace {

class ValueGrading : public Grading {
  public:
    explicit ValueGrading(FieldPtr field) : field_(std::move(field)) {}
    double at(dvec3 p) const override { return field_->value(p); }
    Interval range(const Box& box) const override {
        if (!std::isfinite(diagonal(box))) return {-infinity, infinity};
        return field_->range(box);
    }

  private:
    FieldPtr field_;
};

class SurfaceDistance : public Grading {
  public:
    explicit SurfaceDistance(TriangleMesh mesh) : mesh_(std::move(mesh)), tree_(mesh_) {
        const Box box = mesh_.bounds();
        extent_ = std::max(glm::length(box.lo), glm::length(box.hi));
    }
    double at(dvec3 p) const override { return tree_.distance(p); }
    Interval range(const Box& box) const override {
        const double half = diagonal(box) / 2;
        if (!std::isfinite(half)) return {0, infinity};
        constexpr double rounding =
            1e-12;  // error of distances, relative to the numbers they are computed from
        const double middle = tree_.distance(box.center());
        const double reach = half + rounding * (middle + half + extent_);
        return {std::max(middle - reach, 0.0), middle + reach};
    }

  private:
    TriangleMesh mesh_;
    TriangleTree tree_;
    double extent_ = 0;  ///< greatest distance of the mesh from the origin
};

}  // namespace

GradingPtr make_value_grading(FieldPtr field) { return std::make_shared<ValueGrading>(std::move(field)); }

GradingPtr make_surface_distance_grading(TriangleMesh mesh) {
    if (mesh.triangles.empty()) throw InputError("a surface without triangles has no distance");
    return std::make_shared<SurfaceDistance>(std::move(mesh));
}

}  // namespace lamella
