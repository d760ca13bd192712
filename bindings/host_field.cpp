// Fields and gradings from callbacks, which are called for many points at a time.
#include "bindings/host_field.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "bindings/context.h"
#include "engine/field/range_about.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "recipe/identity.h"

namespace lamella {
namespace {

/// A callback that evaluates points.
struct HostValues {
    std::int32_t (*function)(void*, const double*, std::size_t, double*);
    lamella_range enclosing;  ///< may be null
    void* user;
    std::string what;  ///< for messages

    /// Encloses the values in a box; infinite when the program gives no range.
    Interval range(const Box& box) const {
        Interval found{-infinity, infinity};
        if (enclosing == nullptr) return found;
        check_callback(enclosing(user, &box.lo.x, &box.hi.x, &found.lo, &found.hi), what);
        if (!(found.lo <= found.hi)) throw FaultError(what + " gives a range that is none");
        return found;
    }
    void operator()(std::span<const dvec3> points, std::span<double> out) const {
        static_assert(sizeof(dvec3) == 3 * sizeof(double));
        if (!points.empty())
            check_callback(function(user, &points.front().x, points.size(), out.data()), what);
    }
    double at(dvec3 p) const {
        double value = 0;
        (*this)({&p, 1}, {&value, 1});
        return value;
    }
};

class HostField : public Field {
  public:
    HostField(HostValues values, const Box& box, Metric metric)
        : values_(std::move(values)), box_(box), metric_(metric) {}

    double value(dvec3 p) const override { return cut(p, values_.at(p)); }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        values_(points, out);
        for (std::size_t i = 0; i < points.size(); ++i) out[i] = cut(points[i], out[i]);
    }
    Interval range(const Box& box) const override {
        Interval enclosing;
        ranges({&box, 1}, {&enclosing, 1});
        return enclosing;
    }
    void ranges(std::span<const Box> boxes, std::span<Interval> out) const override {
        std::vector<double> at_centers(boxes.size());
        if (metric_ != Metric::sign) {
            std::vector<dvec3> centers;
            // An empty box has no centre; its range is not used.
            for (const Box& box : boxes) centers.push_back((box.empty() ? box_ : box).center());
            values(centers, at_centers);
        }
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Interval told = values_.range(boxes[i]),
                           known = range_about(boxes[i], at_centers[i], metric_);
            // The value is the maximum of the callback's and the distance to the box's faces, at which the
            // solid is cut off.
            const Interval faces = faces_range(boxes[i]);
            out[i] = {std::max({told.lo, known.lo, faces.lo}),
                      std::min(std::max(told.hi, faces.hi), known.hi)};
        }
    }
    Metric metric() const override { return metric_; }
    bool takes_many() const override { return true; }
    Box bounds() const override { return box_; }

  private:
    /// Cuts the solid off at the box.
    double cut(dvec3 p, double value) const {
        const dvec3 beyond = glm::max(box_.lo - p, p - box_.hi);
        const double faces = std::max({beyond.x, beyond.y, beyond.z});
        return std::isnan(value) ? infinity : std::max(value, faces);
    }
    Interval faces_range(const Box& box) const {
        const dvec3 least = glm::max(box_.lo - box.hi, box.lo - box_.hi),
                    most = glm::max(box_.lo - box.lo, box.hi - box_.hi);
        return {std::max({least.x, least.y, least.z}), std::max({most.x, most.y, most.z})};
    }

    HostValues values_;
    Box box_;
    Metric metric_;
};

class HostGrading : public Grading {
  public:
    HostGrading(HostValues values, Interval range) : values_(std::move(values)), range_(range) {}
    double at(dvec3 p) const override {
        double number = 0;
        numbers({&p, 1}, {&number, 1});
        return number;
    }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        values_(points, out);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!std::isfinite(out[i])) {
                const dvec3 p = points[i];
                throw FaultError(
                    fmt::format("{} gives no finite number at ({}, {}, {}) mm", values_.what, p.x, p.y, p.z));
            }
            out[i] = std::clamp(out[i], range_.lo, range_.hi);
        }
    }
    Interval range(const Box& box) const override {
        const Interval told = values_.range(box);
        return {std::clamp(told.lo, range_.lo, range_.hi), std::clamp(told.hi, range_.lo, range_.hi)};
    }

  private:
    HostValues values_;
    Interval range_;
};

