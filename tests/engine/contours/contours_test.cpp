// Contours: closed, simple, oriented, nested, near the border.
#include "engine/contours/contours.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/contours/lattice.h"
#include "engine/field/slice_context.h"
#include "engine/solids/beam_slice.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace contours_test {

using namespace lamella;

namespace {

bool segments_meet(dvec2 a, dvec2 b, dvec2 c, dvec2 d) {
    if (glm::any(glm::lessThan(glm::max(a, b), glm::min(c, d))) ||
        glm::any(glm::lessThan(glm::max(c, d), glm::min(a, b)))) {
        return false;
    }
    const double o1 = cross(b - a, c - a), o2 = cross(b - a, d - a), o3 = cross(d - c, a - c),
                 o4 = cross(d - c, b - c);
    if (((o1 > 0) != (o2 > 0)) && ((o3 > 0) != (o4 > 0))) return true;
    const auto on = [](dvec2 p, dvec2 q, dvec2 r, double o) {
        return o == 0 && std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) &&
               std::min(p.y, q.y) <= r.y && r.y <= std::max(p.y, q.y);
    };
    return on(a, b, c, o1) || on(a, b, d, o2) || on(c, d, a, o3) || on(c, d, b, o4);
}

bool contains(const Contour& contour, dvec2 p) {
    bool inside = false;
    const auto& v = contour.points;
    for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
        if ((v[i].y > p.y) != (v[j].y > p.y) &&
            p.x < (v[j].x - v[i].x) * (p.y - v[i].y) / (v[j].y - v[i].y) + v[i].x) {
            inside = !inside;
        }
    }
    return inside;
}

/// Brute force over all pairs of segments: no two touch unless they are neighbours.
void check_simple(const std::vector<Contour>& contours) {
    struct Segment {
        dvec2 a, b;
        std::size_t contour, index, size;
    };
    std::vector<Segment> all;
    for (std::size_t c = 0; c < contours.size(); ++c) {
        const auto& v = contours[c].points;
        REQUIRE(v.size() >= 3);
        for (std::size_t i = 0; i < v.size(); ++i) {
            REQUIRE(v[i] != v[(i + 1) % v.size()]);
            all.push_back({v[i], v[(i + 1) % v.size()], c, i, v.size()});
        }
    }
    std::size_t met = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 1; j < all.size(); ++j) {
            const Segment &s = all[i], &t = all[j];
            if (s.contour == t.contour && (t.index == s.index + 1 || (s.index == 0 && t.index + 1 == t.size)))
                continue;
            if (segments_meet(s.a, s.b, t.a, t.b)) {
                ++met;
                WARN("contours " << s.contour << " (" << s.index << " of " << s.size << ") and " << t.contour
                                 << " (" << t.index << " of " << t.size << "): " << s.a.x << "," << s.a.y
                                 << " " << s.b.x << "," << s.b.y << " meets " << t.a.x << "," << t.a.y << " "
                                 << t.b.x << "," << t.b.y);
            }
        }
    }
    REQUIRE(met == 0);
}

/// Orientation and parents against point-in-polygon.
void check_nested(const std::vector<Contour>& contours) {
    for (std::size_t c = 0; c < contours.size(); ++c) {
        REQUIRE((signed_area(contours[c].points) < 0) == contours[c].hole);
        std::vector<std::size_t> around;
        for (std::size_t o = 0; o < contours.size(); ++o) {
            if (o != c && contains(contours[o], contours[c].points[0])) around.push_back(o);
        }
        REQUIRE(contours[c].hole == (around.size() % 2 == 1));
        // The direct parent is the one that lies inside all the others.
        int parent = -1;
        for (const std::size_t o : around) {
            std::size_t depth = 0;
            for (const std::size_t p : around)
                depth += p != o && contains(contours[p], contours[o].points[0]) ? 1 : 0;
            if (depth + 1 == around.size()) parent = static_cast<int>(o);
        }
        REQUIRE(contours[c].parent == parent);
    }
}

double total_area(const std::vector<Contour>& contours) {
    double sum = 0;
    for (const Contour& c : contours) sum += signed_area(c.points);
    return sum;
}

