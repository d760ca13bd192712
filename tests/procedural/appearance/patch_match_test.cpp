// PatchMatch against an exhaustive search, and what the uniformity term does to the use of the exemplar.
#include "procedural/appearance/patch_match.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "tests/procedural/appearance/synthetic_images.h"

namespace patch_match_test {

using namespace lamella;
using namespace synthetic_images;

namespace {

MatchSettings settings_of(int neighbourhood, double spread) {
    MatchSettings settings;
    settings.neighbourhood = neighbourhood;
    settings.spread = spread;
    return settings;
}

int byte(double value) { return static_cast<int>(std::lround(255 * value)); }

/// The cost of a match without the uniformity term, in units of |d|^q of values in [0, 1].
double difference_at(const PatchMatch& field, const GreyImage& target, int x, int y, ExemplarPlace m) {
    double sum = 0;
    for (int v = 0; v < field.neighbourhood(); ++v) {
        for (int u = 0; u < field.neighbourhood(); ++u) {
            const int t = byte(target.values[target.index(x + u, y + v)]);
            const int s =
                field.exemplar()[static_cast<std::size_t>((m.y + v) * field.exemplar_width() + m.x + u)];
            sum += field.difference().of(static_cast<unsigned>(std::abs(t - s)));
        }
    }
    return sum / field.difference().unit();
}

template <class Visit>
void for_each_window(const PatchMatch& field, const Visit& visit) {
    for (int y = 0; y < field.windows_high(); ++y) {
        for (int x = 0; x < field.windows_across(); ++x)
            visit(x, y, field.matches()[static_cast<std::size_t>(y * field.windows_across() + x)]);
    }
}

double total_difference(const PatchMatch& field, const GreyImage& target) {
    double sum = 0;
    for_each_window(field,
                    [&](int x, int y, ExemplarPlace m) { sum += difference_at(field, target, x, y, m); });
    return sum;
}

double least_total_difference(const PatchMatch& field, const GreyImage& target) {
    double sum = 0;
    for_each_window(field, [&](int x, int y, ExemplarPlace) {
        double least = std::numeric_limits<double>::infinity();
        for (int v = 0; v + field.neighbourhood() <= field.exemplar_height(); ++v) {
            for (int u = 0; u + field.neighbourhood() <= field.exemplar_width(); ++u) {
                const ExemplarPlace m{static_cast<std::int16_t>(u), static_cast<std::int16_t>(v)};
                least = std::min(least, difference_at(field, target, x, y, m));
            }
        }
        sum += least;
    });
    return sum;
}

/// Standard deviation of the occurrence over its mean.
double unevenness(const PatchMatch& field) {
    double sum = 0, squares = 0;
    const auto occurrence = field.occurrence();
    for (const std::int64_t o : occurrence) {
        sum += static_cast<double>(o);
        squares += static_cast<double>(o) * static_cast<double>(o);
    }
    const double n = static_cast<double>(occurrence.size());
    return std::sqrt(squares / n - sum / n * (sum / n)) / (sum / n);
}

std::string refusal(const std::function<void()>& make) {
    try {
        make();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a target cut out of the exemplar finds where it was cut", "[optimization]") {
    const GreyImage exemplar = waves(60, 50, 1), target = cut_out(exemplar, 13, 9, 36, 30);
    PatchMatch field(exemplar, target.width, target.height, settings_of(8, 0));
    field.sweep(target.values, 30);
    for_each_window(field, [&](int x, int y, ExemplarPlace m) {
        CHECK(m.x == x + 13);
        CHECK(m.y == y + 9);
    });
}

TEST_CASE("thirty sweeps come within three per cent of the exhaustive search", "[optimization]") {
    const GreyImage exemplar = waves(48, 40, 2), target = waves(44, 52, 3);
    PatchMatch field(exemplar, target.width, target.height, settings_of(8, 0));
    const double least = least_total_difference(field, target);
    const double at_random = total_difference(field, target);
    field.sweep(target.values, 1);
    const double once = total_difference(field, target);
    field.sweep(target.values, 29);
    const double found = total_difference(field, target);
    CAPTURE(least, at_random, once, found);
    CHECK(at_random > 2 * least);
    CHECK(once < 0.8 * at_random);
    CHECK(found < 1.03 * least);
    CHECK(found >= least * (1 - 1e-12));
}

TEST_CASE("without the uniformity term no sweep makes a match worse", "[optimization]") {
    const GreyImage exemplar = waves(40, 40, 4), target = noise(30, 30, 5);
    PatchMatch field(exemplar, target.width, target.height, settings_of(7, 0));
    for (int k = 0; k < 8; ++k) {
        const std::vector<ExemplarPlace> before(field.matches().begin(), field.matches().end());
        field.sweep(target.values, 1);
        bool worse = false;
        for_each_window(field, [&](int x, int y, ExemplarPlace m) {
            const ExemplarPlace old = before[static_cast<std::size_t>(y * field.windows_across() + x)];
            worse |= difference_at(field, target, x, y, m) > difference_at(field, target, x, y, old);
        });
        CHECK_FALSE(worse);
    }
}

TEST_CASE("of equally good matches that at the lower pixel wins", "[optimization]") {
    const GreyImage exemplar(30, 25, 0.5);
    PatchMatch field(exemplar, 30, 30, settings_of(6, 0));
    const std::vector<double> target(900, 0.25);
    const auto index = [&](ExemplarPlace m) { return m.y * 30 + m.x; };
    for (int k = 0; k < 6; ++k) {
        const std::vector<ExemplarPlace> before(field.matches().begin(), field.matches().end());
        field.sweep(target, 1);
        int lower = 0, higher = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            lower += index(field.matches()[i]) < index(before[i]);
            higher += index(field.matches()[i]) > index(before[i]);
        }
        CHECK(higher == 0);
        if (k == 0) CHECK(lower > 300);  // of 625
    }
}

TEST_CASE("the occurrence map counts the matches that cover each pixel", "[optimization]") {
    const GreyImage exemplar = waves(26, 22, 6), target = noise(31, 28, 7);
    PatchMatch field(exemplar, target.width, target.height, settings_of(6, 3));
    field.sweep(target.values, 3);
    std::vector<std::int64_t> counted(26 * 22, 0);
    for_each_window(field, [&](int, int, ExemplarPlace m) {
        for (int k = 0; k < 36; ++k) ++counted[exemplar.index(m.x + k % 6, m.y + k / 6)];
    });
    CHECK(field.occurrence() == counted);
}

TEST_CASE("a sweep makes no match worse, with the uniformity term of the matches before", "[optimization]") {
    const GreyImage exemplar = waves(30, 26, 6), target = waves(40, 44, 7);
    constexpr int n = 6;
    constexpr double spread = 12;
    PatchMatch field(exemplar, target.width, target.height, settings_of(n, spread));
    const std::vector<ExemplarPlace> before(field.matches().begin(), field.matches().end());
    // omega / omega_best, from the definition.
    std::vector<double> occurrence(exemplar.values.size(), 0);
    for (const ExemplarPlace m : before) {
        for (int k = 0; k < n * n; ++k) occurrence[exemplar.index(m.x + k % n, m.y + k / n)] += 1;
    }
    const double best =
        static_cast<double>(before.size()) * n * n / static_cast<double>(exemplar.values.size());
    const auto term = [&](ExemplarPlace m) {
        double sum = 0;
        for (int k = 0; k < n * n; ++k) sum += occurrence[exemplar.index(m.x + k % n, m.y + k / n)];
        return spread * sum / (n * n) / best;
    };
    field.sweep(target.values, 1);
    int worse = 0, more_alike = 0, less_alike = 0;
    for_each_window(field, [&](int x, int y, ExemplarPlace m) {
        const ExemplarPlace old = before[static_cast<std::size_t>(y * field.windows_across() + x)];
        const double difference = difference_at(field, target, x, y, m);
        const double old_difference = difference_at(field, target, x, y, old);
        worse += difference + term(m) > (old_difference + term(old)) * (1 + 1e-9);
        more_alike += difference < old_difference;
        less_alike += difference > old_difference;
    });
    CHECK(worse == 0);
    // Both parts of the cost matter here.
    CHECK(more_alike > 200);
    CHECK(less_alike > 20);
}

TEST_CASE("spread makes the use of the exemplar more even", "[optimization]") {
    const GreyImage exemplar = waves(64, 64, 8), target = waves(90, 90, 9);
    std::vector<double> uneven, different;
    for (const double spread : {0.0, 6.4, 64.0}) {
        PatchMatch field(exemplar, target.width, target.height, settings_of(8, spread));
        field.sweep(target.values, 60);
        uneven.push_back(unevenness(field));
        different.push_back(total_difference(field, target));
    }
    CAPTURE(uneven, different);
    CHECK(uneven[1] < 0.7 * uneven[0]);
    CHECK(uneven[2] < 0.7 * uneven[1]);
    // It is paid for in likeness.
    CHECK(different[1] > different[0]);
    CHECK(different[2] > different[1]);
}

TEST_CASE("the spread is a tenth of a window's pixels unless given", "[optimization]") {
    const GreyImage exemplar = waves(20, 20, 8);
    CHECK(PatchMatch(exemplar, 20, 20, MatchSettings{}).spread() == Approx(19.6));
    CHECK(PatchMatch(exemplar, 20, 20, settings_of(14, 3)).spread() == 3);
}

TEST_CASE("the matches settle though all windows move at once", "[optimization]") {
    const GreyImage exemplar = waves(64, 64, 8), target = waves(90, 90, 9);
    for (const double spread : {6.4, 64.0}) {
        PatchMatch field(exemplar, target.width, target.height, settings_of(8, spread));
        field.sweep(target.values, 60);
        double before = total_difference(field, target);
        for (int k = 0; k < 6; ++k) {
            field.sweep(target.values, 1);
            const double now = total_difference(field, target);
            CAPTURE(spread, k);
            CHECK(std::abs(now - before) < 0.005 * before);
            before = now;
        }
    }
}

TEST_CASE("matches are the same for any number of threads and another for another seed", "[optimization]") {
    const GreyImage exemplar = waves(40, 40, 10), target = waves(60, 50, 11);
    const auto matched = [&](int threads, std::uint64_t seed, int level) {
        MatchSettings settings = settings_of(8, 6.4);
        settings.seed = seed;
        return ThreadArena(threads).execute([&] {
            PatchMatch field(exemplar, target.width, target.height, settings, level);
            field.sweep(target.values, 3);
            field.sweep(target.values, 2);
            return std::vector<ExemplarPlace>(field.matches().begin(), field.matches().end());
        });
    };
    const auto one = matched(1, 1, 0);
    CHECK(matched(2, 1, 0) == one);
    CHECK(matched(4, 1, 0) == one);
    CHECK_FALSE(matched(1, 2, 0) == one);
    CHECK_FALSE(matched(1, 1, 1) == one);
}

TEST_CASE("windows of passive pixels only have no match and use nothing", "[optimization]") {
    const GreyImage exemplar = waves(30, 30, 12), target = noise(32, 24, 13);
    std::vector<std::uint8_t> passive(32 * 24, 0);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 32; ++x) passive[target.index(x, y)] = x < 12 || y == 20 ? 1 : 0;
    }
    PatchMatch field(exemplar, 32, 24, settings_of(6, 3), 0, passive);
    field.sweep(target.values, 3);
    std::size_t active = 0;
    for_each_window(field, [&](int x, int, ExemplarPlace m) {
        CHECK((m.x < 0) == (x + 6 <= 12));
        if (m.x >= 0) ++active;
    });
    CHECK(field.active_windows() == active);
    std::int64_t uses = 0;
    for (const std::int64_t o : field.occurrence()) uses += o;
    CHECK(uses == static_cast<std::int64_t>(active) * 36);
}

