// Beads cut where they leave what is under them: nothing lost, and every piece what it says.
#include "printers/toolpath/hanging_beads.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "tests/printers/polygons/hand_made_contours.h"
#include "tests/printers/toolpath/bead_length.h"

namespace hanging_beads_test {

using namespace lamella;
using namespace lamella::test;

namespace {

constexpr double height = 0.2;

Polygons discs() {
    Polygons polygons;
    for (int i = 0; i < 25; ++i)
        polygons.push_back(to_polygon(disc_contour({i % 5 * 8.0, i / 5 * 8.0}, 2 + i % 3).points));
    return polygons;
}

}  // namespace

TEST_CASE("pieces of beads follow each other and lay the same volume", "[hanging]") {
    const LayerBelow footing(discs(), 0.05);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-4, 36), width(0.3, 0.6);
    for (int round = 0; round < 200; ++round) {
        Bead bead;
        bead.closed = round % 2 == 1;
        const bool tapered = round % 4 < 2;
        for (int i = 0; i < 6; ++i) {
            bead.points.emplace_back(place(random), place(random));
            if (tapered) bead.widths.push_back(width(random));
        }
        bead.width = tapered ? *std::ranges::max_element(bead.widths) : 0.45;
        const std::vector<Bead> pieces = cut_hanging({bead}, footing);
        double volume = 0, length = 0, wrong = 0;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const Bead& piece = pieces[i];
            REQUIRE(piece.points.size() >= 2);
            volume += bead_volume(piece, height);
            length += length_of(piece);
            if (i > 0) {
                REQUIRE(glm::distance(pieces[i - 1].points.back(), piece.points.front()) < 1e-9);
                REQUIRE(pieces[i - 1].hangs != piece.hangs);
            }
            for (std::size_t k = 0; k + (piece.closed ? 0 : 1) < piece.points.size(); ++k) {
                const dvec2 a = piece.points[k], b = piece.points[(k + 1) % piece.points.size()];
                const int samples = static_cast<int>(glm::distance(a, b) / 0.02) + 1;
                for (int s = 0; s < samples; ++s) {
                    const dvec2 p = a + (b - a) * ((s + 0.5) / samples);
                    if (footing.holds(p) == piece.hangs) wrong += glm::distance(a, b) / samples;
                }
            }
        }
        CHECK(volume == Approx(bead_volume(bead, height)).epsilon(1e-6));
        CHECK(length == Approx(length_of(bead)));
        // Stretches shorter than a width are not cut, and cuts lie within an eighth of it.
        CHECK(wrong < 0.02 * length + 2 * bead.width);
        CHECK(pieces.size() > 1);
    }
}

TEST_CASE("a bead that hangs or is held as a whole stays whole", "[hanging]") {
    const LayerBelow footing({to_polygon(box_contour({0, 0}, {20, 20}).points)}, 0.05);
    const auto loop = [](dvec2 at) {
        Bead bead;
        bead.points = box_contour(at, at + dvec2(5)).points;
        bead.width = 0.45;
        bead.closed = true;
        return bead;
    };
    const std::vector<Bead> beads = cut_hanging({loop({1, 1}), loop({30, 1})}, footing);
    REQUIRE(beads.size() == 2);
    CHECK(beads[0].closed);
    CHECK_FALSE(beads[0].hangs);
    CHECK(beads[1].closed);
    CHECK(beads[1].hangs);
    // A loop that begins where it hangs: its first and last pieces are one stretch, too short alone.
    Bead seam = loop({19.7, 1});
    std::rotate(seam.points.begin(), seam.points.begin() + 1, seam.points.end());
    const std::vector<Bead> cut = cut_hanging({seam}, footing);
    CHECK(std::ranges::any_of(cut, [](const Bead& bead) { return bead.hangs; }));
    // Marked already: by the planner of bridges.
    Bead marked = loop({1, 1});
    marked.hangs = true;
    CHECK(cut_hanging({marked}, footing).front().hangs);
}

}  // namespace hanging_beads_test
