// PieceSlabs: a cache of a foam's pieces by slab in z, shared by layers that are close together.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "procedural/foam/plane_strips.h"

namespace lamella {

/// Returns the pieces that meet a plane, strip by strip, from slabs of space that several layers share.
/// Thread-safe; results do not depend on the state of the cache.
template <typename Piece>
class PieceSlabs {
  public:
    /// Returns all pieces that touch a box, in canonical order.
    using Query = std::function<std::vector<Piece>(const Box&)>;

    /// `height` is that of a slab, mm. The three most recent slabs of each strip are cached.
    PieceSlabs(double height, int strips) : height_(height), strips_(static_cast<std::size_t>(strips)) {}

    int strips() const { return static_cast<int>(strips_.size()); }
    /// Returns the pieces that may meet a strip (`rect`) of the plane at height z, in the query's order. The
    /// list is conservative: it has all that do, and only pieces whose height interval contains z.
    PlanePieces at(std::size_t strip, const Rect& rect, double z, const Query& touching) const;

  private:
    static constexpr std::size_t slabs_held = 3;
    struct Slab {
        std::int64_t index = 0;
        std::once_flag asked;
        std::vector<Piece> pieces;
        std::vector<Interval> heights;  ///< z interval of each piece's solid, mm
    };
    struct Strip {
        std::mutex mutex;
        std::array<std::shared_ptr<Slab>, slabs_held> slabs;  ///< most recently used first
    };

    std::shared_ptr<Slab> slab(std::size_t strip, std::int64_t index) const;

    double height_;
    mutable std::vector<Strip> strips_;
};

template <typename Piece>
std::shared_ptr<typename PieceSlabs<Piece>::Slab> PieceSlabs<Piece>::slab(std::size_t strip,
                                                                          std::int64_t index) const {
    Strip& held = strips_[strip];
    const std::lock_guard lock(held.mutex);
    std::size_t at = 0;
    while (at + 1 < slabs_held && !(held.slabs[at] && held.slabs[at]->index == index)) ++at;
    if (!held.slabs[at] || held.slabs[at]->index != index) {
        held.slabs[at] = std::make_shared<Slab>();
        held.slabs[at]->index = index;
    }
    for (; at > 0; --at) std::swap(held.slabs[at], held.slabs[at - 1]);
    return held.slabs[0];
}

template <typename Piece>
PlanePieces PieceSlabs<Piece>::at(std::size_t strip, const Rect& rect, double z,
                                  const Query& touching) const {
    const double index = std::floor(z / height_);
    const auto slab = this->slab(strip, static_cast<std::int64_t>(index));
    std::call_once(slab->asked, [&] {
        // Slightly higher than the slab, because its borders are rounded.
        const double lo = (index - 1e-6) * height_, hi = (index + 1 + 1e-6) * height_;
        slab->pieces = touching({{rect.lo.x, rect.lo.y, lo}, {rect.hi.x, rect.hi.y, hi}});
        slab->pieces.shrink_to_fit();
        slab->heights.reserve(slab->pieces.size());
        for (const Piece& piece : slab->pieces) {
            const Box box = bounds(piece);
            slab->heights.push_back({box.lo.z, box.hi.z});
        }
    });
    PlanePieces met;
    for (std::size_t i = 0; i < slab->pieces.size(); ++i) {
        if (slab->heights[i].contains(z)) put_into(met, slab->pieces[i]);
    }
    return met;
}

}  // namespace lamella
