// Closest points through a tree whose nodes store the attribute's range.
#include "procedural/grading/attribute_grading.h"

#include "engine/base/error.h"
#include "engine/mesh/triangle_tree.h"

namespace lamella {
namespace {

/// Relative rounding error that distances and interpolated values are allowed.
constexpr double color_rounding = 1e-12;

class AttributeGrading : public Grading {
  public:
    AttributeGrading(AttributedMesh surface, double scale)
        : mesh_(std::move(surface.mesh)), values_(std::move(surface.values)), tree_(mesh_) {
        for (double& value : values_) value *= scale;
        for (const auto& t : mesh_.triangles) slopes_.push_back(slope(t));
        summarise();
    }

    double at(dvec3 p) const override { return value(tree_.closest(p)); }

    /// The closest point on a convex set moves no farther than the query point. So, over all points of the
    /// box, the closest points on a triangle lie within the box's half diagonal of the one for its centre,
    /// and only triangles that can be closest to some point of the box count.
    Interval range(const Box& box) const override {
        const dvec3 centre = box.center();
        const double half = std::sqrt(glm::dot(box.size(), box.size())) / 2;
        if (!std::isfinite(half)) return over_nodes_[0];
        const SurfacePoint nearest = tree_.closest(centre);
        const double error =
            color_rounding * (nearest.distance + half + largest(mesh_box().lo, mesh_box().hi));
        Search search{box, centre, half + error, nearest.distance + half + error, {}};
        const double v = value(nearest);
        search.found = std::isnan(v) ? Interval{infinity, infinity} : Interval{v, v};
        visit(search, 0);
        return search.found;
    }

  private:
    struct Search {
        Box box;
        dvec3 centre;
        double half;   ///< maximum distance of a point of the box from its centre
        double reach;  ///< upper bound of the distance of the box's points from the surface
        Interval found;
    };

    const Box& mesh_box() const { return tree_.nodes()[0].box; }

    static double largest(dvec3 a, dvec3 b) {
        const dvec3 m = glm::max(glm::abs(a), glm::abs(b));
        return std::max({m.x, m.y, m.z});
    }

    double value(const SurfacePoint& at) const {
        const auto& t = mesh_.triangles[at.triangle];
        const double a = values_[t[0]], b = values_[t[1]], c = values_[t[2]];
        const double v = a * at.weights.x + b * at.weights.y + c * at.weights.z;
        if (std::isnan(v)) return v;
        // A weighted mean lies between its parts, even after rounding: equal corners give their number
        // exactly.
        return std::min(std::max(v, std::min({a, b, c})), std::max({a, b, c}));
    }

    Interval of_triangle(std::uint32_t triangle) const {
        Interval range;
        for (const std::uint32_t v : mesh_.triangles[triangle]) {
            range.lo = std::min(range.lo, values_[v]);  // a NaN compares false
            range.hi = std::isnan(values_[v]) ? infinity : std::max(range.hi, values_[v]);
        }
        return range;
    }

    /// Upper bound of the change of the attribute within a triangle.
    struct Slope {
        double value;       ///< number per mm; infinite for a triangle without area
        double narrowness;  ///< 1/mm; 1 / height over the longest side, which magnifies rounding errors
    };

    Slope slope(const std::array<std::uint32_t, 3>& t) const {
        const dvec3 a = mesh_.vertices[t[0]], ab = mesh_.vertices[t[1]] - a, ac = mesh_.vertices[t[2]] - a;
        const double vb = values_[t[1]] - values_[t[0]], vc = values_[t[2]] - values_[t[0]];
        const dvec3 n = glm::cross(ab, ac), along = ac * vb - ab * vc, bc = ac - ab;
        const double nn = glm::dot(n, n);
        const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
        const double steepest = std::sqrt(glm::dot(along, along) / nn);
        return {std::isnan(steepest) ? infinity : steepest, nn > 0 ? std::sqrt(longest / nn) : infinity};
    }

    void summarise() {
        const auto& nodes = tree_.nodes();
        over_nodes_.resize(nodes.size());
        for (std::size_t i = nodes.size(); i-- > 0;) {
            const auto& node = nodes[i];
            Interval& range = over_nodes_[i];
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                widen(range, of_triangle(tree_.order()[k]));
            }
            if (node.count > 0) continue;
            widen(range, over_nodes_[i + 1]);
            widen(range, over_nodes_[node.first]);
        }
    }

    static void widen(Interval& range, Interval by) {
        range = {std::min(range.lo, by.lo), std::max(range.hi, by.hi)};
    }

    void visit(Search& search, std::uint32_t number) const {
        const TriangleTree::Node& node = tree_.nodes()[number];
        const Interval below = over_nodes_[number];
        if (search.found.lo <= below.lo && below.hi <= search.found.hi) return;
        if (distance(search.box, node.box) > search.reach) return;
        const dvec3 size = node.box.size();
        // Nodes that are small compared to the box are not worth descending into.
        if (glm::dot(size, size) * 64 < search.half * search.half) {
            widen(search.found, below);
        } else if (node.count == 0) {
            visit(search, number + 1);
            visit(search, node.first);
        } else {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                visit_triangle(search, tree_.order()[k]);
            }
        }
    }

    void visit_triangle(Search& search, std::uint32_t triangle) const {
        const auto& t = mesh_.triangles[triangle];
        SurfacePoint at =
            closest_point(search.centre, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
        if (at.distance > search.reach + search.half) return;
        at.triangle = triangle;
        const Interval whole = of_triangle(triangle);
        const double v = value(at);
        const double farthest = at.distance + search.half;
        const double most = slopes_[triangle].value * search.half +
                            color_rounding * (1 + slopes_[triangle].narrowness * farthest) *
                                (std::abs(whole.lo) + std::abs(whole.hi));
        if (std::isnan(v) || !(most < infinity)) return widen(search.found, whole);
        widen(search.found, {std::max(whole.lo, v - most), std::min(whole.hi, v + most)});
    }

    TriangleMesh mesh_;
    std::vector<double> values_;
    TriangleTree tree_;
    std::vector<Slope> slopes_;         ///< by triangle
    std::vector<Interval> over_nodes_;  ///< range of the attribute, by node
};

}  // namespace

GradingPtr make_attribute_grading(AttributedMesh surface, double scale) {
    if (!std::isfinite(scale)) throw InputError("the scale of a mesh attribute must be a finite number");
    if (surface.mesh.triangles.empty()) throw InputError("a mesh attribute needs at least one triangle");
    if (surface.values.size() != surface.mesh.vertices.size()) {
        throw InputError("a mesh attribute needs one number a vertex");
    }
    return std::make_shared<AttributeGrading>(std::move(surface), scale);
}

GradingPtr make_attribute_grading(const std::string& path, const std::string& attribute, double unit_mm,
                                  double scale) {
    return make_attribute_grading(read_ply_attribute(path, attribute, unit_mm), scale);
}

}  // namespace lamella
