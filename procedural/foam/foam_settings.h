// What a foam is made of, and the seeds, sizes and radii that follow from it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "engine/field/grading.h"
#include "procedural/foam/surface_frame.h"
#include "procedural/foam/tapered_beams.h"
#include "procedural/voronoi/seed_tree.h"
#include "procedural/voronoi/stretch.h"

namespace lamella {

/// What a foam is made of.
struct FoamSettings {
    /// Mean spacing of the seeds, mm: one seed per cell^3, where the stretch is none. May vary by a factor of
    /// 40 over the region. Numbers outside the range that it has in the region are clamped to that.
    Graded cell = 2.0;
    /// Radius of the beams, mm. A constant one must be less than half of a constant `cell`; otherwise it is
    /// kept to at most 0.45 of the local cell, asked for at the beams' ends.
    Graded beam_radius = 0.2;
    std::uint64_t seed = 0;  ///< another number, another foam
    SeedPattern pattern = SeedPattern::jittered;
    double jitter = 0.05;  ///< of the patterns other than jittered: share of the spacing
    /// Coarse cells of the seeds after which these repeat along each axis; 0: never.
    std::int64_t repeats_after = 0;
    Stretch stretch{};                     ///< of the cells
    std::optional<FrameSettings> frame{};  ///< under a body's surface, which the foam then ends at
    Box region{};                          ///< where the foam is wanted, mm; finite
    std::size_t cache_bytes = std::size_t{256}
                              << 20;  ///< bound of the memory for cells, and again for distances
};

/// Seeds, cell sizes and radii of checked settings: what all foams on seeds start from.
struct FoamSeeding {
    std::shared_ptr<const SeedTree> tree;
    GradingPtr cell;  ///< mm, in the part's space, clamped to `cells`
    Interval cells;   ///< the cell sizes of the region, mm
    NodeRadius radius;
    Stretch stretch;
    std::optional<SurfaceFrame> frame;

    /// No beam is thicker, mm.
    double largest_radius() const {
        return frame ? std::max(radius.largest(), frame->largest_radius()) : radius.largest();
    }
    /// The ground of the foam with beams thicker by a length, mm.
    FoamSeeding grown(double by) const;
    /// All seeds in the closed box of the part's space, by key.
    std::vector<Seed> seeds_in(const Box& box) const;
};

/// Throws InputError for settings out of range; `what` names the thing in messages ("the foam").
FoamSeeding prepare_foam(const FoamSettings& settings);

}  // namespace lamella
