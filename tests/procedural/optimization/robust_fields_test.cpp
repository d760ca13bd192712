// Eroded, intermediate and dilated fields: their gradients, and the sizes of members and gaps in binary
// fields, measured by openings with discs.
#include "procedural/optimization/robust_fields.h"

#include <algorithm>

#include "engine/base/error.h"
#include "tests/procedural/optimization/density_map_checks.h"

namespace robust_fields_test {

using namespace lamella;
using namespace density_map_checks;

namespace {

constexpr int side = 120;
constexpr double binary = 1e6;          // sharpness
constexpr double member = 10, gap = 7;  // elements

struct Picture {
    std::vector<std::uint8_t> solid = std::vector<std::uint8_t>(side * side, 0);

    static bool within(int x, int y) { return x >= 0 && y >= 0 && x < side && y < side; }
    bool at(int x, int y) const { return solid[static_cast<std::size_t>(x + side * y)] != 0; }
    void set(int x, int y) { solid[static_cast<std::size_t>(x + side * y)] = 1; }
};

/// Solid where the field is above 1/2, or with `voids` where it is not.
Picture picture_of(const Values& field, bool voids = false) {
    Picture p;
    for (std::size_t i = 0; i < field.size(); ++i) p.solid[i] = (field[i] > 0.5) != voids ? 1 : 0;
    return p;
}

/// Calls work(dx, dy) for the elements of a disc that is `diameter` elements across.
template <class Work>
void for_each_in_disc(double diameter, const Work& work) {
    const double radius = (diameter - 1) / 2;
    const int reach = static_cast<int>(radius);
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
            if (dx * dx + dy * dy <= radius * radius) work(dx, dy);
}

/// The union of all discs that lie in the picture; the picture goes on beyond its borders.
Picture opened(const Picture& p, double diameter) {
    Picture result;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            bool fits = true;
            for_each_in_disc(diameter, [&](int dx, int dy) {
                fits = fits && p.at(std::clamp(x + dx, 0, side - 1), std::clamp(y + dy, 0, side - 1));
            });
            if (!fits) continue;
            for_each_in_disc(diameter, [&](int dx, int dy) {
                if (Picture::within(x + dx, y + dy)) result.set(x + dx, y + dy);
            });
        }
    return result;
}

LengthScale scale() {
    LengthScaleWish wish;
    wish.member = member * 0.25;
    wish.gap = gap * 0.25;
    wish.element = 0.25;
    wish.dimensions = 2;
    return length_scale_for(wish);
}

RobustFields::Fields fields_of(const Values& design) {
    RobustFields robust({side, side, 1}, Domain(design.size(), 1), scale());
    return robust.forward(design, binary);
}

/// A straight strip through the centre: its share of each element, by the distance of the centre.
Values strip(double angle, double width) {
    Values x(side * side);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const double u = i + 0.5 - side / 2.0, v = j + 0.5 - side / 2.0;
            const double distance = std::fabs(u * std::sin(angle) - v * std::cos(angle));
            x[static_cast<std::size_t>(i + side * j)] = std::clamp(width / 2 - distance + 0.5, 0.0, 1.0);
        }
    return x;
}

/// Discs, solid and void, over each other, of about the radius of the filter and smaller.
Values blobs(unsigned seed) {
    Values x(side * side, 0.0);
    const Values random = random_values(4 * 220, seed);
    for (std::size_t k = 0; k < 220; ++k) {
        const double cx = side * random[4 * k], cy = side * random[4 * k + 1];
        const double radius = 1.5 + 12 * random[4 * k + 2];
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                if (std::hypot(i + 0.5 - cx, j + 0.5 - cy) < radius)
                    x[static_cast<std::size_t>(i + side * j)] = random[4 * k + 3] < 0.5 ? 1 : 0;
    }
    return x;
}

/// Elements of a, far enough from the borders, where the condition holds.
template <class Condition>
int count_inside(const Picture& a, const Condition& condition) {
    constexpr int margin = 24;
    int count = 0;
    for (int y = margin; y < side - margin; ++y)
        for (int x = margin; x < side - margin; ++x)
            if (a.at(x, y) && condition(x, y)) ++count;
    return count;
}

}  // namespace

TEST_CASE("the gradient of robust fields is that of differences", "[optimization]") {
    for (const glm::ivec3 size : {glm::ivec3(9, 8, 1), glm::ivec3(5, 6, 4)})
        for (const auto padding : {FilterPadding::cut, FilterPadding::mirror}) {
            const std::size_t n = count_of(size);
            RobustFields robust(size, random_domain(n, 1), {2.3, 0.72, 0.5, 0.35}, padding);
            const Values some = random_values(n, 2, -1, 1), others = random_values(n, 3, -1, 1);
            const auto times = [](const Values& a, const Values& b) {
                Values c(a.size());
                for (std::size_t i = 0; i < a.size(); ++i) c[i] = a[i] * b[i];
                return c;
            };
            // w (eroded + some intermediate + others dilated), for weights w.
            check_gradient(
                [&](const Values& x) {
                    const auto f = robust.forward(x, 6);
                    Values y(n);
                    for (std::size_t i = 0; i < n; ++i)
                        y[i] = f.eroded[i] + some[i] * f.intermediate[i] + others[i] * f.dilated[i];
                    return y;
                },
                [&](const Values& w) {
                    Values g(n);
                    const Values b = times(w, some), c = times(w, others);
                    robust.backward({w, b, c}, g);
                    return g;
                },
                random_values(n, 4), 5);
        }
}

