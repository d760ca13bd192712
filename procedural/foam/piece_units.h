// PieceUnits: the pieces of a foam by place, cached in units of seeds and shared by all layers in flight.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <vector>

#include "procedural/voronoi/rounding.h"
#include "procedural/voronoi/seed_tree.h"
#include "procedural/voronoi/stretch.h"

namespace lamella {

/// How far pieces reach from their axes.
template <typename T>
concept PieceExtent = requires(const T& source, const Box& box) {
    /// Largest distance from an axis to the surface of its piece, in a box of the part's space, mm.
    { source.growth(box) } -> std::same_as<double>;
    /// The same anywhere.
    { source.largest_growth() } -> std::same_as<double>;
    /// Whether certainly no axis of a piece passes through a box of the part's space.
    { source.avoids(box) } -> std::same_as<bool>;
    /// The map from the seeds' space to that of pieces and of queried boxes.
    { source.stretch() } -> std::same_as<const Stretch&>;
};

/// Makes the pieces (beams, walls) that a seed owns. Copied for each query that makes some. bounds(piece) and
/// touches(piece, box) are found by argument.
template <typename T>
concept PieceSource = PieceExtent<T> && std::copy_constructible<T> &&
    requires(T& source, const T& constant, const Box& box, const Seed& own, const SeedBlock& block,
             std::size_t node, std::vector<typename T::Piece>& pieces) {
    /// Called before append() for seeds in the box.
    source.gather(box);
    /// Appends the pieces of a seed.
    source.append(own, pieces);
    /// Largest distance from the node's box to the axes of its pieces, in the seeds' space, mm.
    { constant.reach(block, node) } -> std::same_as<double>;
    /// An upper bound of all reaches.
    { constant.farthest() } -> std::same_as<double>;
};

/// Answers which pieces of a foam touch a box. Thread-safe; the answers are pure functions of the tree and
/// the source.
///
/// A unit is a tree node of at most 64 seeds, or one of its eight slabs in z when it has more than 16. It
/// matters to a query only within its reach and growth.
template <PieceSource Source>
class PieceUnits {
  public:
    using Piece = typename Source::Piece;

    /// `cache_bytes` bounds the memory of the cached units (CellCache says how).
    PieceUnits(std::shared_ptr<const SeedTree> tree, Source source, std::size_t cache_bytes)
        : tree_(std::move(tree)),
          source_(std::move(source)),
          units_(cache_bytes, idle_unit_bytes),
          reaches_(reach_bytes, idle_reach_bytes) {}

    /// Returns every piece that touches the box, once. Order: units (coarse cells by z, y, x; nodes depth
    /// first; slabs upwards), then key.
    std::vector<Piece> touching(const Box& box) const;

  private:
    static constexpr std::uint32_t unit_seeds = 64;      // a node with more seeds is split into its children
    static constexpr std::uint32_t slabless_seeds = 16;  // a unit with more seeds is cut into slabs
    static constexpr int slabs = 8;
    static constexpr std::size_t reach_bytes = std::size_t{32} << 20;
    static constexpr std::size_t idle_unit_bytes = std::size_t{1} << 20;
    static constexpr std::size_t idle_reach_bytes = std::size_t{1} << 16;

    struct Unit {
        std::vector<Piece> pieces;
        /// z interval of each piece's solid; most pieces miss a layer's plane
        std::vector<Interval> heights;
        Box extent;  ///< bounding box of the pieces' solids, mm
        std::size_t bytes() const {
            return sizeof(Unit) + pieces.capacity() * (sizeof(Piece) + sizeof(Interval));
        }
        Interval z_extent() const { return {extent.lo.z, extent.hi.z}; }
    };
    /// How far the pieces of a node's seeds can be from the node, in seed space; z in part space.
    struct Reach {
        double distance;
        Interval z;
        std::size_t bytes() const { return sizeof(Reach); }
        Interval z_extent() const { return z; }
    };
    /// The state of one query: its box, the pieces found, and buffers for making units.
    struct Request {
        const Box& box;  ///< in part space
        Box seed_box;    ///< bounding box of the query's box in seed space
        double z;        ///< height of the layer in part space, for the caches
        Source source;
        std::vector<Piece> pieces;

        /// Whether a box of seed space is farther than a distance in seed space from the query's box. A thin
        /// box that is oblique in seed space is told apart in part space only.
        bool is_beyond(const Box& seeds, double within) const {
            if (distance(seeds, seed_box) > within) return true;
            const Stretch& stretch = source.stretch();
            return !stretch.identity() &&
                   distance(stretch.to_part(seeds), box) > within * stretch.part_per_seeds();
        }
    };

    static int parts_of(const SeedNode& node) { return node.seed_count > slabless_seeds ? slabs : 1; }
    static Box part_box(const SeedNode& node, int part);

    double reach(const SeedBlock& block, std::size_t node, double z) const;
    void visit(const SeedBlock& block, std::size_t node, double within, Request& request) const;
    void collect(const SeedBlock& block, std::size_t node, double within, Request& request) const;
    Unit make(const SeedBlock& block, const SeedNode& node, const Box& part, double within,
              Request& request) const;

