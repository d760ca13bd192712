// Thresholds the picture, widens thin struts, drops loose components, and computes the signed distance.
#include "procedural/skin/strut_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "procedural/skin/raster.h"

namespace lamella {
namespace {

constexpr double pixels_in_a_strut = 8;
constexpr std::int64_t max_pixels = std::int64_t{1} << 24;
constexpr double largest_picture = 8192;  // px per side

void check(const Volume& picture, const StrutImageSettings& s) {
    if (!(s.size > 0 && s.strut > 0 && std::isfinite(s.size) && std::isfinite(s.strut))) {
        throw InputError(
            fmt::format("a picture {} mm wide with struts of {} mm; both must be positive", s.size, s.strut));
    }
    if (!(0 <= s.threshold && s.threshold <= 1))
        throw InputError(fmt::format("the threshold is {}; it must be from 0 to 1", s.threshold));
    if (picture.size[2] != 1) {
        throw InputError(fmt::format("{} pictures were given; a pattern needs one", picture.size[2]));
    }
    if (static_cast<double>(std::max(picture.size[0], picture.size[1])) > largest_picture) {
        throw InputError(fmt::format("the picture is {} x {} pixels; accepted: at most {:.0f} along a side",
                                     picture.size[0], picture.size[1], largest_picture));
    }
}

/// Returns the grey levels of the pixels, 0 to 1; lowest row first.
std::vector<double> grey_of(const Volume& picture) {
    return std::visit(
        [&](const auto& samples) {
            std::vector<double> grey;
            grey.reserve(samples.size());
            for (const auto sample : samples)
                grey.push_back(static_cast<double>(sample) / picture.full_scale);
            return grey;
        },
        picture.samples);
}

/// Returns the refinement factor of pixels along each axis. It is odd, so that a coarse and a fine pixel
/// centre coincide.
int division(int width, int height, const StrutImageSettings& settings) {
    int times = 1;
    const double wanted = settings.size / width * pixels_in_a_strut / settings.strut;
    const auto room = [&](int n) { return std::int64_t{n} * width * n * height <= max_pixels; };
    while (times < wanted && room(times + 2)) times += 2;
    return times;
}

/// Returns the thresholded bilinear interpolation of the tiled picture, on a raster `times` as fine.
TiledMask thresholded(const std::vector<double>& grey, int width, int height, int times,
                      const StrutImageSettings& settings) {
    TiledMask solid(width * times, height * times);
    const TiledMask coarse(width, height);
    const int half = times / 2;
    for (int y = 0; y < solid.height; ++y) {
        for (int x = 0; x < solid.width; ++x) {
            const int u = x - half, v = y - half;  // from the centre of the first pixel
            const int i = u < 0 ? -1 : u / times, j = v < 0 ? -1 : v / times;
            const double s = static_cast<double>(u - i * times) / times;
            const double t = static_cast<double>(v - j * times) / times;
            const double low = grey[coarse.index(i, j)] * (1 - s) + grey[coarse.index(i + 1, j)] * s;
            const double high = grey[coarse.index(i, j + 1)] * (1 - s) + grey[coarse.index(i + 1, j + 1)] * s;
            const double here = low * (1 - t) + high * t;
            solid.marked[solid.index(x, y)] = (here < settings.threshold) != settings.invert ? 1 : 0;
        }
    }
    return solid;
}

/// Returns the mask of the pixels for which keep(index) holds.
template <typename Keep>
TiledMask where(const TiledMask& like, const Keep& keep) {
    TiledMask mask(like.width, like.height);
    for (std::size_t i = 0; i < mask.marked.size(); ++i) mask.marked[i] = keep(i) ? 1 : 0;
    return mask;
}

/// Dilates the mask by a disc of `radius` px.
TiledMask dilated(const TiledMask& mask, double radius) {
    const auto squares = squared_distances(mask);
    return where(mask, [&](std::size_t i) { return static_cast<double>(squares[i]) <= radius * radius; });
}

/// Calls visit(index) for the eight neighbours of a pixel.
template <typename Visit>
void around(const TiledMask& mask, std::uint32_t pixel, const Visit& visit) {
    const int x = static_cast<int>(pixel) % mask.width, y = static_cast<int>(pixel) / mask.width;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (dx != 0 || dy != 0) visit(mask.index(x + dx, y + dy));
        }
    }
}

/// Returns whether a thin component touches the wide part in at least two separate places.
bool joins(const TiledComponent& thin, const TiledMask& wide) {
    TiledMask contact(wide.width, wide.height);
    std::vector<std::uint32_t> pixels;
    for (const std::uint32_t pixel : thin.pixels) {
        around(wide, pixel, [&](std::size_t i) {
            if (!wide.marked[i] || contact.marked[i]) return;
            contact.marked[i] = 1;
            pixels.push_back(static_cast<std::uint32_t>(i));
        });
    }
    if (pixels.empty()) return false;
    std::vector<std::uint32_t> open{pixels.front()};
    contact.marked[open.front()] = 0;
    std::size_t reached = 0;
    while (!open.empty()) {
        const std::uint32_t at = open.back();
        open.pop_back();
        ++reached;
        around(wide, at, [&](std::size_t i) {
            if (!contact.marked[i]) return;
            contact.marked[i] = 0;
            open.push_back(static_cast<std::uint32_t>(i));
        });
    }
    return reached < pixels.size();
}

