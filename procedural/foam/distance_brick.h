// PieceBrick: a small cube of space that stores, for each of its voxels, the few pieces that can be nearest
// there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/solids/beam.h"

namespace lamella {

/// Finds the exact distance to the nearest of infinitely many pieces from a short list. A piece is on a
/// voxel's list if its distance from the voxel's centre exceeds the smallest such distance by no more than
/// the voxel's diagonal. Distances are 1-Lipschitz, so no other piece is nearest anywhere in the voxel.
/// Immutable.
///
/// Piece must have signed_distance(piece, p), and prepared(piece), the form that the brick keeps, with the
/// same distances; both are found by argument-dependent lookup.
template <typename Piece>
class PieceBrick {
  public:
    /// Returns all pieces that touch a box.
    using Query = std::function<std::vector<Piece>(const Box&)>;
    /// Gathers the pieces around the cube `box`, mm.
    PieceBrick(const Box& box, const Query& touching);

    /// Returns the signed distance to the union of all pieces at a point of the cube, mm.
    double distance(dvec3 p) const;
    std::size_t bytes() const {
        return sizeof(PieceBrick) + pieces_.capacity() * sizeof(Prepared) +
               lists_.capacity() * sizeof(lists_[0]) + begins_.capacity() * sizeof(begins_[0]);
    }
    Interval z_extent() const { return {box_.lo.z, box_.hi.z}; }
    /// Whether the point lies in the cube; its upper faces belong to the next cubes.
    bool holds(dvec3 p) const {
        return box_.lo.x <= p.x && p.x < box_.hi.x && box_.lo.y <= p.y && p.y < box_.hi.y &&
               box_.lo.z <= p.z && p.z < box_.hi.z;
    }

  private:
    static constexpr int halvings = 2;          // from the cube to a voxel
    static constexpr int side = 1 << halvings;  // voxels along an edge
    static constexpr double rounding = 1e-9;

    using Prepared = decltype(prepared(std::declval<const Piece&>()));

    struct Entry {
        double center_distance;  ///< from the voxel's centre, mm
        std::uint32_t piece;
    };

    static Box octant_of(const Box& box, int octant) {
        const dvec3 half = box.size() * 0.5;
        const dvec3 lo = box.lo + half * dvec3(octant & 1, (octant >> 1) & 1, octant >> 2);
        return {lo, lo + half};
    }
    bool divide(const Box& box, std::span<const std::uint32_t> candidates, const std::vector<Piece>& near,
                double growth, int depth);
    void keep_used(const std::vector<Piece>& near);

    Box box_;
    std::vector<Prepared> pieces_;
    std::vector<std::uint32_t> begins_;  ///< by voxel, in octree order
    std::vector<Entry> lists_;           ///< of each voxel, sorted by distance
};

/// The brick of foams that consist of beams alone.
using DistanceBrick = PieceBrick<Beam>;

template <typename Piece>
PieceBrick<Piece>::PieceBrick(const Box& box, const Query& touching) : box_(box) {
    // Pieces that do not touch the grown cube are farther than the growth from all of it. Grow until every
    // voxel's list is certainly complete.
    const double first_growth = 0.75 * (box.hi.x - box.lo.x);
    for (double growth = first_growth;; growth *= 1.5) {
        const std::vector<Piece> near = touching(grown(box, growth));
        std::vector<std::uint32_t> candidates(near.size());
        std::iota(candidates.begin(), candidates.end(), std::uint32_t{0});
        lists_.clear();
        begins_.assign(1, 0);
        if (!divide(box, candidates, near, growth, 0)) continue;
        keep_used(near);
        return;
    }
}

/// Culls candidates from cube to octant, down to the voxels. Returns false if a piece farther than the growth
/// might be nearest.
template <typename Piece>
bool PieceBrick<Piece>::divide(const Box& box, std::span<const std::uint32_t> candidates,
                               const std::vector<Piece>& near, double growth, int depth) {
    const dvec3 center = box.center(), size = box.size();
    const double diagonal = std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z) * (1 + rounding);
    std::vector<double> distances(candidates.size());
    double nearest = infinity;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        distances[i] = signed_distance(near[candidates[i]], center);
        nearest = std::min(nearest, distances[i]);
    }
    if (depth < halvings) {
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (distances[i] <= nearest + diagonal) kept.push_back(candidates[i]);
        }
        for (int octant = 0; octant < 8; ++octant) {
            if (!divide(octant_of(box, octant), kept, near, growth, depth + 1)) return false;
        }
        return true;
    }
    if (!(nearest + diagonal < growth)) return false;
    const auto begin = static_cast<std::ptrdiff_t>(lists_.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (distances[i] <= nearest + diagonal) lists_.push_back({distances[i], candidates[i]});
    }
    std::sort(lists_.begin() + begin, lists_.end(), [](const Entry& a, const Entry& b) {
        return a.center_distance != b.center_distance ? a.center_distance < b.center_distance
                                                      : a.piece < b.piece;
    });
    begins_.push_back(static_cast<std::uint32_t>(lists_.size()));
    return true;
}

/// Keeps the pieces that are on a list, and renumbers the lists.
template <typename Piece>
void PieceBrick<Piece>::keep_used(const std::vector<Piece>& near) {
    std::vector<std::int32_t> renumbered(near.size(), -1);
    for (Entry& entry : lists_) {
        std::int32_t& number = renumbered[entry.piece];
        if (number < 0) {
            number = static_cast<std::int32_t>(pieces_.size());
            pieces_.push_back(prepared(near[entry.piece]));
        }
        entry.piece = static_cast<std::uint32_t>(number);
    }
    pieces_.shrink_to_fit();
    lists_.shrink_to_fit();
}

template <typename Piece>
double PieceBrick<Piece>::distance(dvec3 p) const {
    const dvec3 voxel = box_.size() / static_cast<double>(side);
    const glm::ivec3 at = glm::clamp(glm::ivec3(glm::floor((p - box_.lo) / voxel)), 0, side - 1);
    const dvec3 off_center = p - (box_.lo + (dvec3(at) + 0.5) * voxel);
    const double way = std::sqrt(glm::dot(off_center, off_center)) + rounding * voxel.x;
    std::size_t v = 0;
    for (int bit = halvings - 1; bit >= 0; --bit) {
        const int octant = ((at.x >> bit) & 1) | ((at.y >> bit) & 1) << 1 | ((at.z >> bit) & 1) << 2;
        v = v * 8 + static_cast<std::size_t>(octant);
    }
    double nearest = infinity;
    for (std::uint32_t i = begins_[v]; i < begins_[v + 1]; ++i) {
        // No later piece is nearer: the distance from p differs from that of the voxel's centre by at most
        // `way`.
        if (lists_[i].center_distance - way > nearest) break;
        nearest = std::min(nearest, signed_distance(pieces_[lists_[i].piece], p));
    }
    return nearest;
}

}  // namespace lamella
