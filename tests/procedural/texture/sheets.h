// Sheets, examples and measures for the tests of patterns by example.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "procedural/texture/pattern_levels.h"
#include "procedural/volume/volume.h"

namespace sheets {

using namespace lamella;

/// Returns an example picture in black and white.
inline GreyImage example(const std::string& name, bool invert = false) {
    const GreyImage grey =
        solidity(read_picture(std::string(LAMELLA_SOURCE_DIR "/examples/inputs/") + name), invert);
    return black_and_white(grey, otsu_threshold(grey));
}

/// Returns the columns of an image from one up to another.
inline GreyImage columns(const GreyImage& image, int from, int to) {
    GreyImage part(to - from, image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = from; x < to; ++x)
            part.values[part.index(x - from, y)] = image.values[image.index(x, y)];
    }
    return part;
}

/// Returns the grids of a sheet of `size` x `size` sites at the finest.
inline std::vector<PatternLevel> levels_of(int size, int count, int window = 9) {
    std::vector<PatternLevel> levels;
    for (int halvings = count - 1; halvings >= 0; --halvings) {
        PatternLevel& level = levels.emplace_back();
        level.sites = flat_sites(size >> halvings, size >> halvings, 1 << halvings);
        level.windows = site_windows(level.sites, window);
    }
    return levels;
}

/// Returns a square pattern cut at a threshold of its distances.
inline GreyImage cut(const SitePattern& pattern, float threshold) {
    const int size = static_cast<int>(std::lround(std::sqrt(static_cast<double>(pattern.distance.size()))));
    GreyImage image(size, size);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = pattern.distance[i] > threshold ? 1 : 0;
    return image;
}

/// Returns the mean over patches of one image, every `stride` pixels, of the share of pixels that differ from
/// the most similar patch of the other: all of them are tried.
inline double patch_distance(const GreyImage& from, const GreyImage& to, int patch, int stride) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y + patch <= from.height; y += stride) {
        for (int x = 0; x + patch <= from.width; x += stride) {
            double least = std::numeric_limits<double>::infinity();
            for (int v = 0; v + patch <= to.height; ++v) {
                for (int u = 0; u + patch <= to.width; ++u) {
                    double difference = 0;
                    for (int j = 0; j < patch && difference < least; ++j) {
                        for (int i = 0; i < patch; ++i)
                            difference += std::abs(from.values[from.index(x + i, y + j)] -
                                                   to.values[to.index(u + i, v + j)]);
                    }
                    least = std::min(least, difference);
                }
            }
            sum += least / (patch * patch);
            ++count;
        }
    }
    return sum / count;
}

/// Returns a part of an image that tiles, from a place on, which may lie beyond the border.
inline GreyImage shifted(const GreyImage& image, int left, int low, int width, int height) {
    GreyImage part(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int u = ((left + x) % image.width + image.width) % image.width,
                      v = ((low + y) % image.height + image.height) % image.height;
            part.values[part.index(x, y)] = image.values[image.index(u, v)];
        }
    }
    return part;
}

/// Returns the least share of pixels in which two parts of an image that tiles differ, `part` pixels wide and
/// high, that do not overlap; those every `stride` pixels are compared with all.
inline double least_self_difference(const GreyImage& image, int part, int stride) {
    const auto gap = [](int a, int b, int size) {
        const int d = std::abs(a - b) % size;
        return std::min(d, size - d);
    };
    double least = part * part;
    for (int y = 0; y < image.height; y += stride) {
        for (int x = 0; x < image.width; x += stride) {
            for (int v = 0; v < image.height; ++v) {
                for (int u = 0; u < image.width; ++u) {
                    if (gap(x, u, image.width) < part && gap(y, v, image.height) < part) continue;
                    double difference = 0;
                    for (int j = 0; j < part && difference < least; ++j) {
                        for (int i = 0; i < part; ++i)
                            difference += std::abs(
                                image.values[image.index((x + i) % image.width, (y + j) % image.height)] -
                                image.values[image.index((u + i) % image.width, (v + j) % image.height)]);
                    }
                    least = std::min(least, difference);
                }
            }
        }
    }
    return least / (part * part);
}

}  // namespace sheets
