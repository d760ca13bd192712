// Walks the trees around a box for the largest relevant diagonal.
#include "procedural/voronoi/seed_reach.h"
#include "procedural/voronoi/rounding.h"

#include <cmath>

namespace lamella {
namespace {

void visit(const SeedBlock& block, std::size_t node, const Box& box, double& reach) {
    const SeedNode& here = block.nodes[node];
    const double here_diagonal = diagonal(here.box) * rounding_margin;
    if (here_diagonal <= reach || distance(here.box, box) > here_diagonal) return;
    if (here.first_child < 0) {
        // A full leaf has a seed in every octant.
        const double sure = here.seed_count >= 8 ? here_diagonal / 2 : here_diagonal;
        if (distance(here.box, box) <= sure) reach = std::max(reach, sure);
        return;
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
        const std::size_t child = static_cast<std::size_t>(here.first_child) + octant;
        if (block.nodes[child].seed_count > 0) {
            visit(block, child, box, reach);
        } else if (distance(block.nodes[child].box, box) <= here_diagonal) {
            reach = std::max(reach, here_diagonal);
        }
    }
}

}  // namespace

double seed_reach(const SeedTree& tree, const Box& box, double at_least) {
    double reach = at_least;
    const Box about = grown(box, std::sqrt(3.0) * rounding_margin * tree.coarse_side());
    const glm::i64vec3 lo = tree.block_index(about.lo), hi = tree.block_index(about.hi);
    for (std::int64_t z = lo.z; z <= hi.z; ++z) {
        for (std::int64_t y = lo.y; y <= hi.y; ++y) {
            for (std::int64_t x = lo.x; x <= hi.x; ++x) {
                const auto block = tree.block({x, y, z});
                if (block->hole * rounding_margin > reach) visit(*block, 0, box, reach);
            }
        }
    }
    return reach;
}

}  // namespace lamella
