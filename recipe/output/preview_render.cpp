// A grid of the whole scene serves all views; tiles of a view are drawn in parallel.
#include "recipe/output/preview_render.h"

#include "engine/base/parallel.h"
#include "recipe/output/preview_tile.h"

namespace lamella {
namespace {

constexpr double cells_per_pixel = 0.6;
constexpr int least_cells = 96;
constexpr double cells_of_1024 = 96e6, most_cells = 400e6;
constexpr double beyond_cut = 3;  // cells in which a surface still bends where the grid ends

double cells_for(int pixels) {
    const double times = std::max(pixels / 1024.0, 1.0);
    return std::min(cells_of_1024 * times * times, most_cells);
}

int cells_along(int pixels) { return std::max(static_cast<int>(pixels * cells_per_pixel), least_cells); }

std::vector<dvec3> kept_places(const std::vector<dvec3>& places, const Box& kept) {
    std::vector<dvec3> left;
    for (const dvec3& place : places) {
        if (kept.contains(place)) left.push_back(place);
    }
    return left;
}

/// What a single picture shows: less than the bounds where it is cut.
Box region_of(const Box& bounds, const PreviewOptions& options) {
    const PreviewCut cut = cut_plane(bounds, options);
    const Box kept = kept_by(cut, bounds);
    if (cut.axis < 0 || options.printed_to) return bounds;
    const dvec3 size = kept.size();
    const double apron = beyond_cut * std::max({size.x, size.y, size.z}) /
                         cells_along(std::max(options.width, options.height));
    return kept_by({cut.axis, cut.at + cut.side * apron, cut.side}, bounds);
}

}  // namespace

PreviewScene::PreviewScene(FieldPtr part, FieldPtr supports, const Box& bounds, const SceneOptions& options,
                           const CancelToken* cancel)
    : solids_{std::move(part), std::move(supports)}, bounds_(bounds) {
    const Box region = options.region ? intersect(*options.region, bounds) : bounds;
    ThreadArena arena(options.threads);
    grid_ = arena.execute([&] {
        return std::make_unique<const CoverageGrid>(solids_, region, cells_along(options.pixels),
                                                    cells_for(options.pixels), cancel);
    });
    places_ = grid_->solid_places();
}

std::shared_ptr<const CutFace> PreviewScene::face_of(const PreviewCut& plane,
                                                     const CancelToken* cancel) const {
    if (plane.axis < 0) return nullptr;
    {
        const std::lock_guard lock(mutex_);
        if (face_ && face_plane_.axis == plane.axis && face_plane_.at == plane.at) return face_;
    }
    auto made = std::make_shared<const CutFace>(solids_, bounds_, plane, grid_->pitch(), cancel);
    const std::lock_guard lock(mutex_);
    face_ = made;
    face_plane_ = plane;
    return made;
}

Picture PreviewScene::draw(const PreviewOptions& view, const CancelToken* cancel) const {
    const PreviewCut cut = cut_plane(bounds_, view);
    const Box kept = kept_by(cut, bounds_);
    const Box& shown = view.steady || view.printed_to ? bounds_ : kept;
    PreviewCamera camera = camera_before(shown, view);
    if (!view.steady) zoom_to(camera, kept_places(places_, shown), view);
    const PreviewView seen(*grid_, face_of(cut, cancel), cut, camera, bounds_, view);
    Picture picture{view.width, view.height, {}};
    picture.rgb.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height) * 3);
    const int columns = (view.width + preview_tile - 1) / preview_tile;
    const int rows = (view.height + preview_tile - 1) / preview_tile;
    parallel_for(columns * rows, [&](int tile) {
        stop_if_cancelled(cancel);
        draw_tile(seen, tile % columns * preview_tile, tile / columns * preview_tile, picture);
    });
    return picture;
}

Picture PreviewScene::render(const PreviewOptions& view, const CancelToken* cancel) const {
    ThreadArena arena(view.threads);
    return arena.execute([&] { return draw(view, cancel); });
}

Picture render_preview(const FieldPtr& part, const FieldPtr& supports, const Box& bounds,
                       const PreviewOptions& options, const CancelToken* cancel) {
    const SceneOptions fitting{std::max(options.width, options.height), options.threads,
                               region_of(bounds, options)};
    return PreviewScene(part, supports, bounds, fitting, cancel).render(options, cancel);
}

}  // namespace lamella