std::vector<Contour> contours_of(const FieldPtr& field, double z, double tolerance) {
    SliceContext context;
    Scratch scratch;
    return trace_contours(context.slice(*field, z), tolerance, scratch);
}

/// Runs given line by line on a lattice with nodes at whole millimetres, to build cells by hand.
class HandMade : public SliceField {
  public:
    /// Solid wherever the pixel picture has an `#`; a pixel is a square of `side` mm, the first string is the
    /// top row.
    HandMade(std::vector<std::string> picture, double side) : picture_(std::move(picture)), side_(side) {}
    void runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const override {
        out.clear();
        for (int l = 0; l < band.lines(); ++l) {
            const double v = band.line(l);
            const int n = static_cast<int>(band.axis == Axis::x ? picture_[0].size() : picture_.size());
            for (int k = 0; k < n; ++k) {
                const bool in = band.axis == Axis::x ? at(k, cell(v)) : at(cell(v), k);
                if (!in) continue;
                out.push(round_run(band.coordinate(k * side_)), round_run(band.coordinate((k + 1) * side_)));
            }
            out.end_line();
        }
    }
    Interval range(const Rect& /*r*/) const override { return {-infinity, infinity}; }
    void sample(const Tile& /*tile*/, std::span<float> /*out*/) const override {}
    Rect bounds() const override {
        return {
            {0, 0},
            {static_cast<double>(picture_[0].size()) * side_, static_cast<double>(picture_.size()) * side_}};
    }

  private:
    int cell(double v) const { return static_cast<int>(std::floor(v / side_)); }
    bool at(int i, int j) const {
        const int rows = static_cast<int>(picture_.size());
        if (i < 0 || j < 0 || j >= rows || i >= static_cast<int>(picture_[0].size())) return false;
        return picture_[static_cast<std::size_t>(rows - 1 - j)][static_cast<std::size_t>(i)] == '#';
    }
    std::vector<std::string> picture_;
    double side_;
};

}  // namespace

TEST_CASE("a torus cut through its centre has two contours, an outer one and its hole") {
    const auto contours = contours_of(make_torus({5, 5, 0}, 3, 1), 0, 0.02);
    REQUIRE(contours.size() == 2);
    check_simple(contours);
    check_nested(contours);
    REQUIRE(total_area(contours) == Approx(pi * (16 - 4)).epsilon(1e-3));
}

TEST_CASE("contours lie within the tolerance of the border") {
    const std::vector<FieldPtr> fields = {
        make_sphere({0, 0, 0}, 3), make_box({{-2.013, -1.4, -1}, {1.77, 2.2, 1}}),
        make_round_cone({{-2, -1, -0.4}, 0.8, {2, 1, 0.3}, 0.3}),
        make_difference(make_sphere({0, 0, 0}, 3), make_cylinder({0.5, 0.2, -5}, {0.5, 0.2, 5}, 1.1))};
    for (const FieldPtr& field : fields) {
        for (const double tolerance : {0.2, 0.05, 0.013}) {
            const auto contours = contours_of(field, 0.07, tolerance);
            REQUIRE_FALSE(contours.empty());
            for (const Contour& contour : contours) {
                for (std::size_t i = 0; i < contour.points.size(); ++i) {
                    const dvec2 p = contour.points[i], q = contour.points[(i + 1) % contour.points.size()];
                    for (int k = 0; k < 4; ++k) {
                        const dvec2 at = p + (q - p) * (k / 4.0);
                        // The 3D distance is at most the distance in the plane.
                        REQUIRE(std::abs(field->value({at, 0.07})) <= tolerance);
                    }
                }
            }
        }
    }
}

TEST_CASE("a straight edge needs few vertices") {
    const auto contours = contours_of(make_box({{-2.013, -1.4, -1}, {1.77, 2.2, 1}}), 0, 0.01);
    REQUIRE(contours.size() == 1);
    REQUIRE(contours[0].points.size() <= 16);
    REQUIRE(signed_area(contours[0].points) == Approx(3.783 * 3.6).epsilon(1e-3));
}

