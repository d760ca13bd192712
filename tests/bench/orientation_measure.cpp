// Supports of the orientation that `lamella orient` chooses, against those of random ones: a line for each,
// with lay_on, the estimate, the planned material and the time.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <random>
#include <string>

#include "recipe/machine_profiles.h"
#include "recipe/placement/laid_part.h"
#include "recipe/placement/orient_part.h"
#include "recipe/placement/part_placement.h"
#include "recipe/read_recipe.h"

namespace {

using namespace lamella;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

dvec3 random_direction(std::mt19937_64& bits) {
    for (;;) {
        const auto number = [&] { return static_cast<double>(bits() >> 11U) * 0x1p-52 - 1; };
        const dvec3 v(number(), number(), number());
        const double square = dot(v, v);
        if (square > 0.01 && square <= 1) return v / std::sqrt(square);
    }
}

void print(const char* name, const Orientation& orientation, double seconds) {
    const dvec3 d = orientation.lay_on;
    std::cout << fmt::format("{} {:.6f},{:.6f},{:.6f} estimated {:.1f} planned {:.3f} mm3 {:.2f} s\n", name,
                             d.x, d.y, d.z, orientation.figures.support_volume,
                             orientation.planned.value_or(-1), seconds)
              << std::flush;
}

void measure(const Recipe& recipe, int count) {
    auto start = std::chrono::steady_clock::now();
    const OrientReport report = orient_part(recipe, {});
    const double choice = seconds_since(start);
    for (const Orientation& orientation : report.best) print("chosen", orientation, choice);
    const LaidPart part(with_known_placement(recipe));
    std::mt19937_64 bits(1);
    for (int i = 0; i < count; ++i) {
        Orientation random{{}, random_direction(bits)};
        start = std::chrono::steady_clock::now();
        random.planned = part.support_volume(random.lay_on, 0, nullptr);
        print("random", random, seconds_since(start));
    }
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::cerr << "usage: lamella_orientation_measure RECIPE [RANDOM]\n";
        return 2;
    }
    const int count = argc > 2 ? std::stoi(argv[2]) : 200;
    measure(read_recipe(argv[1], MachineProfiles()), count);
    return 0;
} catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 2;
}