TEST_CASE("the eroded field lies below the intermediate one, and that below the dilated one",
          "[optimization]") {
    RobustFields robust({9, 8, 7}, random_domain(504, 11), {2.3, 0.72, 0.5, 0.35});
    for (const double sharpness : {0.5, 4.0, 64.0}) {
        const auto f = robust.forward(random_values(504, 12), sharpness);
        for (std::size_t i = 0; i < 504; ++i) {
            REQUIRE(f.eroded[i] <= f.intermediate[i] + 1e-15);
            REQUIRE(f.intermediate[i] <= f.dilated[i] + 1e-15);
        }
    }
}

TEST_CASE(
    "a straight member that survives erosion is as thick as asked, to one element, and some are no "
    "thicker; gaps likewise",
    "[optimization]") {
    for (const bool gaps : {false, true}) {
        const double asked = gaps ? gap : member;
        for (const double angle : {0.0, 0.3, 0.7853981633974483, 1.1}) {
            int survived = 0, vanished = 0;
            double thinnest = 1e9;
            for (double width = 1; width < 16; width += 0.5) {
                CAPTURE(gaps, angle, width);
                Values x = strip(angle, width);
                if (gaps)
                    for (double& v : x) v = 1 - v;
                const auto f = fields_of(x);
                const Picture far = picture_of(gaps ? f.dilated : f.eroded, gaps);
                const Picture design = picture_of(f.intermediate, gaps);
                const auto any = [](int, int) { return true; };
                if (count_inside(far, any) == 0) {
                    if (count_inside(design, any) > 0) ++vanished;
                    continue;
                }
                ++survived;
                const Picture open = opened(design, asked - 1);
                REQUIRE(count_inside(design, [&](int u, int v) { return !open.at(u, v); }) == 0);
                // Thickness by area over length.
                const double length = (side - 48) / std::max(std::cos(angle), std::sin(angle));
                thinnest = std::min(thinnest, count_inside(design, any) / length);
            }
            CHECK(survived > 5);
            CHECK(vanished > 0);  // thinner ones exist, and erosion tells
            CHECK(thinnest > asked - 1);
            CHECK(thinnest <= asked + 1);
        }
    }
}

TEST_CASE(
    "whatever the design variables, what survives erosion lies in a disc of the asked size within the "
    "design, to one element; gaps likewise",
    "[optimization]") {
    for (unsigned seed = 20; seed < 28; ++seed)
        for (const bool gaps : {false, true}) {
            CAPTURE(seed, gaps);
            const auto f = fields_of(blobs(seed));
            const Picture far = picture_of(gaps ? f.dilated : f.eroded, gaps);
            const Picture design = picture_of(f.intermediate, gaps);
            const double asked = gaps ? gap : member;
            const Picture open = opened(design, asked - 1), raw = picture_of(blobs(seed), gaps);
            const auto any = [](int, int) { return true; };
            CHECK(count_inside(far, any) > 200);
            CHECK(count_inside(far, [&](int x, int y) { return !open.at(x, y); }) == 0);
            // The design variables themselves do have thinner members.
            const Picture raw_open = opened(raw, asked - 1);
            CHECK(count_inside(raw, [&](int x, int y) { return !raw_open.at(x, y); }) > 20);
        }
}

TEST_CASE(
    "around all that survives erosion the design is solid for the distance of the contours, to one "
    "element",
    "[optimization]") {
    const LengthScale s = scale();
    const double distance = s.radius * contour_distance(s.eroded, s.intermediate, 2);
    REQUIRE(distance > 2);
    for (unsigned seed = 40; seed < 46; ++seed) {
        const auto f = fields_of(blobs(seed));
        const Picture eroded = picture_of(f.eroded), design = picture_of(f.intermediate);
        int outside = 0;
        count_inside(eroded, [&](int x, int y) {
            for_each_in_disc(2 * (distance - 1) + 1, [&](int dx, int dy) {
                if (!design.at(x + dx, y + dy)) ++outside;
            });
            return true;
        });
        CHECK(outside == 0);
    }
}

TEST_CASE("robust fields give the same bits on any number of threads", "[optimization]") {
    const Values x = random_values(4800, 61), g = random_values(4800, 62, -1, 1);
    check_same_bits([&] {
        RobustFields robust({20, 16, 15}, random_domain(4800, 63), {2.7, 0.7, 0.5, 0.3});
        const auto f = robust.forward(x, 5);
        Values all(4800);
        robust.backward({g, {}, g}, all);
        for (const auto* field : {&f.eroded, &f.intermediate, &f.dilated})
            all.insert(all.end(), field->begin(), field->end());
        return all;
    });
}

TEST_CASE("robust fields refuse thresholds out of order and a gradient before the fields", "[optimization]") {
    const Domain domain(12, 1);
    CHECK_THROWS_AS(RobustFields({4, 3, 1}, domain, {2, 0.4, 0.5, 0.3}), InputError);
    CHECK_THROWS_AS(RobustFields({4, 3, 1}, domain, {0.5, 0.7, 0.5, 0.3}), InputError);
    const RobustFields robust({4, 3, 1}, domain, {2, 0.7, 0.5, 0.3});
    Values out(12);
    CHECK_THROWS_AS(robust.backward({out, {}, {}}, out), FaultError);
}

}  // namespace robust_fields_test
