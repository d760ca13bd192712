// FoamSettings, FoamSeeding: the parameters of a foam, and the seeds, cell sizes and radii that follow from
// them.
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

/// Rotation or mirror about the origin of a foam that is made.
struct FoamTurn {
    glm::dmat3 axes{1};  ///< orthogonal
    Box region{};        ///< where the turned foam is wanted, mm; must be finite unless the axes are unit

    bool identity() const { return axes == glm::dmat3(1); }
};

/// Parameters of a foam.
struct FoamSettings {
    /// Mean spacing of the seeds, mm: one seed per cell^3 before the stretch. May vary by a factor of 40 over
    /// the region. Outside the region it is clamped to the range that it has inside.
    Graded cell = 2.0;
    /// Radius of the beams, mm. A constant radius must be less than half of a constant `cell`. Otherwise it
    /// is limited to 0.45 of the local cell. Sampled at the beams' ends.
    Graded beam_radius = 0.2;
    std::uint64_t seed = 0;  ///< of the random numbers; another seed gives another foam
    SeedPattern pattern = SeedPattern::jittered;
    double jitter = 0.05;  ///< of patterns other than jittered, as a share of the spacing
    /// Period of the seeds along each axis, in coarse cells; 0: not periodic.
    std::int64_t repeats_after = 0;
    Stretch stretch{};                     ///< of the cells
    std::optional<FrameSettings> frame{};  ///< beams along a body's surface; the foam then ends there
    Box region{};                          ///< where the foam is wanted, mm; must be finite
    FoamTurn turn{};                       ///< of all that is above, but for the frame's body
    std::size_t cache_bytes = std::size_t{256}
                              << 20;  ///< memory bound for cached cells, and as much again for distances

    /// Returns where the foam is wanted once it is turned, mm.
    const Box& turned_region() const { return turn.identity() ? region : turn.region; }
};

/// Seeds, cell sizes and radii that follow from valid settings; the basis of all foams on seeds.
struct FoamSeeding {
    std::shared_ptr<const SeedTree> tree;
    GradingPtr cell;  ///< mm, where the foam is once it is turned, clamped to `cells`
    Interval cells;   ///< range of cell sizes in the region, mm
    NodeRadius radius;
    Stretch stretch;
    std::optional<SurfaceFrame> frame;

    /// Upper bound of the radius of any beam, mm.
    double largest_radius() const {
        return frame ? std::max(radius.largest(), frame->largest_radius()) : radius.largest();
    }
    /// Returns the same seeding with all beam radii larger by `by`, mm.
    FoamSeeding grown(double by) const;
    /// Returns all seeds in the closed box of part space, in key order.
    std::vector<Seed> seeds_in(const Box& box) const;
};

/// Checks the settings and makes seeds and radii. Throws InputError for settings out of range.
FoamSeeding prepare_foam(const FoamSettings& settings);

}  // namespace lamella
