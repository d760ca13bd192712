// The tile walk: the order in which tiles are looked at changes nothing but how many points are asked for at
// once.
#include "engine/field/tile_walk.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <numeric>
#include <random>

#include "engine/field/range_about.h"

namespace tile_walk_test {

using namespace lamella;

namespace {

/// A number at every point of the plane, of a known metric.
struct Plane {
    std::function<double(dvec2)> value;
    Metric metric;

    Interval range(const Rect& tile) const {
        const dvec2 middle = tile.center();
        return range_about({{tile.lo, 0}, {tile.hi, 0}}, value(middle), metric);
    }
    void values(const WalkPoints& points, std::span<double> out) const {
        std::size_t k = 0;
        points.each([&](dvec2 p) { out[k++] = value(p); });
    }
};

class OneByOne : public TileSampledSolid {
  public:
    explicit OneByOne(const Plane& plane) : plane_(plane) {}
    Interval enter(const Rect& tile) override { return plane_.range(tile); }
    void leave() override {}
    void values(const WalkPoints& points, std::span<double> out) override { plane_.values(points, out); }

  private:
    const Plane& plane_;
};

class ManyAtOnce : public BatchSampledSolid {
  public:
    explicit ManyAtOnce(const Plane& plane, double deviation = infinity)
        : plane_(plane), deviation_(deviation) {}
    void ranges(std::span<const Rect> tiles, std::span<Interval> out) override {
        for (std::size_t i = 0; i < tiles.size(); ++i) out[i] = plane_.range(tiles[i]);
    }
    double deviation(const Rect& /*tile*/) override { return deviation_; }
    void values(const WalkPoints& points, std::span<double> out) override {
        asked.push_back(points.count());
        plane_.values(points, out);
    }

    std::vector<std::size_t> asked;  ///< points of each call

  private:
    const Plane& plane_;
    double deviation_;
};

/// Bands in both directions, mirrored ones, ones with lines between, and ones of odd shapes.
std::vector<RowBand> bands() {
    std::vector<RowBand> all;
    for (const Axis axis : {Axis::x, Axis::y}) {
        for (const double pitch : {0.03, -0.05}) {
            RowBand band{axis, 0.013, pitch, -0.021, std::abs(pitch), -150, 64, 1, -201, 222};
            all.push_back(band);
            band.first = -10;
            band.sub = 4;
            all.push_back(band);
            band.count = 3;
            band.sub = 1;
            band.hi = -190;
            all.push_back(band);
            band.hi = band.lo;
            all.push_back(band);
        }
    }
    return all;
}

/// Discs here and there: their distance, or where only signs count something steeper.
Plane discs(unsigned seed, Metric metric) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-6, 6), size(0.01, 1.2);
    std::vector<dvec3> all;
    for (int i = 0; i < 40; ++i) all.emplace_back(place(random), place(random), size(random));
    return {[all, metric](dvec2 p) {
                double least = infinity;
                for (const dvec3& disc : all) least = std::min(least, glm::length(p - dvec2(disc)) - disc.z);
                return metric == Metric::sign ? least * (3 + p.x * p.x) : least;
            },
            metric};
}

}  // namespace

TEST_CASE("tiles sampled many at a time make the runs of tiles walked one by one") {
    for (const Metric metric : {Metric::exact, Metric::bound, Metric::sign}) {
        const unsigned seed = 11 + static_cast<unsigned>(metric);
        const Plane plane = discs(seed, metric);
        for (const RowBand& band : bands()) {
            INFO("seed " << seed << (band.axis == Axis::x ? ", rows" : ", columns") << " of pitch "
                         << band.along_pitch << ", " << band.lines() << " lines, pixels " << band.lo << " to "
                         << band.hi);
            OneByOne single(plane);
            ManyAtOnce many(plane);
            RunRows expected, rows;
            sampled_spans(single, metric, band, expected);
            sampled_spans(many, metric, band, rows);
            REQUIRE(rows.lines() == static_cast<std::size_t>(band.lines()));
            REQUIRE(rows == expected);
            // A line's runs do not depend on the band.
            for (int row = 0; row < band.count; row += 7) {
                RowBand one = band;
                one.first += row;
                one.count = 1;
                RunRows alone;
                sampled_spans(many, metric, one, alone);
                for (std::size_t k = 0; k < alone.lines(); ++k) {
                    const auto line = rows.line(static_cast<std::size_t>(row * band.sub) + k);
                    REQUIRE(std::ranges::equal(line, alone.line(k)));
                }
            }
        }
    }
}

TEST_CASE("tiles that need not be walked one by one are sampled by the hundred points") {
    const RowBand band{Axis::x, 0, 0.03, 0, 0.03, -32, 64, 1, -200, 200};
    for (const Metric metric : {Metric::exact, Metric::bound, Metric::sign}) {
        const Plane plane = discs(5, metric);
        ManyAtOnce many(plane);
        RunRows rows;
        sampled_spans(many, metric, band, rows);
        REQUIRE(rows.total_length() > 0);
        const auto points = std::accumulate(many.asked.begin(), many.asked.end(), std::size_t{0});
        CHECK(points > 250 * many.asked.size());
        // Memory stays bounded however wide a band is.
        CHECK(*std::max_element(many.asked.begin(), many.asked.end()) < 20'000);
    }
}

TEST_CASE("a distance that deviates a little is sampled less, for the same runs") {
    const Plane exact = discs(7, Metric::exact);
    constexpr double most = 0.004;  // mm
    const Plane wavy{[&](dvec2 p) { return exact.value(p) + most * std::sin(90 * p.x) * std::cos(70 * p.y); },
                     Metric::sign};
    std::size_t few = 0, all = 0;
    for (const RowBand& band : bands()) {
        ManyAtOnce by_signs(wavy), by_deviation(wavy, most);
        RunRows expected, rows;
        sampled_spans(by_signs, Metric::sign, band, expected);
        sampled_spans(by_deviation, Metric::sign, band, rows);
        REQUIRE(rows == expected);
        all += std::accumulate(by_signs.asked.begin(), by_signs.asked.end(), std::size_t{0});
        few += std::accumulate(by_deviation.asked.begin(), by_deviation.asked.end(), std::size_t{0});
    }
    CHECK(2 * few < all);
}

}  // namespace tile_walk_test
