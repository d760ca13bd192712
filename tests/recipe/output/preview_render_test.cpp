// Pictures show part, cut and supports in colours that tell them apart, each where it is.
#include "recipe/output/preview_render.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <thread>

#include "engine/solids/csg.h"
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

/// The scale of a steady view: half its shorter side spans the tangent of 14 degrees, and the sphere around
/// the bounds fills 86 % of that angle.
double steady_distance(const Box& bounds) {
    return length(bounds.size()) / 2 / std::sin(14 * pi / 180 * 0.86);
}
double pixels_of(double tangent, const PreviewOptions& options) {
    return tangent / std::tan(14 * pi / 180) * options.width / 2;
}

PreviewOptions steady(double azimuth, char cut) {
    PreviewOptions options;
    options.width = options.height = 256;
    options.azimuth = azimuth;
    options.elevation = 0;
    options.cut = cut;
    options.steady = true;
    return options;
}

}  // namespace

TEST_CASE("the outline of a ball is the circle of its tangents", "[preview]") {
    const FieldPtr ball = make_sphere(dvec3(1, 2, 3), 10);
    const PreviewOptions options = steady(20, '-');
    const Picture image = render_preview(ball, nullptr, ball->bounds(), options);
    const double radius = pixels_of(std::tan(std::asin(10 / steady_distance(ball->bounds()))), options);
    CHECK(radius > 50);
    int wrong = 0, seen = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double from_centre = std::hypot(x + 0.5 - 128, y + 0.5 - 128);
            if (std::abs(from_centre - radius) < 1) continue;
            const bool inside = from_centre < radius;
            wrong += (kind_at(image, x, y) == Kind::part) != inside ? 1 : 0;
            seen += inside ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(seen > 7000);
}

TEST_CASE("light on a ball changes smoothly and grows towards the lamp", "[preview]") {
    const FieldPtr ball = make_sphere(dvec3(0), 10);
    const PreviewOptions options = steady(0, '-');
    const Picture image = render_preview(ball, nullptr, ball->bounds(), options);
    const auto green = [&](int x, int y) {
        return int{image.rgb[3 * static_cast<std::size_t>(y * 256 + x) + 1]};
    };
    const double radius = pixels_of(std::tan(std::asin(10 / steady_distance(ball->bounds()))), options);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x + 1 < 256; ++x) {
            if (std::hypot(x + 0.5 - 128, y + 0.5 - 128) > 0.9 * radius) continue;
            REQUIRE(std::abs(green(x, y) - green(x + 1, y)) <= 8);
            REQUIRE(std::abs(green(x, y) - green(x, y + 1)) <= 8);
        }
    }
    // The lamp stands above, to the right, on the eye's side.
    const int far = static_cast<int>(0.6 * radius);
    CHECK(green(128, 128 - far) > green(128, 128) + 10);
    CHECK(green(128, 128) > green(128, 128 + far) + 10);
    CHECK(green(128 + far, 128) > green(128 - far, 128) + 5);
}

TEST_CASE("the face of a cut ball is a disc of one colour", "[preview]") {
    const FieldPtr ball = make_sphere(dvec3(0), 10);
    const PreviewOptions options = steady(0, 'y');
    const Picture image = render_preview(ball, nullptr, ball->bounds(), options);
    // The plane through the centre is as far from the eye as the centre.
    const double radius = pixels_of(10 / steady_distance(ball->bounds()), options);
    CHECK(count(image, Kind::cut) == Approx(pi * radius * radius).epsilon(0.02));
    const std::size_t middle = 3 * (128 * 256 + 128);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            if (std::hypot(x + 0.5 - 128, y + 0.5 - 128) > radius - 2) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                REQUIRE(std::abs(int{image.rgb[3 * static_cast<std::size_t>(y * 256 + x) + k]} -
                                 int{image.rgb[middle + k]}) <= 2);
            }
        }
    }
}

