// Threshold, widths, pieces.
#include "procedural/pattern/printable_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "procedural/pattern/least_widths.h"
#include "procedural/pattern/pattern_pieces.h"
#include "procedural/pattern/sharp_edges.h"
#include "procedural/pattern/site_distance.h"
#include "procedural/pattern/thin_walls.h"
#include "procedural/texture/pattern_levels.h"

namespace lamella {

namespace {

/// Makes solid what would be thin in space: the other side of a thin wall, the other face of an edge.
void share_solid(const SurfaceSites& sites, std::vector<float>& distances) {
    share_over_edges(sites, distances);
    share_across(sites, distances);
}

std::vector<float> cut(const SurfaceSites& sites, const SiteWindows& windows, const SitePattern& pattern,
                       float threshold, const PrintSettings& settings) {
    std::vector<float> distances;
    for (const float distance : pattern.distance) distances.push_back(distance - threshold);
    share_solid(sites, distances);
    const double limit = std::max(settings.strut, settings.gap) + 4 * sites.spacing;
    distances = signed_distances(sites, distances, limit);
    const auto change_sign = [&] {
        for (float& distance : distances) distance = -distance;
    };
    if (settings.gap > 0) {
        change_sign();
        distances = signed_distances(sites, with_least_width(sites, windows, distances, settings.gap), limit);
        change_sign();
    }
    distances = with_least_width(sites, windows, distances, settings.strut);
    share_solid(sites, distances);
    return distances;
}

/// Drops small pieces but the largest one, and returns how many.
std::size_t drop_small_pieces(const SurfaceSites& sites, double strut, std::vector<float>& distances) {
    constexpr double least_diameter = 1.5;  // in struts
    const SitePieces pieces = pieces_of(sites, distances);
    const double radius = 0.5 * least_diameter * strut / sites.spacing;
    const std::size_t largest = pieces.sizes.empty() ? 0 : std::ranges::max(pieces.sizes);
    const auto is_small = [&](std::size_t piece) {
        return static_cast<double>(pieces.sizes[piece]) < std::numbers::pi * radius * radius &&
               pieces.sizes[piece] < largest;
    };
    std::size_t dropped = 0;
    for (std::size_t piece = 0; piece < pieces.sizes.size(); ++piece) dropped += is_small(piece) ? 1 : 0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (pieces.piece[i] != SitePieces::none && is_small(pieces.piece[i]))
            distances[i] = -static_cast<float>(sites.spacing);
    }
    return dropped;
}

/// Returns the pieces that hold together by more than half a strut's width: where two merely touch, they are
/// two.
SitePieces firm_pieces(const SurfaceSites& sites, double strut, std::span<const float> distances) {
    std::vector<float> depths;
    for (const float distance : distances) depths.push_back(distance - static_cast<float>(0.25 * strut));
    return pieces_of(sites, depths);
}

/// Joins the pieces by struts, where the pattern is nearly solid if there is a choice.
void join_pieces(const SurfaceSites& sites, const SitePattern& pattern, float threshold, double strut,
                 PrintablePattern& made) {
    const SitePieces pieces = firm_pieces(sites, strut, made.distance);
    made.pieces = pieces.sizes.size();
    made.joins.clear();
    if (made.pieces < 2) return;
    std::vector<float> reluctance;
    constexpr float a_distance = 4;
    for (const float distance : pattern.distance)
        reluctance.push_back(a_distance * std::max(threshold - distance, 0.0F));
    for (const auto& line : lines_between(sites, pieces, reluctance)) {
        SiteLine& join = made.joins.emplace_back();
        for (const std::uint32_t site : line) join.push_back({site, sites.places[site]});
    }
    add_struts(sites, made.joins, strut, made.distance);
}

}  // namespace

double solid_share(std::span<const float> distances, double spacing) {
    double sum = 0;
    for (const float d : distances) sum += std::clamp(0.5 + static_cast<double>(d) / spacing, 0.0, 1.0);
    return sum / static_cast<double>(distances.size());
}

void add_struts(const SurfaceSites& sites, std::span<const SiteLine> lines, double strut,
                std::vector<float>& distances) {
    SiteLine points;
    for (const auto& line : lines) points.insert(points.end(), line.begin(), line.end());
    if (points.empty()) return;
    const std::vector<float> struts = struts_along(sites, points, strut, strut + 4 * sites.spacing);
    for (std::size_t i = 0; i < struts.size(); ++i) distances[i] = std::max(distances[i], struts[i]);
    share_solid(sites, distances);
}

PrintablePattern printable_pattern(const SurfaceSites& sites, const SiteWindows& windows,
                                   const SitePattern& pattern, std::span<const SiteLine> bridges,
                                   const PrintSettings& settings) {
    constexpr int rounds = 4;
    constexpr double near_enough = 0.005, kept = 0.8;
    PrintablePattern made;
    double aim = settings.cut_share.value_or(settings.share);
    for (int round = 0; round < rounds && aim != made.cut_share; ++round) {
        made.cut_share = aim;
        const float threshold = threshold_for_share(pattern, aim);
        made.distance = cut(sites, windows, pattern, threshold, settings);
        add_struts(sites, bridges, settings.strut, made.distance);
        made.dropped = drop_small_pieces(sites, settings.strut, made.distance);
        join_pieces(sites, pattern, threshold, settings.strut, made);
        made.share = solid_share(made.distance, sites.spacing);
        const double excess = made.share - settings.share;
        if (std::abs(excess) < near_enough) break;
        // Where lines are widened, a pattern of the wanted share would lose most of them.
        aim = std::clamp(aim - excess, kept * settings.share, 1 - kept * (1 - settings.share));
    }
    if (made.share <= 0 || made.share >= 1)
        throw InputError(
            "the pattern is all solid or all void; accepted: another threshold, a narrower strut or a "
            "larger picture");
    made.distance = signed_distances(sites, made.distance, settings.limit);
    return made;
}

}  // namespace lamella
