// The cache: bounded, evicting what is far in z first, and transparent to threads.
#include "procedural/voronoi/cell_cache.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

namespace cell_cache_test {

using namespace lamella;

namespace {

struct Sheet {
    std::int64_t content;
    double z;
    std::size_t bytes() const { return 1000; }
    Interval z_extent() const { return {z, z + 1}; }
};

}  // namespace

TEST_CASE("a value is made once and then found", "[cell_cache]") {
    CellCache<Sheet> cache(1 << 20);
    int made = 0;
    for (int i = 0; i < 3; ++i) {
        CHECK(cache.find_or_make({1, 2, 3, 4, 5}, 0, [&] { return Sheet{++made, 0}; })->content == 1);
    }
    CHECK(made == 1);
    CHECK(cache.find({1, 2, 3, 4, 6}, 0) == nullptr);
    CHECK(cache.find({2, 1, 3, 4, 5}, 0) == nullptr);
    CHECK(cache.bytes() >= 1000);
    CHECK(cache.bytes() < 1300);
}

TEST_CASE("the cache keeps to its bound and drops what is farthest in z", "[cell_cache]") {
    constexpr std::size_t capacity = 16 * 10000;
    CellCache<Sheet> cache(capacity);
    for (int z = 0; z < 1000; ++z) {
        const auto held = cache.find_or_make({7, 7, z, 0, 0}, z, [&] {
            return Sheet{z, static_cast<double>(z)};
        });
        CHECK(held->content == z);
        CHECK(cache.bytes() <= capacity);
    }
    int low = 0, high = 0;
    for (int z = 0; z < 500; ++z) low += cache.find({7, 7, z, 0, 0}, 999) != nullptr;
    for (int z = 980; z < 1000; ++z) high += cache.find({7, 7, z, 0, 0}, 999) != nullptr;
    CHECK(low == 0);
    CHECK(high == 20);
}

TEST_CASE("of equally far values, the longest unused go first", "[cell_cache]") {
    CellCache<Sheet> cache(16 * 10000);
    const auto make = [](std::int64_t x) { return [x] { return Sheet{x, 0}; }; };
    for (int x = 0; x < 1000; ++x) {
        cache.find_or_make({0, 0, 0, 0, 0}, 0.5, make(0));
        cache.find_or_make({x, 0, 0, 0, 0}, 0.5, make(x));
    }
    CHECK(cache.find({0, 0, 0, 0, 0}, 0.5) != nullptr);
    CHECK(cache.find({1, 0, 0, 0, 0}, 0.5) == nullptr);
}

TEST_CASE("what lies behind is not kept for long, however large the cache may grow", "[cell_cache]") {
    constexpr std::size_t idle = 16 * 4000;
    CellCache<Sheet> wide(std::size_t{1} << 30, idle), narrow(std::size_t{1} << 30, idle);
    const auto stay = [](CellCache<Sheet>& cache, double z, int sheets) {
        for (int x = 0; x < sheets; ++x) {
            cache.find_or_make({x, 0, static_cast<std::int64_t>(z), 0, 0}, z, [&] { return Sheet{x, z}; });
        }
        return cache.bytes();
    };
    CHECK(stay(wide, 0, 2000) > 2000 * 1000);
    // Sheets of some four heights are near: twice that, on top of what may lie idle.
    for (int z = 0; z < 1000; ++z) CHECK(stay(narrow, z, 8) < idle + 2 * 4 * 8 * 1300);
}

TEST_CASE("what is wanted again and again at any height comes to stay", "[cell_cache]") {
    constexpr std::size_t idle = 16 * 40000;
    constexpr int sheets = 2000, apart = 1009;
    CellCache<Sheet> cache(std::size_t{1} << 30, idle);
    const auto made_in_a_round = [&] {
        int made = 0;
        for (int i = 0; i < sheets; ++i) {
            const std::int64_t z = i * apart % sheets;
            cache.find_or_make({0, 0, z, 0, 0}, static_cast<double>(z), [&] {
                ++made;
                return Sheet{z, static_cast<double>(z)};
            });
        }
        return made;
    };
    CHECK(made_in_a_round() == sheets);
    int last = sheets;
    for (int round = 0; round < 12; ++round) last = made_in_a_round();
    CHECK(last == 0);
}

TEST_CASE("places of late are told of once, and outlive the growth of their table", "[cell_cache]") {
    const auto place = [](int i) { return PlaceKey{i, -i, 3, 0, i % 8}; };
    RecentPlaces places;
    CHECK_FALSE(places.take(place(1)));
    places.make_room(100000);
    for (int i = 0; i < 20; ++i) places.add(place(i));
    places.make_room(200000);
    for (int i = 0; i < 20; ++i) CHECK(places.take(place(i)));
    for (int i = 0; i < 20; ++i) CHECK_FALSE(places.take(place(i)));
    // In a full table newer places take the slots of older ones.
    RecentPlaces few;
    few.make_room(64);
    for (int i = 0; i < 1000; ++i) few.add(place(i));
    int held = 0;
    for (int i = 0; i < 1000; ++i) held += few.take(place(i)) ? 1 : 0;
    CHECK(held <= 64);
    CHECK(held >= 48);
}

TEST_CASE("threads that want the same values get the same values", "[cell_cache]") {
    CellCache<Sheet> cache(16 * 8000);
    std::atomic<int> wrong{0};
    const auto work = [&](int stride) {
        for (int i = 0; i < 20000; ++i) {
            const std::int64_t x = (i * stride) % 257;
            const auto held = cache.find_or_make({x, 0, 0, 0, 0}, static_cast<double>(x), [&] {
                return Sheet{x, static_cast<double>(x)};
            });
            if (held->content != x) ++wrong;
        }
    };
    std::thread a(work, 1), b(work, 3);
    a.join();
    b.join();
    CHECK(wrong == 0);
    CHECK(cache.bytes() <= 16 * 8000);
}

}  // namespace cell_cache_test
