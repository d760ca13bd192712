// Finding, making and filtering the units that a box can see.
#include "procedural/foam_units.h"

#include <array>
#include <cmath>

#include "engine/error.h"
#include "procedural/beam_box.h"

namespace lamella {
namespace {

constexpr std::uint32_t unit_seeds = 64;      // a node with more is no unit but its children
constexpr std::uint32_t slabless_seeds = 16;  // a unit with more is cut into slabs
constexpr int slabs = 4;
constexpr std::size_t reach_cache_bytes = std::size_t{4} << 20;
constexpr double safe_side = 1 + 1e-9;

double distance(const Box& a, const Box& b) {
    const dvec3 d = glm::max(glm::max(a.lo - b.hi, b.lo - a.hi), dvec3(0.0));
    return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

int parts_of(const SeedNode& node) { return node.seed_count > slabless_seeds ? slabs : 1; }

Box part_box(const SeedNode& node, int part) {
    const int parts = parts_of(node);
    const double height = (node.box.hi.z - node.box.lo.z) / parts;
    Box box = node.box;
    box.lo.z = node.box.lo.z + height * part;
    if (part + 1 < parts) box.hi.z = node.box.lo.z + height * (part + 1);
    return box;
}

/// Calls visit(index) for the coarse cells that meet the box, by z, y, x.
template <typename Visit>
void for_each_block(const SeedTree& tree, const Box& box, const Visit& visit) {
    const glm::i64vec3 lo = tree.block_index(box.lo), hi = tree.block_index(box.hi);
    for (std::int64_t z = lo.z; z <= hi.z; ++z) {
        for (std::int64_t y = lo.y; y <= hi.y; ++y) {
            for (std::int64_t x = lo.x; x <= hi.x; ++x) visit(glm::i64vec3(x, y, z));
        }
    }
}

}  // namespace

FoamUnits::FoamUnits(std::shared_ptr<const SeedTree> tree, NodeRadius radius, std::size_t cache_bytes)
    : tree_(std::move(tree)), radius_(radius), units_(cache_bytes), reaches_(reach_cache_bytes) {}

double FoamUnits::reach(glm::i64vec3 index, double z) const {
    const auto make = [&] {
        const Box home = tree_->block_box(index);
        Reach reach{0, {home.lo.z, home.hi.z}};
        for_each_block(*tree_, grown(home, std::sqrt(3.0) * safe_side * tree_->coarse_side()),
                       [&](glm::i64vec3 near) {
                           reach.distance = std::max(reach.distance, tree_->block(near)->hole * safe_side);
                       });
        return reach;
    };
    return reaches_.find_or_make({index.x, index.y, index.z, 0, 0}, z, make)->distance;
}

std::vector<Beam> FoamUnits::beams_touching(const Box& box) const {
    if (box.empty()) return {};
    Request request{box, box.center().z, {}};
    const double farthest = (std::sqrt(3.0) * tree_->coarse_side() + radius_.largest()) * safe_side;
    for_each_block(*tree_, grown(box, farthest), [&](glm::i64vec3 index) {
        const double within = reach(index, request.z) + radius_.largest() * safe_side;
        if (distance(tree_->block_box(index), box) > within) return;
        visit(*tree_->block(index), 0, within, request);
    });
    return std::move(request.beams);
}

void FoamUnits::visit(const SeedBlock& block, std::size_t node, double within, Request& request) const {
    const SeedNode& here = block.nodes[node];
    if (here.seed_count == 0 || distance(here.box, request.box) > within) return;
    if (here.seed_count <= unit_seeds || here.first_child < 0) {
        collect(block, node, within, request);
        return;
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
        visit(block, static_cast<std::size_t>(here.first_child) + octant, within, request);
    }
}

/// Appends the beams of one node's units that touch the box; missing units are made from one gathering.
void FoamUnits::collect(const SeedBlock& block, std::size_t node, double within, Request& request) const {
    const SeedNode& here = block.nodes[node];
    std::array<CellCache<FoamUnit>::Pointer, slabs> units;
    std::array<bool, slabs> missing{};
    Box gathering;
    const auto key = [&](int part) {
        return PlaceKey{block.index.x, block.index.y, block.index.z, static_cast<int>(node), part};
    };
    for (int part = 0; part < parts_of(here); ++part) {
        const Box box = part_box(here, part);
        if (distance(box, request.box) > within) continue;
        const auto at = static_cast<std::size_t>(part);
        units[at] = units_.find(key(part), request.z);
        missing[at] = !units[at];
        if (missing[at]) gathering = unite(gathering, box);
    }
    if (!gathering.empty()) {
        RingSearch rings(*tree_);
        const bool gathered = rings.gather(gathering);
        for (int part = 0; part < parts_of(here); ++part) {
            const auto at = static_cast<std::size_t>(part);
            if (!missing[at]) continue;
            auto unit =
                std::make_shared<const FoamUnit>(make(block, here, part_box(here, part), rings, gathered));
            units[at] = units_.insert(key(part), request.z, std::move(unit));
        }
    }
    for (const auto& unit : units) {
        if (!unit || intersect(unit->extent, request.box).empty()) continue;
        for (const Beam& beam : unit->beams) {
            if (touches(beam, request.box)) request.beams.push_back(beam);
        }
    }
}

FoamUnit FoamUnits::make(const SeedBlock& block, const SeedNode& node, const Box& part, RingSearch& rings,
                         bool gathered) const {
    FoamUnit unit;
    VoronoiCell cell;
    BeamMaker maker;
    TreeSearch search(*tree_);
    const bool last = part.hi.z == node.box.hi.z, first = part.lo.z == node.box.lo.z;
    std::size_t site = 0;
    for (std::uint32_t i = node.first_seed; i < node.first_seed + node.seed_count; ++i) {
        const Seed own = block.seed(i);
        if (own.position.z < part.lo.z && !first) continue;
        if (own.position.z >= part.hi.z && !last) continue;
        std::size_t left_out = 0;
        bool done = false;
        if (gathered) {
            while (site < rings.sites().size() && rings.sites()[site].key < own.key) ++site;
            done =
                site < rings.sites().size() && rings.sites()[site].key == own.key && rings.cell(site, cell);
            if (done) left_out = maker.append(cell, own, rings.sites(), radius_, unit.beams);
        }
        if (!done) {
            search.cell(own, cell);
            left_out = maker.append(cell, own, search.sites(), radius_, unit.beams);
        }
        if (left_out > 0) throw FaultError("a Voronoi cell of the foam reached beyond its proven bound");
    }
    unit.beams.shrink_to_fit();
    for (const Beam& beam : unit.beams) unit.extent = unite(unit.extent, bounds(beam));
    if (unit.beams.empty()) unit.extent = {part.center(), part.center()};
    return unit;
}

}  // namespace lamella
