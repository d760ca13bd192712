// The three searches for the seeds that shape a cell.
#include "procedural/voronoi/cell_search.h"
#include "procedural/voronoi/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"

namespace lamella {
namespace {

constexpr int margin = 4;          // octants gathered beyond the box on every side
constexpr int block_radius = 2;    // octants on each side of the block that is visited by distance
constexpr double nowhere = 1e150;  // coordinate of the seed of an empty octant; its squared length is finite

double distance_squared(const Box& b, dvec3 p) {
    return squared_length(glm::max(glm::max(b.lo - p, p - b.hi), dvec3(0.0)));
}

/// Every point is within sqrt(3) coarse sides of a seed, so every cell is inside this cube.
double start_half_side(const SeedTree& tree) { return 2 * tree.coarse_side(); }

}  // namespace

void TreeSearch::push(const Visit& visit) {
    heap_.push_back(visit);
    std::push_heap(heap_.begin(), heap_.end(),
                   [](const Visit& a, const Visit& b) { return a.distance_squared > b.distance_squared; });
}

const SeedBlock& TreeSearch::block(glm::i64vec3 index) {
    for (const auto& seen : blocks_) {
        if (seen->index == index) return *seen;
    }
    blocks_.push_back(tree_->block(index));
    return *blocks_.back();
}

void TreeSearch::push_ring(std::int64_t ring, const Seed& own, glm::i64vec3 center) {
    for (std::int64_t z = -ring; z <= ring; ++z) {
        for (std::int64_t y = -ring; y <= ring; ++y) {
            const bool whole_row = std::abs(z) == ring || std::abs(y) == ring;
            for (std::int64_t x = -ring; x <= ring; x += whole_row || ring == 0 ? 1 : 2 * ring) {
                const SeedBlock& made = block(center + glm::i64vec3(x, y, z));
                push({distance_squared(made.nodes[0].box, own.position), &made, 0});
            }
        }
    }
    const Box inside = {tree_->block_box(center - ring).lo, tree_->block_box(center + ring).hi};
    const dvec3 room = glm::min(own.position - inside.lo, inside.hi - own.position);
    const double nearest = std::max(std::min({room.x, room.y, room.z}), 0.0) / rounding_margin;
    push({nearest * nearest, nullptr, static_cast<std::int32_t>(ring + 1)});
}

void TreeSearch::clip_leaf(const SeedBlock& block, const SeedNode& node, const Seed& own, VoronoiCell& cell) {
    for (std::uint32_t i = node.first_seed; i < node.first_seed + node.seed_count; ++i) {
        const dvec3 offset = block.positions[i] - own.position;
        if (squared_length(offset) >= 4 * cell.reach_squared() * rounding_margin) continue;
        // The cell's own seed has offset zero and never cuts.
        if (cell.clip(offset, static_cast<std::int32_t>(sites_.size()))) sites_.push_back(block.seed(i));
    }
}

void TreeSearch::cell(const Seed& own, VoronoiCell& cell) {
    if (blocks_.size() > 512) blocks_.clear();
    sites_.clear();
    heap_.clear();
    cell.start(start_half_side(*tree_));
    const glm::i64vec3 center = tree_->block_index(own.position);
    push({0, nullptr, 0});
    while (!heap_.empty()) {
        const Visit visit = heap_.front();
        std::pop_heap(heap_.begin(), heap_.end(),
                      [](const Visit& a, const Visit& b) { return a.distance_squared > b.distance_squared; });
        heap_.pop_back();
        if (visit.distance_squared >= 4 * cell.reach_squared() * rounding_margin) break;
        if (visit.block == nullptr) {
            push_ring(visit.node, own, center);
            continue;
        }
        const SeedNode& node = visit.block->nodes[static_cast<std::size_t>(visit.node)];
        if (!cell.could_be_cut_from({node.box.lo - own.position, node.box.hi - own.position})) continue;
        if (node.first_child < 0) {
            clip_leaf(*visit.block, node, own, cell);
            continue;
        }
        for (std::int32_t child = node.first_child; child < node.first_child + 8; ++child) {
            const SeedNode& inner = visit.block->nodes[static_cast<std::size_t>(child)];
            if (inner.seed_count > 0) push({distance_squared(inner.box, own.position), visit.block, child});
        }
    }
}

glm::ivec3 RingSearch::octant_of(dvec3 p) const {
    return glm::clamp(glm::ivec3(glm::floor((p - origin_) * octants_per_mm_)), glm::ivec3(0), size_ - 1);
}

bool RingSearch::gather(const Box& box) {
    sites_.clear();
    const auto first = tree_->block(tree_->block_index(box.center()));
    if (first->leaf_level < 0) return false;
    spacing_ = std::ldexp(tree_->coarse_side(), -(first->leaf_level + 1));
    octants_per_mm_ = 1 / spacing_;
    const dvec3 lo = glm::floor(box.lo / spacing_ + 1e-6) - static_cast<double>(margin);
    const dvec3 hi = glm::ceil(box.hi / spacing_ - 1e-6) + static_cast<double>(margin);
    origin_ = lo * spacing_;
    size_ = glm::ivec3(hi - lo);
    const Box around = {origin_, hi * spacing_};
    const std::size_t slots = slot(size_ - 1) + 1;
    site_at_.assign(slots, -1);
    x_.assign(slots, nowhere);
    y_.assign(slots, nowhere);
    z_.assign(slots, nowhere);

    const glm::i64vec3 begin = tree_->block_index(around.lo + 0.5 * spacing_);
    const glm::i64vec3 end = tree_->block_index(around.hi - 0.5 * spacing_);
    for (std::int64_t z = begin.z; z <= end.z; ++z) {
        for (std::int64_t y = begin.y; y <= end.y; ++y) {
            for (std::int64_t x = begin.x; x <= end.x; ++x) {
                const auto block = tree_->block({x, y, z});
                if (block->leaf_level != first->leaf_level) return false;
                for (std::uint32_t i = 0; i < block->positions.size(); ++i) {
                    const dvec3 p = block->positions[i];
                    if (!around.contains(p)) continue;
                    const std::size_t at = slot(octant_of(p));
                    if (site_at_[at] >= 0) return false;
                    site_at_[at] = static_cast<std::int32_t>(sites_.size());
                    x_[at] = p.x;
                    y_[at] = p.y;
                    z_[at] = p.z;
                    sites_.push_back(block->seed(i));
                }
            }
        }
    }
    return true;
}

/// Collects the other seeds of the 5^3 block and bucket-sorts them by distance.
void RingSearch::collect_block(glm::ivec3 center, dvec3 own, double limit_squared) {
    constexpr std::size_t buckets = 64;
    constexpr int width = 2 * block_radius + 1;
    std::array<std::uint32_t, buckets + 1> begins{};
    std::array<double, width> squares;
    candidates_.clear();
    const double scale = static_cast<double>(buckets) / limit_squared;
    for (int z = center.z - block_radius; z <= center.z + block_radius; ++z) {
        for (int y = center.y - block_radius; y <= center.y + block_radius; ++y) {
            const std::size_t row = slot({center.x - block_radius, y, z});
            for (std::size_t i = 0; i < width; ++i) {
                const double dx = x_[row + i] - own.x, dy = y_[row + i] - own.y, dz = z_[row + i] - own.z;
                squares[i] = dx * dx + dy * dy + dz * dz;
            }
            for (std::size_t i = 0; i < width; ++i) {
                if (!(squares[i] < limit_squared) || squares[i] == 0) continue;
                candidates_.push_back({squares[i], site_at_[row + i]});
                ++begins[static_cast<std::size_t>(squares[i] * scale) + 1];
            }
        }
    }
    for (std::size_t b = 1; b <= buckets; ++b) begins[b] += begins[b - 1];
    sorted_.resize(candidates_.size());
    for (const Candidate& candidate : candidates_) {
        sorted_[begins[static_cast<std::size_t>(candidate.distance_squared * scale)]++] = candidate;
    }
}

/// Clips by the seeds outside the 5^3 block that can still cut the cell.
bool RingSearch::clip_beyond_block(glm::ivec3 center, dvec3 own, VoronoiCell& cell) {
    const Box region = cell.region_of_influence();
    const dvec3 from = glm::floor((region.lo + own - origin_) / spacing_);
    const dvec3 to = glm::floor((region.hi + own - origin_) / spacing_);
    if (from.x < 0 || from.y < 0 || from.z < 0) return false;
    if (to.x >= size_.x || to.y >= size_.y || to.z >= size_.z) return false;
    const glm::ivec3 lo(from), hi(to);
    for (int z = lo.z; z <= hi.z; ++z) {
        for (int y = lo.y; y <= hi.y; ++y) {
            const bool beside =
                std::abs(z - center.z) <= block_radius && std::abs(y - center.y) <= block_radius;
            for (int x = lo.x; x <= hi.x; ++x) {
                if (beside && std::abs(x - center.x) <= block_radius) {
                    x = center.x + block_radius;
                    continue;
                }
                const std::size_t at = slot({x, y, z});
                const dvec3 offset(x_[at] - own.x, y_[at] - own.y, z_[at] - own.z);
                if (squared_length(offset) < 4 * cell.reach_squared() * rounding_margin)
                    cell.clip(offset, site_at_[at]);
            }
        }
    }
    return true;
}

bool RingSearch::cell(std::size_t own, VoronoiCell& cell) {
    const dvec3 position = sites_[own].position;
    const glm::ivec3 center = octant_of(position);
    for (int axis = 0; axis < 3; ++axis) {
        if (center[axis] < block_radius || center[axis] >= size_[axis] - block_radius) return false;
    }
    cell.start(start_half_side(*tree_));
    // The farthest corners of the block are 3 sqrt(3) octants away.
    collect_block(center, position, 27 * spacing_ * spacing_ * rounding_margin);
    for (const Candidate& candidate : sorted_) {
        if (candidate.distance_squared >= 4 * cell.reach_squared() * rounding_margin) continue;
        cell.clip(sites_[static_cast<std::size_t>(candidate.site)].position - position, candidate.site);
    }
    return clip_beyond_block(center, position, cell);
}

}  // namespace lamella