TEST_CASE("thin beams cover what their radius and length say, without holes", "[preview]") {
    // Slanted, so that the beam lies oblique to slices, rows and columns.
    const dvec3 end(14, 0, 9);
    for (const double radius : {0.2, 0.35, 0.6}) {
        const FieldPtr beam = make_round_cone({-end, radius, end, radius});
        const PreviewOptions options = steady(0, '-');
        const Box bounds{dvec3(-18), dvec3(18)};
        const Picture image = render_preview(beam, nullptr, bounds, options);
        const double scale = pixels_of(1 / steady_distance(bounds), options);
        const double area = (2 * radius * 2 * length(end) + pi * radius * radius) * scale * scale;
        double covered = 0;  // by colour: darkest where the beam fills the pixel
        for (int y = 0; y < 256; ++y) {
            for (int x = 0; x < 256; ++x) covered += kind_at(image, x, y) == Kind::part ? 1 : 0;
        }
        INFO(radius << " mm: " << covered << " of " << area << " px");
        // A beam thinner than two pixels is drawn somewhat thicker.
        CHECK(covered > 0.8 * area);
        CHECK(covered < 1.2 * area + 2.0 * 2 * length(end) * scale * std::max(0.0, 1 - radius * scale));
        // Every column along the beam shows it.
        const int reach = static_cast<int>(0.95 * end.x * scale);
        for (int x = 128 - reach; x < 128 + reach; ++x) {
            int darkest = 255;
            for (int y = 0; y < 256; ++y)
                darkest = std::min(darkest, int{image.rgb[3 * static_cast<std::size_t>(y * 256 + x)]});
            REQUIRE(darkest < 215);
        }
    }
}

TEST_CASE("a scene is drawn from several sides as pictures of its own are", "[preview]") {
    const FieldPtr part = make_box(slab);
    const PreviewScene scene(part, make_box(wall), whole, {160, 2, {}});
    for (const double azimuth : {0.0, 70.0, 0.0}) {
        PreviewOptions options = from_the_front('-');
        options.azimuth = azimuth;
        CHECK(scene.render(options).rgb == render_preview(part, make_box(wall), whole, options).rgb);
        // A scene keeps what a picture of a cut part leaves out: the views differ along edges at most.
        options.cut = 'y';
        options.steady = true;
        const Picture view = scene.render(options);
        const Picture alone = render_preview(part, make_box(wall), whole, options);
        for (const Kind kind : {Kind::part, Kind::cut, Kind::support})
            CHECK(count(view, kind) == Approx(count(alone, kind)).epsilon(0.03).margin(10));
    }
}

TEST_CASE("scenes and views stop soon when they are cancelled", "[preview]") {
    const FieldPtr part = make_box(slab);
    CancelToken cancel;
    const PreviewScene scene(part, nullptr, whole, {160, 1, {}}, &cancel);
    PreviewOptions options = from_the_front('x');
    CHECK(scene.render(options, &cancel).width == 160);
    cancel.cancel();
    CHECK_THROWS_AS(scene.render(options, &cancel), Interrupted);
    CHECK_THROWS_AS(PreviewScene(part, nullptr, whole, {160, 1, {}}, &cancel), Interrupted);

    CancelToken later;
    options.width = options.height = 4096;  // takes seconds
    std::chrono::steady_clock::time_point asked;
    std::thread stopper([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        asked = std::chrono::steady_clock::now();
        later.cancel();
    });
    CHECK_THROWS_AS(scene.render(options, &later), Interrupted);
    const auto stopped = std::chrono::steady_clock::now();
    stopper.join();
    CHECK(stopped - asked < std::chrono::milliseconds(500));  // 50 on a machine that does nothing else
}

TEST_CASE("a picture does not change with the number of threads", "[preview]") {
    PreviewOptions options = from_the_front('x');
    options.threads = 1;
    const Picture one = render_preview(make_box(slab), make_box(wall), whole, options);
    for (const int threads : {3, 4}) {
        options.threads = threads;
        CHECK(render_preview(make_box(slab), make_box(wall), whole, options).rgb == one.rgb);
    }
}

TEST_CASE("a picture of what is printed has the scale of the whole part", "[preview]") {
    const FieldPtr part = make_union({make_box(slab), make_box(wall)});
    PreviewOptions view = from_the_front('x');  // the cut does not count
    const auto printed_to = [&](double z) {
        view.printed_to = z;
        return render_preview(part, nullptr, whole, view);
    };
    const auto rows_of = [](const Picture& image) {
        int first = image.height, last = -1;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                if (kind_at(image, x, y) == Kind::ground) continue;
                first = std::min(first, y);
                last = y;
            }
        }
        return last - first + 1;
    };
    // Nothing is above the whole part: its picture, but for the face where it ends.
    CHECK(printed_to(20).rgb == render_preview(part, nullptr, whole, from_the_front('-')).rgb);
    const int all = rows_of(printed_to(20));
    const Picture half = printed_to(7);
    CHECK(count(half, Kind::cut) > 0);
    CHECK(count(half, Kind::part) > 50);
    CHECK(rows_of(half) == Approx(all / 2.0).margin(0.12 * all));
    CHECK(rows_of(printed_to(3.5)) < 0.7 * rows_of(half));
    // The slab is not there yet, so that nothing is right of the wall.
    for (int y = 0; y < half.height; ++y) CHECK(kind_at(half, 3 * half.width / 4, y) == Kind::ground);
}

}  // namespace preview_render_test
