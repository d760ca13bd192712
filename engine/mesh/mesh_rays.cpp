// Binning and the intersection test of vertical rays.
#include "engine/mesh/mesh_rays.h"

namespace lamella {

namespace {

/// Positive if p lies left of the line from a to b, negative right of it.
double side(dvec3 a, dvec3 b, dvec3 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

/// Returns +1 if the edge from a to b passes upwards on the right (+x) of p, -1 if downwards, else 0;
/// half-open in y.
int passing(dvec3 a, dvec3 b, dvec3 p) {
    const bool up = a.y <= p.y && p.y < b.y;
    const bool down = b.y <= p.y && p.y < a.y;
    if (up) return side(a, b, p) > 0.0 ? 1 : 0;
    if (down) return side(b, a, p) > 0.0 ? -1 : 0;
    return 0;
}

}  // namespace

MeshRays::MeshRays(const TriangleMesh& mesh) : mesh_(mesh), box_(mesh.bounds()) {
    // A triangle is in every bin that its box touches, so meshes of large triangles get fewer bins.
    const std::size_t max_members = 16 * mesh.triangles.size() + 1024;
    while (bins_ * bins_ < mesh.triangles.size() && bins_ < 1024) bins_ *= 2;
    const auto members = [&] {
        std::size_t total = 0;
        for (const auto& t : mesh.triangles) total += bins_of(t).count();
        return total;
    };
    while (bins_ > 1 && members() > max_members) bins_ /= 2;
    fill();
}

MeshRays::Bins MeshRays::bins_of(const std::array<std::uint32_t, 3>& t) const {
    const dvec3 lo = glm::min(mesh_.vertices[t[0]], glm::min(mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
    const dvec3 hi = glm::max(mesh_.vertices[t[0]], glm::max(mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
    return {column(lo.x), column(hi.x), row(lo.y), row(hi.y)};
}

void MeshRays::fill() {
    const auto each_bin = [&](const Bins& bins, const auto& visit) {
        for (std::size_t y = bins.y0; y <= bins.y1; ++y) {
            for (std::size_t x = bins.x0; x <= bins.x1; ++x) visit(x + y * bins_);
        }
    };
    begin_.assign(bins_ * bins_ + 1, 0);
    for (const auto& t : mesh_.triangles) each_bin(bins_of(t), [&](std::size_t b) { ++begin_[b + 1]; });
    for (std::size_t b = 0; b < bins_ * bins_; ++b) begin_[b + 1] += begin_[b];
    members_.resize(begin_.back());
    std::vector<std::uint32_t> end(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        each_bin(bins_of(mesh_.triangles[t]), [&](std::size_t b) { members_[end[b]++] = t; });
    }
}

int MeshRays::crossing(std::uint32_t triangle, dvec3 p) const {
    const dvec3 a = mesh_.vertices[mesh_.triangles[triangle][0]];
    const dvec3 b = mesh_.vertices[mesh_.triangles[triangle][1]];
    const dvec3 c = mesh_.vertices[mesh_.triangles[triangle][2]];
    const int sign = passing(a, b, p) + passing(b, c, p) + passing(c, a, p);
    if (sign == 0) return 0;
    const dvec3 normal = glm::cross(b - a, c - a);
    return glm::dot(normal, a - p) * normal.z > 0.0 ? sign : 0;
}

}  // namespace lamella