TEST_CASE("a search for matches goes on from a state, and only from one that fits", "[optimization]") {
    const GreyImage exemplar = waves(30, 26, 12), target = noise(32, 24, 13);
    std::vector<std::uint8_t> passive(32 * 24, 0);
    for (std::size_t i = 0; i < 32 * 6; ++i) passive[i] = 1;
    const auto made = [&](double spread) {
        return PatchMatch(exemplar, 32, 24, settings_of(6, spread), 0, passive);
    };
    for (const double spread : {0.0, 3.0}) {
        PatchMatch whole = made(spread), begun = made(spread), rest = made(spread);
        const MatchState random = begun.state();
        whole.sweep(target.values, 5);
        begun.sweep(target.values, 2);
        rest.set_state(begun.state());
        rest.sweep(target.values, 3);
        CHECK(std::ranges::equal(rest.matches(), whole.matches()));
        CHECK(rest.sweeps() == 5);
        for (const MatchState& anew : {random, MatchState{}}) {
            rest.set_state(anew);
            rest.sweep(target.values, 5);
            CHECK(std::ranges::equal(rest.matches(), whole.matches()));
        }
    }
    PatchMatch field = made(3);
    field.sweep(target.values, 1);
    const MatchState right = field.state();
    const auto refused = [&](const auto& change) {
        MatchState state = right;
        change(state);
        CHECK_THROWS_AS(field.set_state(state), InputError);
    };
    refused([](MatchState& s) { s.matches.pop_back(); });
    refused([](MatchState& s) { s.use.pop_back(); });
    refused([](MatchState& s) { s.sweeps = 0; });
    refused([](MatchState& s) { s.matches.back().x = 25; });
    refused([](MatchState& s) { s.matches.back().y = 21; });
    refused([](MatchState& s) { s.matches.back() = {}; });
    refused([](MatchState& s) { s.matches.front() = {0, 0}; });  // of passive pixels
    field.set_state(right);
    CHECK(std::ranges::equal(field.matches(), right.matches));
}

