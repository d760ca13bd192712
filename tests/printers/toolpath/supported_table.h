// A table top on a scaffold, for what back-ends make of supports.
#pragma once

#include <memory>
#include <vector>

#include "tests/printers/common/plane_solids.h"

namespace lamella::test {

constexpr Box table_top{{-8, -3, 3}, {8, 3, 4}};
constexpr double table_area = 16 * 6;

/// The scaffold's section at height z: feet, two crosses, a bar between them, tips on the bar. No two figures
/// of a height overlap, apart from a cross's two walls.
inline std::vector<Figure> scaffold_figures(double z) {
    std::vector<Figure> figures;
    for (const double x : {-6.0, 6.0}) {
        if (z < 0.4) {
            figures.push_back(disc({x, 0}, 2));
        } else if (z < 2) {
            figures.push_back(rectangle({x - 1.25, -0.225}, {x + 1.25, 0.225}));
            figures.push_back(rectangle({x - 0.225, -1.25}, {x + 0.225, 1.25}));
        }
    }
    if (2 <= z && z < 2.6) figures.push_back(rectangle({-6, -0.45}, {6, 0.45}));
    if (2.6 <= z && z < 3) {
        for (const double x : {-6.0, -3.0, 0.0, 3.0, 6.0}) figures.push_back(disc({x, 0}, 0.3));
    }
    return figures;
}

inline double scaffold_area(double z) {
    if (z < 0.4) return 2 * pi * 4;
    if (z < 2) return 2 * (2 * 2.5 * 0.45 - 0.45 * 0.45);
    if (z < 2.6) return 12 * 0.9;
    return z < 3 ? 5 * pi * 0.09 : 0;
}

/// 20 layers of 0.2 mm: 15 of the scaffold, then 5 of the part.
inline Job supported_table() {
    Job job = make_job(
        table_top,
        [](double z) {
            return table_top.lo.z <= z ? std::vector<Figure>{rectangle({-8, -3}, {8, 3})}
                                       : std::vector<Figure>();
        },
        0.2);
    const Box below{{-8, -2, 0}, {8, 2, 3}};
    job.supports = std::make_shared<FigureSolid>(below, scaffold_figures);
    job.bounds = Box{{-8, -3, 0}, {8, 3, 4}};
    job.layers = {20, 0.2};
    return job;
}

inline double scaffold_volume() {
    const Job job = supported_table();
    double sum = 0;
    for (int i = 0; i < job.layers.count(); ++i) sum += scaffold_area(job.plane(i)) * job.layers.height(i);
    return sum;
}

/// A block with a support that stands beside it, touches it, and ends with it.
inline Job block_beside_support() {
    Job job = make_job(
        {{-4, -3, 0}, {4, 3, 1}},
        [](double) {
            return std::vector<Figure>{rectangle({-4, -3}, {0.03, 3})};
        },
        0.25);
    job.supports = std::make_shared<FigureSolid>(Box{{0.03, -3, 0}, {4, 3, 1}}, [](double) {
        return std::vector<Figure>{rectangle({0.03, -1}, {3.03, 1})};
    });
    return job;
}

}  // namespace lamella::test
