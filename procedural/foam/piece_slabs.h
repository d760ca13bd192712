// Pieces of a foam by slab: layers close together ask the foam once for what they have in common.
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

/// The pieces that meet a plane, strip by strip, from slabs of space that many layers share. Thread-safe;
/// what is held never shows in a result.
template <typename Piece>
class PieceSlabs {
  public:
    /// All pieces that touch a box, in canonical order.
    using Query = std::function<std::vector<Piece>(const Box&)>;

    /// `height` of a slab, mm. The last few slabs of each strip are held.
    PieceSlabs(double height, int strips) : height_(height), strips_(static_cast<std::size_t>(strips)) {}

    int strips() const { return static_cast<int>(strips_.size()); }
    /// What of the strip, a rectangle of the plane, may meet the plane at height z: at least all that does,
    /// and only pieces whose heights hold z; in the query's order.
    PlanePieces at(std::size_t strip, const Rect& rect, double z, const Query& touching) const;

  private:
    static constexpr std::size_t slabs_held = 3;
    struct Slab {
        std::int64_t index = 0;
        std::once_flag asked;
        std::vector<Piece> pieces;
        std::vector<Interval> heights;  ///< of each piece's solid, mm
    };
    struct Strip {
        std::mutex mutex;
        std::array<std::shared_ptr<Slab>, slabs_held> slabs;  ///< the last one used first
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
        // A little higher than the slab, whose borders are rounded.
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