TEST_CASE("exemplars and targets smaller than a window are refused with both sizes", "[optimization]") {
    const GreyImage exemplar = waves(40, 13, 14);
    const std::string small = refusal([&] { PatchMatch(exemplar, 40, 40, MatchSettings{}); });
    CHECK_THAT(small, Catch::Contains("exemplar") && Catch::Contains("40 x 13") && Catch::Contains("14"));
    const std::string target = refusal([] { PatchMatch(waves(20, 20, 1), 50, 10, MatchSettings{}); });
    CHECK_THAT(target, Catch::Contains("target") && Catch::Contains("50 x 10") && Catch::Contains("14"));
}

TEST_CASE("what cannot be matched is refused", "[optimization]") {
    const GreyImage exemplar = waves(20, 20, 15);
    const auto why = [&](const MatchSettings& settings, std::size_t mask, std::uint8_t value) {
        const std::vector<std::uint8_t> passive(mask, value);
        return refusal([&] { PatchMatch(exemplar, 20, 20, settings, 0, passive); });
    };
    CHECK(why(settings_of(8, 1), 400, 0).empty());
    CHECK_THAT(why(settings_of(8, -1), 0, 0), Catch::Contains("spread"));
    CHECK_THAT(why(settings_of(0, 1), 0, 0), Catch::Contains("neighbourhood"));
    CHECK_THAT(why(settings_of(8, 1), 399, 0), Catch::Contains("399"));
    CHECK_THAT(why(settings_of(8, 1), 400, 1), Catch::Contains("passive"));
    CHECK_THAT(refusal([] { PatchMatch(GreyImage(1025, 20), 20, 20, MatchSettings{}); }),
               Catch::Contains("1024"));
    PatchMatch field(exemplar, 20, 20, settings_of(8, 1));
    CHECK_THROWS_AS(field.sweep(std::vector<double>(399, 0.5), 1), FaultError);
}

}  // namespace patch_match_test
