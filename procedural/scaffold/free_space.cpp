// Sphere tracing with a minimum step.
#include "procedural/scaffold/free_space.h"

#include <array>

namespace lamella {
namespace {

// mm; halfway between samples so far apart, the clearance is lower by at most half of this
constexpr double min_step = 0.1;
constexpr double far_enough =
    4;  // mm of clearance beyond what is needed; querying more costs more than it saves
constexpr double on_surface = 0.02;      // mm
constexpr double deepest_contact = 0.5;  // mm; half a bead within a steep wall

/// Returns the directions to the corners, edges and faces of a cube, as unit vectors.
const std::array<dvec3, 26>& directions_about() {
    static const std::array<dvec3, 26> list = [] {
        std::array<dvec3, 26> made{};
        std::size_t count = 0;
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) {
                for (int z = -1; z <= 1; ++z) {
                    const dvec3 d(x, y, z);
                    if (d != dvec3(0)) made[count++] = d / std::sqrt(glm::dot(d, d));
                }
            }
        }
        return made;
    }();
    return list;
}

}  // namespace

FreeSpace::FreeSpace(const Field& part, double bed) : part_(part), bed_(bed), metric_(part.metric()) {}

double FreeSpace::clearance(dvec3 p, double limit) const {
    if (metric_ == Metric::sign) return probed_room(p, limit);
    const double value = part_.value_within(p, limit);
    return value < limit ? value : limit;
}

double FreeSpace::probed_room(dvec3 p, double limit) const {
    constexpr double growth = 1.189207115002721;  // 2^(1/4), ratio of the radii of successive shells
    const bool inside = part_.value(p) <= 0;
    double same = on_surface;
    for (double radius = on_surface; same < limit; radius *= growth) {
        const double shell = std::min(radius, limit);
        const bool all =
            std::all_of(directions_about().begin(), directions_about().end(),
                        [&](dvec3 direction) { return (part_.value(p + direction * shell) <= 0) == inside; });
        if (!all) break;
        same = shell;
    }
    return inside ? -same : same;
}

bool FreeSpace::clear(dvec3 a, dvec3 b, double distance) const {
    const double length = glm::distance(a, b);
    const dvec3 way = length > 0 ? (b - a) / length : dvec3(0);
    double at = 0;
    while (true) {
        const double here = clearance(a + way * at, distance + far_enough);
        if (here < distance) return false;
        if (at >= length) return true;
        at = std::min(length, at + std::max(here - distance, min_step));
    }
}

/// Returns the distance along `way` from a contact inside the part to the surface, mm; 0 for a contact on the
/// surface; none if it exceeds deepest_contact.
std::optional<double> FreeSpace::leaves_part(dvec3 contact, dvec3 way) const {
    double at = 0;
    for (double here = clearance(contact, deepest_contact); here < -2 * on_surface;
         here = clearance(contact + way * at, deepest_contact)) {
        at += std::max(-here, on_surface);
        if (at > deepest_contact) return std::nullopt;
    }
    return at;
}

bool FreeSpace::clear_from_contact(dvec3 contact, dvec3 end, double distance, double slope) const {
    const double length = glm::distance(contact, end);
    if (!(length > 0)) return true;
    const dvec3 way = (end - contact) / length;
    const std::optional<double> left = leaves_part(contact, way);
    if (!left) return false;
    double at = std::min(*left + 3 * min_step, length);
    while (true) {
        const double needed = std::min(distance, slope * (at - *left - min_step));
        const double here = clearance(contact + way * at, distance + far_enough);
        if (here < needed) return false;
        if (at >= length) return true;
        at = std::min(length, at + std::max((here - needed) / (1 + slope), min_step));
    }
}

FreeSpace::Fall FreeSpace::fall(dvec3 p, dvec3 direction, double distance) const {
    Fall fall;
    const double length = (p.z - bed_) / -direction.z;
    double at = 0;
    bool clear = true;
    while (true) {
        const double here = clearance(p + direction * at, distance + far_enough);
        if (clear && here < distance) {
            clear = false;
            fall.clear = std::max(0.0, at - min_step);
        }
        if (here <= on_surface) {
            fall.hits = at;
            return fall;
        }
        if (!clear && here >= distance) {
            fall.passes = false;
            return fall;
        }
        if (at >= length) break;
        const double step = clear ? here - distance : here / 2;
        at = std::min(length, at + std::max(step, clear ? min_step : on_surface));
    }
    if (clear) {
        fall.clear = length;
    } else {
        fall.passes = false;
    }
    return fall;
}

}  // namespace lamella