TEST_CASE("random thin beams give closed, simple, nested contours at every resolution") {
    class Beams : public Field {
      public:
        explicit Beams(std::vector<Beam> beams) : beams_(std::move(beams)) {}
        double value(dvec3 p) const override {
            double d = infinity;
            for (const Beam& beam : beams_) d = std::min(d, signed_distance(beam, p));
            return d;
        }
        const SliceField& slice(SliceContext& context, double z) const override {
            return context.make<BeamSlice>(*this, beams_, z);
        }
        Box bounds() const override { return {dvec3(-1), dvec3(11)}; }

      private:
        std::vector<Beam> beams_;
    };
    for (unsigned seed = 1; seed <= 6; ++seed) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> at(0, 10), height(-0.6, 0.6), radius(0.02, 0.3);
        std::vector<Beam> beams;
        for (int k = 0; k < 60; ++k) {
            beams.push_back({{at(random), at(random), height(random)},
                             radius(random),
                             {at(random), at(random), height(random)},
                             radius(random)});
        }
        const auto field = std::make_shared<Beams>(beams);
        for (const double tolerance : {0.5, 0.11, 0.05}) {
            INFO("tolerance " << tolerance);
            const auto contours = contours_of(field, 0, tolerance);
            REQUIRE_FALSE(contours.empty());
            check_simple(contours);
            check_nested(contours);
        }
        // Area against a fine count of points.
        SliceContext context;
        Scratch scratch;
        const SliceField& slice = context.slice(*field, 0);
        RowBand fine{Axis::x, -1, 0.01, -1, 0.01, 0, 1200, 1, 0, 1200};
        RunRows rows;
        slice.runs(fine, scratch, rows);
        const double area = static_cast<double>(rows.total_length()) / run_unit * 0.01 * 0.01;
        REQUIRE(total_area(contours_of(field, 0, 0.02)) == Approx(area).epsilon(0.01));
    }
}

TEST_CASE("solids that touch the lattice's nodes, each other and the border stay simple") {
    // Squares of one lattice pitch whose sides lie on lattice lines, corners touching: every half-open rule
    // is met at once.
    Scratch scratch;
    const double tolerance = 0.1;
    for (const double side : {0.1, 0.05, 0.15, 0.0999, 0.3}) {
        INFO("side " << side);
        const HandMade checker({"#.#.#.", ".#.#.#", "#.#.#.", "######", "......", "#.##.#"}, side);
        const auto contours = trace_contours(checker, tolerance, scratch);
        check_simple(contours);
        check_nested(contours);
    }
    const HandMade ring({"#####", "#...#", "#.#.#", "#...#", "#####"}, 0.3);
    const auto contours = trace_contours(ring, 0.05, scratch);
    REQUIRE(contours.size() == 3);
    check_simple(contours);
    check_nested(contours);
    REQUIRE(total_area(contours) == Approx(17 * 0.09).epsilon(0.05));
}

TEST_CASE("rows and columns that disagree are mended to closed contours") {
    class Torn : public SliceField {
      public:
        explicit Torn(unsigned seed) : seed_(seed) {}
        void runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const override {
            out.clear();
            std::mt19937 random(seed_ + static_cast<unsigned>(band.axis));
            for (int l = 0; l < band.first * band.sub; ++l) random.discard(8);
            for (int l = 0; l < band.lines(); ++l) {
                int u = 0;
                for (int k = 0; k < 4; ++k) {
                    const int begin = u + static_cast<int>(random() % 900),
                              end = begin + static_cast<int>(random() % 700);
                    out.push(std::min(begin, band.hi * run_unit), std::min(end, band.hi * run_unit));
                    u = end + 1;
                    random();
                }
                out.end_line();
            }
        }
        Interval range(const Rect& /*r*/) const override { return {-infinity, infinity}; }
        void sample(const Tile& /*tile*/, std::span<float> /*out*/) const override {}
        Rect bounds() const override { return {{0, 0}, {1.6, 1.6}}; }

      private:
        unsigned seed_;
    };
    // Rows and columns that know nothing of each other: the worst a field can do.
    for (unsigned seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Scratch scratch;
        const auto contours = trace_contours(Torn(seed), 0.1, scratch);
        check_simple(contours);
        check_nested(contours);
    }
}

TEST_CASE("an empty slice has no contours") {
    REQUIRE(contours_of(make_sphere({0, 0, 0}, 1), 2, 0.1).empty());
    REQUIRE(contours_of(make_empty(), 0, 0.1).empty());
}

}  // namespace contours_test
