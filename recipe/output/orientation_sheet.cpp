// Tiles rendered one after the other, with digits of five by seven dots in their corners.
#include "recipe/output/orientation_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "printers/registry.h"
#include "recipe/output/preview_render.h"
#include "recipe/placement/laid_part.h"
#include "recipe/placement/part_placement.h"

namespace lamella {

namespace {

constexpr int tile = 320;  // px
constexpr int per_row = 5;
constexpr std::size_t most = 10;
constexpr dvec3 held_colour{0.42, 0.52, 0.60};
constexpr dvec3 hanging_colour{0.80, 0.05, 0.04};

/// Rows of five dots from the top, the leftmost dot the highest bit.
constexpr std::array<std::array<unsigned, 7>, 10> digits{{{14, 17, 19, 21, 25, 17, 14},
                                                          {4, 12, 4, 4, 4, 4, 14},
                                                          {14, 17, 1, 2, 4, 8, 31},
                                                          {31, 2, 4, 2, 1, 17, 14},
                                                          {2, 6, 10, 18, 31, 2, 2},
                                                          {31, 16, 30, 1, 1, 17, 14},
                                                          {6, 8, 16, 30, 17, 17, 14},
                                                          {31, 1, 2, 4, 8, 8, 8},
                                                          {14, 17, 17, 14, 17, 17, 14},
                                                          {14, 17, 17, 15, 1, 2, 12}}};

void blacken(Picture& picture, int x, int y) {
    const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                     static_cast<std::size_t>(x)) *
                    3;
    constexpr std::uint8_t ink = 40;
    for (std::size_t k = 0; k < 3; ++k) picture.rgb[at + k] = ink;
}

/// Writes a number with its upper left corner at a pixel.
void write_number(Picture& picture, int x, int y, std::size_t number) {
    constexpr int dot = 3;  // px
    for (const char digit : std::to_string(number)) {
        for (int row = 0; row < 7 * dot; ++row) {
            const unsigned bits =
                digits[static_cast<std::size_t>(digit - '0')][static_cast<std::size_t>(row / dot)];
            for (int column = 0; column < 5 * dot; ++column) {
                if ((bits >> (4 - column / dot) & 1U) != 0) blacken(picture, x + column, y + row);
            }
        }
        x += 6 * dot;
    }
}

/// Paints what hangs too far over the layer below, except on the bed.
std::function<dvec3(dvec3)> overhang_paint(const FieldPtr& body, const Recipe& recipe) {
    const double height = recipe.layers.height;
    const double overhang = printable_overhang(recipe.printer, height) / height;
    const double limit = -overhang / std::sqrt(1 + overhang * overhang);
    const Box box = body->bounds();
    const double step = 1e-3 * length(box.size());
    const double bed = box.lo.z + std::max(height, step);
    return [body, limit, step, bed](dvec3 p) {
        if (p.z < bed) return held_colour;
        dvec3 slope(0);
        for (int axis = 0; axis < 3; ++axis) {
            dvec3 way(0);
            way[axis] = step;
            slope[axis] = body->value(p + way) - body->value(p - way);
        }
        return slope.z < limit * length(slope) ? hanging_colour : held_colour;
    };
}

Picture draw(const Recipe& recipe, const FieldPtr& body, int threads) {
    PreviewOptions options;
    options.width = options.height = tile;
    options.azimuth = 25;
    options.elevation = -12;
    options.cut = '-';
    options.threads = threads;
    options.paint = overhang_paint(body, recipe);
    return render_preview(body, nullptr, body->bounds(), options);
}

void copy_to(const Picture& from, int x, int y, Picture& to) {
    const auto line = static_cast<std::size_t>(from.width) * 3;
    for (int row = 0; row < from.height; ++row) {
        const auto source = from.rgb.begin() + static_cast<std::ptrdiff_t>(line) * row;
        const auto target = to.rgb.begin() + (std::ptrdiff_t{to.width} * (y + row) + x) * 3;
        std::copy(source, source + static_cast<std::ptrdiff_t>(line), target);
    }
}

}  // namespace

Picture orientation_sheet(const Recipe& given, const std::vector<Orientation>& orientations, int threads) {
    if (orientations.empty()) throw InputError("there is no orientation to draw");
    const Recipe recipe = with_known_placement(given);
    const LaidPart part(recipe);
    const int count = static_cast<int>(std::min(orientations.size(), most));
    const int columns = std::min(count, per_row), rows = (count + per_row - 1) / per_row;
    Picture sheet{columns * tile, rows * tile, {}};
    sheet.rgb.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3, 255);
    for (int i = 0; i < count; ++i) {
        const auto number = static_cast<std::size_t>(i);
        const int x = i % per_row * tile, y = i / per_row * tile;
        copy_to(draw(recipe, part.body(orientations[number].lay_on), threads), x, y, sheet);
        constexpr int margin = 12;
        write_number(sheet, x + margin, y + margin, number + 1);
    }
    return sheet;
}

}  // namespace lamella
