// All differences at a pixel of the target lie at the same fraction of a piece of the cubic, because values
// of the exemplar are whole numbers of pieces. So the coefficients can be added up first: one row of a
// table for each term, and one evaluation for each pixel.
#include "procedural/appearance/appearance.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {
namespace {

constexpr double energy_weight = 100;
constexpr double tip_rounding = 1e-4;  // of the tip of |d|^q, squared difference
constexpr int first_sweeps = 30;
constexpr int pieces_of_a_byte = 4;  // of the exemplar, 1/255
constexpr int unit_pieces = 255 * pieces_of_a_byte;
constexpr double range_slack = 1e-3;  // how far outside [0, 1] values of the target may be
constexpr std::size_t block_pixels = 4096;

}  // namespace

Appearance::Appearance(const GreyImage& exemplar, int width, int height, const MatchSettings& settings,
                       int level, std::span<const std::uint8_t> passive)
    : matches_(exemplar, width, height, settings, level, passive) {
    const double half = settings.exponent / 2;
    struct Knot {
        double value, slope;  ///< the latter by piece
    };
    const auto knot = [&](int i) {
        const double d = static_cast<double>(i) / unit_pieces, square = d * d + tip_rounding;
        const double value = power(square, half);
        return Knot{value, 2 * half * d * value / square / unit_pieces};
    };
    Knot low = knot(-unit_pieces);
    for (int i = -unit_pieces; i < unit_pieces; ++i) {
        const Knot high = knot(i + 1);
        const double rise = high.value - low.value;
        cubics_.push_back(
            {low.value, low.slope, 3 * rise - 2 * low.slope - high.slope, low.slope + high.slope - 2 * rise});
        low = high;
    }
}

void Appearance::match(std::span<const double> target) {
    matches_.sweep(target, matches_.sweeps() > 0 ? 1 : first_sweeps);
}

Appearance::Cubic Appearance::sum_at(int x, int y, int cell, const std::vector<std::int32_t>& begins) const {
    const int n = matches_.neighbourhood(), across = matches_.windows_across();
    const int first_x = std::max(0, x - n + 1), last_x = std::min(across - 1, x);
    const int first_y = std::max(0, y - n + 1), last_y = std::min(matches_.windows_high() - 1, y);
    const Cubic* const cubics = cubics_.data() + unit_pieces + cell;
    const std::uint8_t* const exemplar = matches_.exemplar().data();
    Cubic sum{};
    for (int wy = first_y; wy <= last_y; ++wy) {
        const std::int32_t* const row = begins.data() + std::ptrdiff_t{wy} * across;
        const std::int32_t offset = (y - wy) * matches_.exemplar_width() + x;
        for (int wx = first_x; wx <= last_x; ++wx) {
            if (row[wx] < 0) continue;
            const Cubic& term = cubics[-pieces_of_a_byte * std::ptrdiff_t{exemplar[row[wx] + offset - wx]}];
            for (std::size_t k = 0; k < term.size(); ++k) sum[k] += term[k];
        }
    }
    return sum;
}

double Appearance::evaluate(std::span<const double> target, double* gradient) const {
    std::vector<std::int32_t> begins;  // of the matches in the exemplar
    for (const ExemplarPlace m : matches_.matches())
        begins.push_back(m.x < 0 ? -1 : m.y * matches_.exemplar_width() + m.x);
    const double area = static_cast<double>(matches_.neighbourhood()) * matches_.neighbourhood();
    const double scale = energy_weight / (static_cast<double>(matches_.active_windows()) * area);
    const auto width = static_cast<std::size_t>(matches_.width());
    if (target.size() != width * static_cast<std::size_t>(matches_.height()))
        throw FaultError("a target of " + std::to_string(target.size()) + " values; expected " +
                         std::to_string(matches_.width()) + " x " + std::to_string(matches_.height()));
    std::vector<double> sums((target.size() + block_pixels - 1) / block_pixels, 0);
    parallel_for(sums.size(), [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * block_pixels, target.size());
        for (std::size_t i = block * block_pixels; i < end; ++i) {
            if (!(target[i] >= -range_slack && target[i] <= 1 + range_slack))
                throw FaultError("a density of " + std::to_string(target[i]) + "; expected 0 to 1");
            const double place = target[i] * unit_pieces;
            const int cell = std::clamp(static_cast<int>(place), 0, unit_pieces - 1);
            const double f = place - cell;
            const Cubic c = sum_at(static_cast<int>(i % width), static_cast<int>(i / width), cell, begins);
            sums[block] += c[0] + f * (c[1] + f * (c[2] + f * c[3]));
            if (gradient) gradient[i] = scale * unit_pieces * (c[1] + f * (2 * c[2] + f * (3 * c[3])));
        }
    });
    double sum = 0;
    for (const double part : sums) sum += part;
    return scale * sum;
}

}  // namespace lamella
