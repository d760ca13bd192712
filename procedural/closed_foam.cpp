// Checking walls and windows; distances through bricks, slices through strips.
#include "procedural/closed_foam.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/error.h"
#include "engine/slice_context.h"

namespace lamella {
namespace {

constexpr double thickest = 0.9;  // share of the local cell
constexpr double cells_per_strip = 8192;
constexpr double most_strips = 256;

bool finite(dvec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Half a wall's thickness, where cells are large enough for it.
class HalfWall : public Grading {
  public:
    HalfWall(GradingPtr wall, GradingPtr cell) : wall_(std::move(wall)), cell_(std::move(cell)) {}
    double at(dvec3 p) const override { return 0.5 * std::min(wall_->at(p), thickest * cell_->at(p)); }
    Interval range(const Box& box) const override {
        const Interval wall = wall_->range(box), cell = cell_->range(box);
        return {0.5 * std::min(wall.lo, thickest * cell.lo), 0.5 * std::min(wall.hi, thickest * cell.hi)};
    }

  private:
    GradingPtr wall_, cell_;
};

/// The range of a graded setting over the region, cut to limits. A constant must keep to them.
Interval range_within(const Graded& graded, const Box& region, Interval limits, const char* what,
                      const char* limits_in_words) {
    const Interval range = tight_range(*graded, region);
    const bool refused = graded->constant() && !(limits.lo <= range.lo && range.hi <= limits.hi);
    if (refused || !std::isfinite(range.lo) || !std::isfinite(range.hi)) {
        throw InputError(fmt::format("{} is {}; it must be {}", what,
                                     std::isfinite(range.lo) ? range.hi : range.lo, limits_in_words));
    }
    return {std::min(std::max(range.lo, limits.lo), limits.hi),
            std::min(std::max(range.hi, limits.lo), limits.hi)};
}

NodeRadius wall_radius(const ClosedFoamSettings& settings, const FoamGround& ground) {
    const Interval walls = range_within(settings.wall, settings.foam.region, {0, infinity},
                                        "the foam's wall thickness in mm", "finite and at least 0");
    const bool constant = settings.wall->constant().has_value();
    if (constant && walls.lo > thickest * ground.cells.hi) {
        throw InputError(fmt::format(
            "the foam's wall thickness of {} mm fills its cells of {} mm; it must be at most {:.4g} mm",
            walls.lo, ground.cells.hi, thickest * ground.cells.hi));
    }
    if (constant && walls.lo <= thickest * ground.cells.lo) return NodeRadius(walls.lo / 2);
    return {std::make_shared<HalfWall>(make_clamped_grading(settings.wall.pointer(), walls), ground.cell),
            0.5 * std::min(walls.hi, thickest * ground.cells.hi)};
}

Graded window_share(const ClosedFoamSettings& settings) {
    const Interval shares =
        range_within(settings.window, settings.foam.region, {0, 1},
                     "the share of the foam's walls that is window", "from 0 (closed) to 1 (no wall)");
    return make_clamped_grading(settings.window.pointer(), shares);
}

}  // namespace

ClosedFoam::ClosedFoam(const ClosedFoamSettings& settings)
    : ClosedFoam(settings, prepare_foam(settings.foam)) {}

ClosedFoam::ClosedFoam(const ClosedFoamSettings& settings, const FoamGround& ground)
    : region_(settings.foam.region),
      ground_(ground),
      walls_{wall_radius(settings, ground), window_share(settings), 0},
      stretch_(settings.foam.stretch),
      cache_bytes_(settings.foam.cache_bytes),
      units_(std::make_shared<const CellUnits<WallMaker>>(
          ground_.tree, WallMaker(BeamMaker(ground_.radius, stretch_), walls_), cache_bytes_)),
      bricks_(cache_bytes_) {}

ClosedFoam::ClosedFoam(const ClosedFoam& foam, double growth)
    : region_(grown(foam.region_, growth)),
      ground_(foam.ground_),
      walls_(foam.walls_),
      stretch_(foam.stretch_),
      cache_bytes_(foam.cache_bytes_),
      bricks_(cache_bytes_) {
    ground_.radius = foam.ground_.radius.grown(growth);
    walls_.growth += growth;
    units_ = std::make_shared<const CellUnits<WallMaker>>(
        ground_.tree, WallMaker(BeamMaker(ground_.radius, stretch_), walls_), cache_bytes_);
}

double ClosedFoam::value(dvec3 p) const {
    if (!finite(p)) return std::numeric_limits<double>::quiet_NaN();
    ground_.tree->block_index(stretch_.to_seeds(p));
    const auto [level, side] = brick_size(p);
    const dvec3 index = glm::floor(p / side);
    const PlaceKey key{static_cast<std::int64_t>(index.x), static_cast<std::int64_t>(index.y),
                       static_cast<std::int64_t>(index.z), level, 0};
    const auto brick = bricks_.find_or_make(key, p.z, [&] {
        return PieceBrick<FoamPiece>({index * side, (index + 1.0) * side},
                                     [this](const Box& box) { return pieces_touching(box); });
    });
    return brick->distance(p);
}

/// Any brick about the point is exact; one no larger than twice the smallest cell about it is quick to make
/// and to ask.
ClosedFoam::BrickSize ClosedFoam::brick_size(dvec3 p) const {
    const Interval& cells = ground_.cells;
    BrickSize size{0, cells.hi};
    while (size.side > cells.lo) {
        const dvec3 lo = glm::floor(p / size.side) * size.side;
        if (size.side <= 2 * ground_.cell->range(lamella::grown(Box{lo, lo + size.side}, size.side)).lo)
            break;
        size = {size.level + 1, size.side / 2};
    }
    return size;
}

Interval ClosedFoam::range(const Box& box) const {
    const dvec3 center = box.center();
    const double center_value = value(center);
    if (!std::isfinite(center_value)) return {-infinity, infinity};
    // The value is 1-Lipschitz. Inside, the axis of the thickest beam or wall is the deepest place.
    const double radius = glm::length(box.hi - center), deepest = units_->maker().largest_growth();
    return {std::max(center_value - radius, -deepest), center_value + radius};
}

FieldPtr ClosedFoam::offset(double d) const {
    if (!(d >= 0) || !std::isfinite(d)) return nullptr;
    return FieldPtr(new ClosedFoam(*this, d));
}

PlanePieces ClosedFoam::plane_pieces(const Box& box) const {
    PlanePieces pieces;
    for (const FoamPiece& piece : pieces_touching(box)) {
        if (const auto* beam = std::get_if<Beam>(&piece)) pieces.beams.push_back(*beam);
        if (const auto* wall = std::get_if<RoundTriangle>(&piece)) pieces.walls.push_back(*wall);
    }
    return pieces;
}

const SliceField& ClosedFoam::slice(SliceContext& context, double z) const {
    const Rect region = region_.rect();
    const dvec2 cells = region.size() / ground_.cells.lo;
    const double strips = std::floor(std::min(cells.x * cells.y / cells_per_strip, most_strips));
    return context.make<PlaneStrips>(
        *this, [this](const Box& box) { return plane_pieces(box); }, region,
        std::max(static_cast<int>(strips), 1), z);
}

std::shared_ptr<const ClosedFoam> make_closed_foam(const ClosedFoamSettings& settings) {
    return std::make_shared<const ClosedFoam>(settings);
}

}  // namespace lamella
