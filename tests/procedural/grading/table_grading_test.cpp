// Tables against hand-made numbers, and their text.
#include "procedural/grading/table_grading.h"

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "procedural/grading/attractors.h"
#include "tests/procedural/grading/grading_checks.h"

namespace table_grading_test {

using namespace lamella;

namespace {

GradingPtr along_z() { return make_distance_grading({{Attractor::Kind::plane, {0, 0, 0}, {0, 0, 1}}}); }

std::string message_of(const std::string& text) {
    try {
        read_table(text, "t.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string message_of(const Table& rows) {
    try {
        make_table_grading(along_z(), rows, false);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

const Box space{{-5, -5, -5}, {15, 15, 35}};

}  // namespace

TEST_CASE("a straight table is linear between its rows and constant beyond") {
    const GradingPtr table = make_table_grading(along_z(), {{0, 1}, {10, 3}, {20, -1}}, false);
    CHECK(table->at({7, 7, -4}) == 1);
    CHECK(table->at({7, 7, 0}) == 1);
    CHECK(table->at({7, 7, 5}) == 2);
    CHECK(table->at({7, 7, 10}) == 3);
    CHECK(table->at({7, 7, 12.5}) == 2);
    CHECK(table->at({7, 7, 99}) == -1);
    CHECK(make_table_grading(along_z(), {{4, 2}}, false)->at({0, 0, 0}) == 2);
    CHECK(make_table_grading(along_z(), {{4, 2}}, true)->at({0, 0, 9}) == 2);
}

TEST_CASE("a smooth table goes through its rows, never leaves their span and has no kinks") {
    const Table rows = {{0, 1}, {1, 1}, {3, 4}, {4, 9}, {10, 9.5}, {11, 2}, {30, 0}};
    const GradingPtr table = make_table_grading(along_z(), rows, true);
    for (const auto& [z, number] : rows) CHECK(table->at({0, 0, z}) == number);
    const double h = 1e-5;
    const auto slope = [&](double z) {
        return (table->at({0, 0, z + h}) - table->at({0, 0, z - h})) / (2 * h);
    };
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        double last = rows[i].second;
        const double sign = rows[i + 1].second >= last ? 1 : -1;
        for (int k = 1; k <= 1000; ++k) {
            const double z = rows[i].first + (rows[i + 1].first - rows[i].first) * k / 1000;
            const double number = table->at({0, 0, z});
            if (sign * (number - last) < -1e-14) FAIL("the piece from row " << i << " turns round at " << z);
            last = number;
        }
        if (i > 0) CHECK(std::abs(slope(rows[i].first - h) - slope(rows[i].first + h)) < 2e-3);
    }
}

TEST_CASE("a smooth table is a straight line where its rows are") {
    const GradingPtr table = make_table_grading(along_z(), {{0, 1}, {1, 3}, {4, 9}, {6, 13}}, true);
    for (double z = 0; z <= 6; z += 0.37) CHECK(table->at({0, 0, z}) == Approx(1 + 2 * z));
    CHECK(make_table_grading(along_z(), {{0, 1}, {2, 5}}, true)->at({0, 0, 0.5}) == 2);
}

TEST_CASE("the slopes of a smooth table are weighted harmonic means") {
    // Chords 1 and 4 over widths 1 and 2: 3 * 3 / ((1 + 2 * 2) / 1 + (2 * 1 + 2) / 4) = 1.5 at the middle
    // row.
    const GradingPtr table = make_table_grading(along_z(), {{0, 0}, {1, 1}, {3, 9}}, true);
    const double h = 1e-6;
    CHECK((table->at({0, 0, 1 + h}) - table->at({0, 0, 1 - h})) / (2 * h) == Approx(1.5).epsilon(1e-4));
}

TEST_CASE("ranges of tables are exact over what they run along") {
    for (const bool smooth : {false, true}) {
        const GradingPtr table = make_table_grading(along_z(), {{0, 1}, {10, 3}, {20, -1}, {21, 7}}, smooth);
        const Interval over_peak = table->range({{0, 0, 5}, {1, 1, 12}});
        CHECK(over_peak.lo == Approx(std::min(table->at({0, 0, 5}), table->at({0, 0, 12}))));
        CHECK(over_peak.hi == Approx(3));
        const Interval inside = table->range({{0, 0, 2}, {1, 1, 3}});
        CHECK(inside.lo == Approx(table->at({0, 0, 2})).epsilon(1e-12));
        CHECK(inside.hi == Approx(table->at({0, 0, 3})).epsilon(1e-12));
        const Interval beyond = table->range({{0, 0, 30}, {1, 1, 40}});
        CHECK(beyond.lo == 7);
        CHECK(beyond.hi == 7);
        checks::check_ranges(*table, space);
    }
}

TEST_CASE("a table stays undefined where what it runs along is") {
    const GradingPtr table = make_table_grading(make_constant_grading(std::nan("")), {{0, 1}, {1, 2}}, true);
    CHECK(std::isnan(table->at({0, 0, 0})));
    CHECK(table->range(space).hi == infinity);
}

TEST_CASE("rows so steep that slopes overflow stay within their numbers") {
    const GradingPtr table =
        make_table_grading(along_z(), {{0, -1e100}, {5e-324, 1e100}, {1, -1e100}, {2, 0}}, true);
    for (const double z : {0.0, 5e-324, 0.5, 1.5}) CHECK(std::abs(table->at({0, 0, z})) <= 1e100);
}

TEST_CASE("tables that are none are refused by row") {
    CHECK(message_of(Table{}) == "a table needs at least one row (position, number)");
    CHECK(message_of(Table{{0, 1}, {0, 2}}) == "row 2 of a table: positions must increase from row to row");
    CHECK(message_of(Table{{0, infinity}}).find("row 1 of a table: both numbers must be finite") == 0);
}

TEST_CASE("tables are read with every common separator") {
    const Table rows = {{0, 1.5}, {2.5, -3}, {1000, 0.25}};
    CHECK(read_table("0,1.5\n2.5,-3\n1e3,0.25\n", "t") == rows);
    CHECK(read_table("0 1.5\r\n2.5\t-3\r\n1000   .25", "t") == rows);
    CHECK(read_table("# depths\nz; size\n\n0; 1.5  # first\n2.5 ;-3\n+1000;0.25", "t") == rows);
    CHECK(read_table("\xef\xbb\xbfposition,number\r0,1.5\r2.5,-3\r1000,0.25\r", "t") == rows);
    const auto path = std::filesystem::temp_directory_path() / "lamella_table_test.csv";
    std::ofstream(path) << "0,1.5\n2.5,-3\n1000,0.25\n";
    CHECK(read_table(path.string()) == rows);
    std::filesystem::remove(path);
    CHECK_THROWS_AS(read_table(path.string()), InputError);
}

TEST_CASE("text that is no table is refused with its line") {
    CHECK(message_of("") == "t.csv: the table holds no rows (two numbers a line)");
    CHECK(message_of("0,1\n1,x\n") == "t.csv:2: \"x\" is not a number (such as 12.5, with a point)");
    CHECK(message_of("0,1\r\n\r\n1\r\n") ==
          "t.csv:3: a row needs two numbers, position and number; here is 1");
    CHECK(message_of("0;1\n1,5;2,5\n") ==
          "t.csv:2: a row needs two numbers, position and number; here are 4");
    CHECK(message_of("0,1\n1,\n") == "t.csv:2: \"\" is not a number (such as 12.5, with a point)");
    CHECK(message_of("z,r\na,b\n0,1\n").find("t.csv:2: \"a\" is not a number") == 0);
    CHECK(message_of("0,1\n0,2\n").find("t.csv:2: positions must increase") == 0);
    CHECK(message_of("0,nan\n").find("t.csv:1: both numbers must be finite") == 0);
}

}  // namespace table_grading_test