const char* known_identity(const char* identity, const char* what) {
    if (identity == nullptr) throw BadCall(std::string(what) + ": identity is a null pointer");
    return identity;
}

Metric metric_of(std::int32_t metric) {
    switch (metric) {
        case LAMELLA_SIGN:
            return Metric::sign;
        case LAMELLA_BOUND:
            return Metric::bound;
        case LAMELLA_EXACT:
            return Metric::exact;
        default:
            throw BadCall(fmt::format("field: there is no metric {}", metric));
    }
}

}  // namespace

HostGiven<FieldPtr> host_field(const lamella_field& field, const std::string& name) {
    if (field.values == nullptr) throw BadCall("field: values is a null pointer");
    Box box;
    box.lo = {field.lower[0], field.lower[1], field.lower[2]};
    box.hi = {field.upper[0], field.upper[1], field.upper[2]};
    const dvec3 size = box.size();
    if (!(size.x > 0 && size.y > 0 && size.z > 0) || !std::isfinite(size.x + size.y + size.z))
        throw BadCall("field: upper must lie above lower along x, y and z, both finite");
    const std::string identity = known_identity(field.identity, "field");
    return {std::make_shared<HostField>(HostValues{field.values, field.range, field.user,
                                                   fmt::format("the program's field `{}`", name)},
                                        box, metric_of(field.metric)),
            fmt::format("{} {} {} {} {} {} {} {}", identity, field.metric, box.lo.x, box.lo.y, box.lo.z,
                        box.hi.x, box.hi.y, box.hi.z)};
}

HostGiven<GradingPtr> host_grading(const lamella_grading& grading, const std::string& name) {
    if (grading.values == nullptr) throw BadCall("grading: values is a null pointer");
    if (!(grading.least <= grading.greatest) || !std::isfinite(grading.greatest - grading.least))
        throw BadCall("grading: greatest must be at least `least`, both finite");
    const std::string identity = known_identity(grading.identity, "grading");
    return {std::make_shared<HostGrading>(HostValues{grading.values, grading.range, grading.user,
                                                     fmt::format("the program's grading `{}`", name)},
                                          Interval{grading.least, grading.greatest}),
            fmt::format("{} {} {}", identity, grading.least, grading.greatest)};
}

HostGiven<FieldPtr> host_mesh(const lamella_mesh& given, const std::string& name) {
    constexpr std::size_t most = std::size_t{1} << 31;
    if (given.vertex_count == 0 || given.vertex_count > most || given.triangle_count == 0 ||
        given.triangle_count > most)
        throw BadCall("mesh: vertices and triangles must be from 1 to 2^31");
    const double* vertices = &wanted(given.vertices, "mesh: vertices");
    const std::uint32_t* triangles = &wanted(given.triangles, "mesh: triangles");
    TriangleMesh mesh;
    mesh.vertices.reserve(given.vertex_count);
    Fnv128 hash;
    for (std::size_t i = 0; i < given.vertex_count; ++i) {
        const dvec3 p{vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
        if (!std::isfinite(p.x + p.y + p.z)) throw BadCall(fmt::format("mesh: vertex {} is not finite", i));
        mesh.vertices.push_back(p);
        hash.add(fmt::format("{} {} {}\n", p.x, p.y, p.z));
    }
    mesh.triangles.reserve(given.triangle_count);
    for (std::size_t i = 0; i < given.triangle_count; ++i) {
        const std::array<std::uint32_t, 3> corners{triangles[3 * i], triangles[3 * i + 1],
                                                   triangles[3 * i + 2]};
        for (const std::uint32_t corner : corners) {
            if (corner >= given.vertex_count)
                throw BadCall(
                    fmt::format("mesh: triangle {} has vertex {} of {}", i, corner, given.vertex_count));
        }
        mesh.triangles.push_back(corners);
        hash.add(fmt::format("{} {} {}\n", corners[0], corners[1], corners[2]));
    }
    return {make_mesh_field(close_mesh(std::move(mesh), name)), hash.hex()};
}

}  // namespace lamella
