// Faces by their normals, directions on a spiral, and a search that halves its steps.
#include "procedural/orientation/best_orientations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Returns the mean normal of what is flat about a direction: of normals ever closer to the mean.
dvec3 flattest(const SurfaceCover& cover, dvec3 direction) {
    for (const double within : {1.0, 0.25, 0.05}) {
        dvec3 sum(0);
        for (std::size_t i = 0; i < cover.areas.size(); ++i) {
            const dvec3 n = cover.sites.normals[i];
            if (dot(n, direction) > std::cos(within * degree)) sum += cover.areas[i] * n;
        }
        if (sum == dvec3(0)) break;
        direction = sum / length(sum);
    }
    return direction;
}

/// Returns the outward directions of faces, the largest first: normals that share a cell of a grid on a cube.
std::vector<dvec3> face_directions(const SurfaceCover& cover) {
    constexpr double cells = 48, least_share = 0.005;
    struct Face {
        double area = 0;
        dvec3 sum{0};
    };
    std::map<std::tuple<int, int, int>, Face> faces;
    double total = 0;
    for (std::size_t i = 0; i < cover.areas.size(); ++i) {
        const dvec3 n = cover.sites.normals[i], a = glm::abs(n);
        const dvec3 on_cube = glm::round(n / std::max({a.x, a.y, a.z}) * cells);
        Face& face =
            faces[{static_cast<int>(on_cube.x), static_cast<int>(on_cube.y), static_cast<int>(on_cube.z)}];
        face.area += cover.areas[i];
        face.sum += cover.areas[i] * n;
        total += cover.areas[i];
    }
    std::vector<Face> large;
    for (const auto& [cell, face] : faces) {
        if (face.area >= least_share * total) large.push_back(face);
    }
    std::ranges::stable_sort(large, std::greater<>{}, &Face::area);
    std::vector<dvec3> directions;
    directions.reserve(large.size());
    for (const Face& face : large) directions.push_back(flattest(cover, face.sum / length(face.sum)));
    return directions;
}

/// Returns directions on Fibonacci's spiral, evenly over the sphere.
std::vector<dvec3> sphere_directions(int count) {
    std::vector<dvec3> directions;
    directions.reserve(static_cast<std::size_t>(count));
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1) / static_cast<double>(count), radius = std::sqrt(1 - z * z);
        const SineCosine turn = sine_cosine(golden * i);
        directions.emplace_back(radius * turn.cosine, radius * turn.sine, z);
    }
    return directions;
}

struct Scored {
    OrientationFigures figures;
    double score = infinity;
};

/// Turns an orientation towards better ones, by steps from 8 degrees down to half a degree.
Scored improved(const SurfaceCover& cover, const OrientationRules& rules, const OrientationScore& score,
                Scored best) {
    for (double step = 8; step >= 0.5; step /= 2) {
        for (bool is_better = true; is_better;) {
            is_better = false;
            const dvec3 up = best.figures.up;
            const auto [a, b] = across(up);
            for (const dvec3& way : {a, -a, b, -b}) {
                const dvec3 turned = glm::normalize(up + std::tan(step * degree) * way);
                Scored other{orientation_figures(cover, turned, rules), 0};
                other.score = score(other.figures);
                if (!(other.score < best.score)) continue;
                best = other;
                is_better = true;
            }
        }
    }
    return best;
}

}  // namespace

std::vector<dvec3> candidate_directions(const SurfaceCover& cover, int on_sphere) {
    std::vector<dvec3> directions = face_directions(cover);
    for (dvec3& direction : directions) direction = -direction;
    const std::vector<dvec3> spread = sphere_directions(on_sphere);
    directions.insert(directions.end(), spread.begin(), spread.end());
    return directions;
}

std::vector<OrientationFigures> best_orientations(const SurfaceCover& cover, const OrientationRules& rules,
                                                  const OrientationScore& score, std::size_t wanted,
                                                  double apart, const CancelToken* cancel) {
    constexpr int on_sphere = 300;
    const std::vector<dvec3> directions = candidate_directions(cover, on_sphere);
    const std::size_t faces = directions.size() - static_cast<std::size_t>(on_sphere);
    std::vector<Scored> all(directions.size());
    parallel_for(all.size(), [&](std::size_t i) {
        stop_if_cancelled(cancel);
        all[i].figures = orientation_figures(cover, directions[i], rules);
        all[i].score = score(all[i].figures);
    });
    const auto by_score = [](const Scored& scored) { return scored.score; };
    std::ranges::stable_sort(all.begin() + static_cast<std::ptrdiff_t>(faces), all.end(), {}, by_score);
    constexpr std::size_t most_refined = 24;
    const std::size_t refined = std::min({all.size() - faces, 2 * wanted, most_refined});
    parallel_for(refined, [&](std::size_t i) {
        stop_if_cancelled(cancel);
        all[faces + i] = improved(cover, rules, score, all[faces + i]);
    });
    std::ranges::stable_sort(all, {}, by_score);
    std::vector<OrientationFigures> best;
    for (const Scored& scored : all) {
        const auto is_near = [&](const OrientationFigures& other) {
            return dot(other.up, scored.figures.up) > std::cos(apart * degree);
        };
        if (std::ranges::none_of(best, is_near)) best.push_back(scored.figures);
        if (best.size() == wanted) break;
    }
    return best;
}

}  // namespace lamella
