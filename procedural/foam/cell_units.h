// CellSource, CellUnits: units of pieces that are made from the Voronoi cell of the seed that owns them.
#pragma once

#include <cmath>

#include "engine/base/error.h"
#include "procedural/foam/beam_box.h"
#include "procedural/foam/foam_beams.h"
#include "procedural/foam/piece_units.h"
#include "procedural/voronoi/cell_search.h"
#include "procedural/voronoi/seed_reach.h"

namespace lamella {

/// Makes the pieces of a Voronoi cell.
template <typename T>
concept CellMaker = PieceExtent<T> && std::copy_constructible<T> &&
    requires(T& maker, const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
             std::vector<typename T::Piece>& pieces) {
    /// Appends the cell's pieces. Returns the number of edges left out for want of an end.
    { maker.append(cell, own, sites, pieces) } -> std::same_as<std::size_t>;
};

/// Finds the cell of each seed, in rings where the seeds allow it, and has a maker make its pieces.
template <CellMaker Maker>
class CellSource {
  public:
    using Piece = typename Maker::Piece;

    CellSource(std::shared_ptr<const SeedTree> tree, Maker maker)
        : tree_(std::move(tree)), rings_(*tree_), search_(*tree_), maker_(std::move(maker)) {}

    void gather(const Box& box) {
        gathered_ = rings_.gather(box);
        site_ = 0;
    }

    void append(const Seed& own, std::vector<Piece>& pieces) {
        std::span<const Seed> sites = rings_.sites();
        if (!gathered_ || !cell_in_rings(own)) {
            search_.cell(own, cell_);
            sites = search_.sites();
        }
        if (maker_.append(cell_, own, sites, pieces) > 0) {
            throw FaultError("a Voronoi cell of the foam reached beyond its proven bound");
        }
    }

    double reach(const SeedBlock& block, std::size_t node) const {
        return seed_reach(*tree_, block.nodes[node].box, block.leaf_level >= 0 ? block.hole : 0);
    }
    double farthest() const { return std::sqrt(3.0) * tree_->coarse_side(); }
    double growth(const Box& box) const { return maker_.growth(box); }
    double largest_growth() const { return maker_.largest_growth(); }
    bool avoids(const Box& box) const { return maker_.avoids(box); }
    const Stretch& stretch() const { return maker_.stretch(); }

  private:
    /// Finds the seed among the gathered sites and computes its cell in rings. Both come in key order.
    bool cell_in_rings(const Seed& own) {
        const auto sites = rings_.sites();
        if (site_ < sites.size() && own.key < sites[site_].key) site_ = 0;
        while (site_ < sites.size() && sites[site_].key < own.key) ++site_;
        return site_ < sites.size() && sites[site_].key == own.key && rings_.cell(site_, cell_);
    }

    std::shared_ptr<const SeedTree> tree_;
    RingSearch rings_;
    TreeSearch search_;
    VoronoiCell cell_;
    Maker maker_;
    bool gathered_ = false;
    std::size_t site_ = 0;
};

/// The pieces of a Voronoi foam by place.
template <CellMaker Maker>
class CellUnits : public PieceUnits<CellSource<Maker>> {
  public:
    /// `cache_bytes` bounds the memory of the cached units (CellCache says how).
    CellUnits(const std::shared_ptr<const SeedTree>& tree, Maker maker, std::size_t cache_bytes)
        : PieceUnits<CellSource<Maker>>(tree, CellSource<Maker>(tree, std::move(maker)), cache_bytes) {}
};

}  // namespace lamella