    std::shared_ptr<const SeedTree> tree_;
    Source source_;
    mutable CellCache<Unit> units_;
    mutable CellCache<Reach> reaches_;
};

template <PieceSource Source>
Box PieceUnits<Source>::part_box(const SeedNode& node, int part) {
    const int parts = parts_of(node);
    const double height = (node.box.hi.z - node.box.lo.z) / parts;
    Box box = node.box;
    box.lo.z = node.box.lo.z + height * part;
    if (part + 1 < parts) box.hi.z = node.box.lo.z + height * (part + 1);
    return box;
}

template <PieceSource Source>
double PieceUnits<Source>::reach(const SeedBlock& block, std::size_t node, double z) const {
    const Box box = block.nodes[node].box;
    const PlaceKey key{block.index.x, block.index.y, block.index.z, static_cast<int>(node), 0};
    const auto make = [&] {
        const double axes = source_.reach(block, node);
        const Stretch& stretch = source_.stretch();
        const double growth = source_.growth(stretch.to_part(grown(box, axes)));
        const Box place = stretch.to_part(box);
        return Reach{(axes + growth * stretch.seeds_per_part()) * rounding_margin, {place.lo.z, place.hi.z}};
    };
    return reaches_.find_or_make(key, z, make)->distance;
}

template <PieceSource Source>
std::vector<typename Source::Piece> PieceUnits<Source>::touching(const Box& box) const {
    if (box.empty()) return {};
    const Stretch& stretch = source_.stretch();
    const Box seed_box = stretch.to_seeds(box);
    Request request{box, seed_box, box.center().z, source_, {}};
    const double farthest =
        (source_.farthest() + source_.largest_growth() * stretch.seeds_per_part()) * rounding_margin;
    const Box about = grown(seed_box, farthest);
    const glm::i64vec3 lo = tree_->block_index(about.lo), hi = tree_->block_index(about.hi);
    for (std::int64_t z = lo.z; z <= hi.z; ++z) {
        for (std::int64_t y = lo.y; y <= hi.y; ++y) {
            for (std::int64_t x = lo.x; x <= hi.x; ++x) {
                if (request.is_beyond(tree_->block_box({x, y, z}), farthest)) continue;
                const auto block = tree_->block({x, y, z});
                visit(*block, 0, farthest, request);
            }
        }
    }
    return std::move(request.pieces);
}

/// Goes down to the units within reach of the box. `within` bounds the reach of everything in the node.
template <PieceSource Source>
void PieceUnits<Source>::visit(const SeedBlock& block, std::size_t node, double within,
                               Request& request) const {
    const SeedNode& here = block.nodes[node];
    if (here.seed_count == 0) return;
    if (request.is_beyond(here.box, within)) return;
    // If all leaves share one level, one reach serves all nodes; otherwise it is worth computing at every
    // node.
    if (node == 0 || block.leaf_level < 0) {
        within = std::min(within, reach(block, node, request.z));
        if (request.is_beyond(here.box, within)) return;
    }
    if (here.seed_count <= unit_seeds || here.first_child < 0) {
        collect(block, node, within, request);
        return;
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
        visit(block, static_cast<std::size_t>(here.first_child) + octant, within, request);
    }
}

/// Appends the pieces of one node's units that touch the box; missing units are made from one gathering.
template <PieceSource Source>
void PieceUnits<Source>::collect(const SeedBlock& block, std::size_t node, double within,
                                 Request& request) const {
    const SeedNode& here = block.nodes[node];
    std::array<typename CellCache<Unit>::Pointer, slabs> units;
    std::array<bool, slabs> missing{};
    Box gathering;
    const auto key = [&](int part) {
        return PlaceKey{block.index.x, block.index.y, block.index.z, static_cast<int>(node), part};
    };
    for (int part = 0; part < parts_of(here); ++part) {
        const Box box = part_box(here, part);
        if (request.is_beyond(box, within)) continue;
        const auto at = static_cast<std::size_t>(part);
        units[at] = units_.find(key(part), request.z);
        missing[at] = !units[at];
        if (missing[at]) gathering = unite(gathering, box);
    }
    if (!gathering.empty()) {
        request.source.gather(gathering);
        for (int part = 0; part < parts_of(here); ++part) {
            const auto at = static_cast<std::size_t>(part);
            if (!missing[at]) continue;
            auto unit =
                std::make_shared<const Unit>(make(block, here, part_box(here, part), within, request));
            units[at] = units_.insert(key(part), request.z, std::move(unit));
        }
    }
    for (const auto& unit : units) {
        if (!unit || intersect(unit->extent, request.box).empty()) continue;
        for (std::size_t i = 0; i < unit->pieces.size(); ++i) {
            const Interval& z = unit->heights[i];
            if (z.hi < request.box.lo.z || request.box.hi.z < z.lo) continue;
            if (touches(unit->pieces[i], request.box)) request.pieces.push_back(unit->pieces[i]);
        }
    }
}

template <PieceSource Source>
typename PieceUnits<Source>::Unit PieceUnits<Source>::make(const SeedBlock& block, const SeedNode& node,
                                                           const Box& part, double within,
                                                           Request& request) const {
    Unit unit;
    const bool last = part.hi.z == node.box.hi.z, first = part.lo.z == node.box.lo.z;
    const bool none = source_.avoids(source_.stretch().to_part(grown(part, within)));
    const std::uint32_t end = none ? node.first_seed : node.first_seed + node.seed_count;
    for (std::uint32_t i = node.first_seed; i < end; ++i) {
        const Seed own = block.seed(i);
        if (own.position.z < part.lo.z && !first) continue;
        if (own.position.z >= part.hi.z && !last) continue;
        request.source.append(own, unit.pieces);
    }
    unit.pieces.shrink_to_fit();
    unit.heights.reserve(unit.pieces.size());
    for (const Piece& piece : unit.pieces) {
        const Box box = bounds(piece);
        unit.heights.push_back({box.lo.z, box.hi.z});
        unit.extent = unite(unit.extent, box);
    }
    if (unit.pieces.empty()) unit.extent = {dvec3(infinity), dvec3(infinity)};
    return unit;
}

}  // namespace lamella
