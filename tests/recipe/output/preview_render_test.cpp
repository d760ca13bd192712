// Pictures show part, cut and supports in colours that tell them apart, each where it is.
#include "recipe/output/preview_render.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/solids/primitives.h"

namespace preview_render_test {

using namespace lamella;

namespace {

enum class Kind { ground, part, cut, support };

/// By hue: the ground is grey, the part blue, its cut orange, supports and their cut sand.
Kind kind_at(const Picture& image, int x, int y) {
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(x));
    const int r = image.rgb[at], g = image.rgb[at + 1], b = image.rgb[at + 2];
    if (b - r > 18) return Kind::part;
    if (r - b < 18) return Kind::ground;
    return 2 * g > r + b + (r - b) / 5 ? Kind::support : Kind::cut;
}

int count(const Picture& image, Kind kind) {
    int sum = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) sum += kind_at(image, x, y) == kind ? 1 : 0;
    }
    return sum;
}

// A slab on a wall that stands to the left.
const Box slab{{-10, -10, 10}, {10, 10, 14}};
const Box wall{{-8, -8, 0}, {-6, 8, 10}};
const Box whole{{-10, -10, 0}, {10, 10, 14}};

PreviewOptions from_the_front(char cut) {
    PreviewOptions options;
    options.width = options.height = 160;
    options.azimuth = 0;
    options.elevation = 5;
    options.cut = cut;
    return options;
}

}  // namespace

TEST_CASE("supports stand off from the part in a picture, whole and cut", "[preview]") {
    const FieldPtr part = make_box(slab);
    const Picture none = render_preview(part, nullptr, whole, from_the_front('-'));
    CHECK(count(none, Kind::support) == 0);
    CHECK(count(none, Kind::cut) == 0);
    const int slab_pixels = count(none, Kind::part);
    CHECK(slab_pixels > 500);

    const Picture both = render_preview(part, make_box(wall), whole, from_the_front('-'));
    CHECK(count(both, Kind::cut) == 0);
    CHECK(count(both, Kind::support) > 300);
    // Along a row through the wall's middle: only supports; above it: only the part.
    Rect part_seen;
    Rect supports_seen;
    for (int y = 0; y < both.height; ++y) {
        for (int x = 0; x < both.width; ++x) {
            const dvec2 p(x, y);
            if (kind_at(both, x, y) == Kind::part) part_seen = unite(part_seen, Rect{p, p});
            if (kind_at(both, x, y) == Kind::support) supports_seen = unite(supports_seen, Rect{p, p});
        }
    }
    CHECK(supports_seen.lo.y > part_seen.lo.y + 10);
    CHECK(supports_seen.lo.y >= part_seen.hi.y - 8);  // seen from below, the slab's front covers their tops
    CHECK(supports_seen.hi.y > part_seen.hi.y + 30);
    CHECK(supports_seen.hi.x < both.width * 0.5);  // the wall stands to the left

    // Cut through the wall: the part's face is orange, the wall's sand.
    PreviewOptions cut = from_the_front('y');
    const Picture open = render_preview(part, make_box(wall), whole, cut);
    CHECK(count(open, Kind::cut) > 500);
    CHECK(count(open, Kind::support) > 300);
    for (int y = open.height * 2 / 3; y < open.height; ++y) {
        for (int x = 0; x < open.width; ++x) {
            REQUIRE(kind_at(open, x, y) != Kind::cut);
        }
    }
}

namespace {

/// What part and supports take of a picture: views differ by how closely the grid encloses these.
Rect framed(const Picture& image) {
    Rect seen;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const dvec2 p(x, y);
            if (kind_at(image, x, y) != Kind::ground) seen = unite(seen, Rect{p, p + 1.0});
        }
    }
    return seen;
}

/// The pixel of a picture at a share of its frame.
std::pair<int, int> pixel_at(const Rect& frame, double across, double down) {
    return {static_cast<int>(frame.lo.x + across * frame.size().x),
            static_cast<int>(frame.lo.y + down * frame.size().y)};
}

}  // namespace

TEST_CASE("a quick picture shows the same things in the same places as an exact one", "[preview]") {
    constexpr int points = 100;
    for (const char cut : {'-', 'y'}) {
        PreviewOptions options = from_the_front(cut);
        const Picture exact = render_preview(make_box(slab), make_box(wall), whole, options);
        options.quick = true;
        const Picture quick = render_preview(make_box(slab), make_box(wall), whole, options);
        const Rect exact_frame = framed(exact), quick_frame = framed(quick);
        CHECK(quick_frame.size().x == Approx(exact_frame.size().x).epsilon(0.08));
        CHECK(quick_frame.size().y == Approx(exact_frame.size().y).epsilon(0.08));
        int differ = 0;
        for (int j = 0; j < points; ++j) {
            for (int i = 0; i < points; ++i) {
                const auto [x, y] = pixel_at(exact_frame, (i + 0.5) / points, (j + 0.5) / points);
                const auto [u, v] = pixel_at(quick_frame, (i + 0.5) / points, (j + 0.5) / points);
                differ += kind_at(exact, x, y) != kind_at(quick, u, v) ? 1 : 0;
            }
        }
        CHECK(differ < points * points / 25);  // along the outlines
    }
}

TEST_CASE("a quick picture of a ball is shaded as an exact one", "[preview]") {
    PreviewOptions options = from_the_front('-');
    const FieldPtr ball = make_sphere(dvec3(0), 10);
    const Picture exact = render_preview(ball, nullptr, ball->bounds(), options);
    options.quick = true;
    const Picture quick = render_preview(ball, nullptr, ball->bounds(), options);
    const Rect exact_frame = framed(exact), quick_frame = framed(quick);
    const auto green = [](const Picture& image, std::pair<int, int> p) {
        return int{image.rgb[3 * static_cast<std::size_t>(p.second * image.width + p.first) + 1]};
    };
    constexpr int points = 100;
    double sum = 0;
    int seen = 0, far = 0;
    for (int j = 0; j < points; ++j) {
        for (int i = 0; i < points; ++i) {
            const double across = (i + 0.5) / points, down = (j + 0.5) / points;
            if (std::hypot(across - 0.5, down - 0.5) > 0.45) continue;
            const int difference = std::abs(green(exact, pixel_at(exact_frame, across, down)) -
                                            green(quick, pixel_at(quick_frame, across, down)));
            sum += difference;
            far += difference > 30 ? 1 : 0;
            ++seen;
        }
    }
    CHECK(seen > 6000);
    CHECK(sum / seen < 12);  // of 255: steps of the grid show on it
    CHECK(far < seen / 20);
}

TEST_CASE("a picture does not change with the number of threads", "[preview]") {
    PreviewOptions options = from_the_front('x');
    options.threads = 1;
    const Picture one = render_preview(make_box(slab), make_box(wall), whole, options);
    options.threads = 3;
    CHECK(render_preview(make_box(slab), make_box(wall), whole, options).rgb == one.rgb);
}

}  // namespace preview_render_test
