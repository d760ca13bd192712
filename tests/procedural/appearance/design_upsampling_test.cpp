// Designs of a coarse grid on a finer one: by position, and of free elements only.
#include "procedural/appearance/design_upsampling.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/error.h"

namespace design_upsampling_test {

using namespace lamella;

namespace {

std::vector<ElementUse> all_free(glm::ivec3 size) {
    return std::vector<ElementUse>(static_cast<std::size_t>(size.x * size.y), ElementUse::free);
}

std::size_t place(glm::ivec3 size, int x, int y) { return static_cast<std::size_t>(y * size.x + x); }

/// Values of a function of position, which is measured from the middle of the grid in fine elements.
template <class Function>
std::vector<double> sampled(glm::ivec3 size, double edge, const Function& function) {
    std::vector<double> values;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            values.push_back(function(edge * (x + 0.5 - 0.5 * size.x), edge * (y + 0.5 - 0.5 * size.y)));
    }
    return values;
}

const auto plane = [](double x, double y) { return 0.5 + 0.01 * x - 0.02 * y + 0.001 * x * y; };

}  // namespace

TEST_CASE("a bilinear design stays what it is between the outermost centres", "[optimization]") {
    for (const glm::ivec3 size :
         {glm::ivec3(12, 8, 1), glm::ivec3(13, 9, 1), glm::ivec3(12, 9, 1), glm::ivec3(75, 38, 1)}) {
        const glm::ivec3 half = halved_size(size);
        CHECK(half == glm::ivec3((size.x + 1) / 2, (size.y + 1) / 2, 1));
        const auto use = all_free(size), coarse_use = all_free(half);
        const auto coarse = sampled(half, 2, plane);
        const auto fine = upsampled_design({half, coarse_use, coarse}, size, use, 0.3);
        const auto wanted = sampled(size, 1, plane);
        REQUIRE(fine.size() == wanted.size());
        for (int y = 1; y + 1 < size.y; ++y) {
            for (int x = 1; x + 1 < size.x; ++x)
                CHECK(fine[place(size, x, y)] == Approx(wanted[place(size, x, y)]).margin(1e-13));
        }
    }
}

TEST_CASE("the design of a single coarse element is that of all fine ones about it", "[optimization]") {
    const std::vector<double> one{0.7};
    for (const glm::ivec3 size : {glm::ivec3(2, 2, 1), glm::ivec3(1, 2, 1), glm::ivec3(1, 1, 1)}) {
        const auto use = all_free(size), coarse_use = all_free({1, 1, 1});
        for (const double v : upsampled_design({{1, 1, 1}, coarse_use, one}, size, use, 0.3))
            CHECK(v == Approx(0.7).epsilon(1e-15));
    }
}

TEST_CASE("a mirrored design gives a mirrored one, also on odd grids", "[optimization]") {
    const glm::ivec3 size(13, 9, 1), half = halved_size(size);
    const auto use = all_free(size), coarse_use = all_free(half);
    const auto uneven = [](double x, double y) { return 0.5 + 0.4 * std::sin(x * x + 3 * x + y); };
    const auto there = sampled(half, 2, uneven),
               back = sampled(half, 2, [&](double x, double y) { return uneven(-x, y); });
    const auto a = upsampled_design({half, coarse_use, there}, size, use, 0.3),
               b = upsampled_design({half, coarse_use, back}, size, use, 0.3);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            CHECK(a[place(size, x, y)] == Approx(b[place(size, size.x - 1 - x, y)]).margin(1e-14));
    }
}

TEST_CASE("what is prescribed neither gets a design nor gives one", "[optimization]") {
    const glm::ivec3 size(12, 8, 1), half = halved_size(size);
    auto use = all_free(size), coarse_use = all_free(half);
    std::vector<double> coarse(coarse_use.size(), 0.6);
    for (int y = 0; y < half.y; ++y) {
        for (int x = 0; x < half.x; ++x) {
            if (x != 2 && y != 3) continue;
            coarse_use[place(half, x, y)] = y == 3 ? ElementUse::outside : ElementUse::solid;
            coarse[place(half, x, y)] = 0;
        }
    }
    use[place(size, 7, 1)] = ElementUse::solid;
    use[place(size, 8, 1)] = ElementUse::empty;
    use[place(size, 9, 1)] = ElementUse::outside;
    const auto fine = upsampled_design({half, coarse_use, coarse}, size, use, 0.3);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const bool is_prescribed = y == 1 && x >= 7 && x <= 9;
            const bool is_far = y == 7;  // its neighbours are outside
            CAPTURE(x, y);
            CHECK(fine[place(size, x, y)] == Approx(is_prescribed ? 0.0 : is_far ? 0.3 : 0.6).margin(1e-15));
        }
    }
}

TEST_CASE("grids that do not fit each other are refused", "[optimization]") {
    const auto use = all_free({12, 8, 1}), coarse_use = all_free({6, 4, 1});
    const std::vector<double> values(24, 0.5);
    const auto with = [&](glm::ivec3 half, std::span<const double> coarse, glm::ivec3 size) {
        return upsampled_design({half, coarse_use, coarse}, size, use, 0.3);
    };
    CHECK_NOTHROW(with({6, 4, 1}, values, {12, 8, 1}));
    CHECK_THROWS_AS(with({4, 6, 1}, values, {12, 8, 1}), InputError);
    CHECK_THROWS_AS(with({6, 4, 1}, std::span(values).first(23), {12, 8, 1}), InputError);
    CHECK_THROWS_AS(with({6, 4, 1}, values, {11, 8, 1}), InputError);
}

}  // namespace design_upsampling_test