/// Marks the medial line of a component: pixels whose depth is no less than that of both neighbours along
/// some direction, and greater than that of at least one of them.
void mark_middle_line(const TiledComponent& part, const TiledMask& solid,
                      const std::vector<std::int64_t>& depth, TiledMask& line) {
    constexpr std::array<std::array<int, 2>, 4> ways{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    for (const std::uint32_t pixel : part.pixels) {
        const int x = static_cast<int>(pixel) % solid.width, y = static_cast<int>(pixel) / solid.width;
        for (const auto& way : ways) {
            const std::int64_t before = depth[solid.index(x - way[0], y - way[1])],
                               after = depth[solid.index(x + way[0], y + way[1])];
            const std::int64_t here = depth[pixel];
            if (here >= before && here >= after && here + here > before + after) line.marked[pixel] = 1;
        }
    }
}

/// Widens struts to at least twice `radius` and rounds corners by `radius` (px).
TiledMask widened(const TiledMask& solid, double radius) {
    const auto depth = squared_distances(where(solid, [&](std::size_t i) { return !solid.marked[i]; }));
    const TiledMask deep =
        where(solid, [&](std::size_t i) { return static_cast<double>(depth[i]) > radius * radius; });
    const TiledMask wide = dilated(deep, radius);
    const auto from_wide = squared_distances(wide);
    const TiledMask rest = where(solid, [&](std::size_t i) { return solid.marked[i] && !wide.marked[i]; });
    TiledMask line(solid.width, solid.height);
    for (const TiledComponent& thin : components_of(rest)) {
        const bool far = std::any_of(thin.pixels.begin(), thin.pixels.end(), [&](std::uint32_t pixel) {
            return static_cast<double>(from_wide[pixel]) > radius * radius;
        });
        if (far || joins(thin, wide)) mark_middle_line(thin, solid, depth, line);
    }
    const TiledMask struts = dilated(line, radius);
    return where(solid, [&](std::size_t i) { return wide.marked[i] || struts.marked[i]; });
}

/// Opens the mask with a disc of `radius` px.
TiledMask opened(const TiledMask& mask, double radius) {
    const auto depth = squared_distances(where(mask, [&](std::size_t i) { return !mask.marked[i]; }));
    return dilated(
        where(mask, [&](std::size_t i) { return static_cast<double>(depth[i]) > radius * radius; }), radius);
}

/// Closes the mask with a disc of `radius` px: fills notches of windows narrower than twice the radius.
TiledMask closed(const TiledMask& mask, double radius) {
    const auto unmarked = [](const TiledMask& of) {
        return where(of, [&](std::size_t i) { return !of.marked[i]; });
    };
    return unmarked(opened(unmarked(mask), radius));
}

}  // namespace

StrutImage::StrutImage(const Volume& picture, const StrutImageSettings& settings) {
    check(picture, settings);
    const int width = static_cast<int>(picture.size[0]), height = static_cast<int>(picture.size[1]);
    const int times = division(width, height, settings);
    width_ = width * times;
    height_ = height * times;
    pixel_ = settings.size / width_;
    // Discs of pixels are up to half a pixel narrower than true discs.
    const double radius = 0.5 * settings.strut / pixel_ + 0.5;
    TiledMask solid = widened(thresholded(grey_of(picture), width, height, times, settings), radius);
    solid = opened(closed(solid, 0.5 * radius), radius);
    for (const TiledComponent& part : components_of(solid)) {
        if (part.goes_on) continue;
        ++islands_;
        for (const std::uint32_t pixel : part.pixels) solid.marked[pixel] = 0;
    }
    const TiledMask open = where(solid, [&](std::size_t i) { return !solid.marked[i]; });
    const std::size_t open_pixels = open.count();
    if (open_pixels == open.marked.size()) {
        throw InputError(fmt::format(
            "the picture has no struts that go on from tile to tile, {} islands alone; accepted: another "
            "threshold, or what is solid exchanged with what is not (invert)",
            islands_));
    }
    if (open_pixels == 0) {
        throw InputError(
            "the picture has no window left; accepted: another threshold, a narrower strut or a larger "
            "picture");
    }
    open_share_ = static_cast<double>(open_pixels) / static_cast<double>(open.marked.size());
    const auto to_solid = squared_distances(solid), to_open = squared_distances(open);
    distance_.reserve(to_solid.size());
    for (std::size_t i = 0; i < to_solid.size(); ++i) {
        const auto way = std::sqrt(static_cast<double>(solid.marked[i] ? to_open[i] : to_solid[i])) - 0.5;
        distance_.push_back(static_cast<float>(solid.marked[i] ? -way : way));
    }
}

double StrutImage::value(double u, double v) const {
    const auto place = [](double at, int count) {
        const double turns = std::floor(at / count);
        return std::min(std::max(at - turns * count, 0.0), count * (1 - 1e-15));
    };
    const double x = place(u / pixel_ - 0.5, width_), y = place(v / pixel_ - 0.5, height_);
    const int i = std::min(static_cast<int>(x), width_ - 1), j = std::min(static_cast<int>(y), height_ - 1);
    const int right = i + 1 < width_ ? i + 1 : 0, up = j + 1 < height_ ? j + 1 : 0;
    const auto at = [&](int a, int b) {
        return static_cast<double>(distance_[static_cast<std::size_t>(b) * static_cast<std::size_t>(width_) +
                                             static_cast<std::size_t>(a)]);
    };
    const double s = x - i, t = y - j;
    const double low = at(i, j) * (1 - s) + at(right, j) * s, high = at(i, up) * (1 - s) + at(right, up) * s;
    // Bilinear interpolation may be steeper than the distance by sqrt(2).
    constexpr double evened = 0.7071067811865475;
    return (low * (1 - t) + high * t) * (pixel_ * evened);
}

}  // namespace lamella
