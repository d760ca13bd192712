// Sweeps over the windows of the target, in parallel by rows; the occurrence map by sums of boxes.
#include "procedural/appearance/patch_match.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {
namespace {

constexpr int largest_exemplar = 1024;  // px; rows of windows then take 16 MB to 64 MB
constexpr double usual_spread = 0.1;    // of the number of pixels of a window
// The newest occurrence map's share in the mean over sweeps. With 1, windows swing between crowded places
// from sweep to sweep; the heavier the uniformity term, the less of a change it may answer at once.
constexpr double largest_share = 0.0625;
constexpr double share_by_spread = 0.02;  // at a spread of all pixels of a window
constexpr std::array<int, 4> flood_steps{8, 4, 2, 1};
constexpr std::size_t most_candidates = 1 + 4 * flood_steps.size();

std::uint8_t solid_byte(double value) {
    return value > 0 ? static_cast<std::uint8_t>(std::lround(255 * std::min(value, 1.0))) : std::uint8_t{0};
}

int randomly_below(std::uint32_t random, int count) {
    return static_cast<int>(std::uint64_t{random} * static_cast<std::uint64_t>(count) >> 32U);
}

/// Returns the sum over each `size` x `size` window inside an image of `width` pixels a row.
template <class Number>
std::vector<std::int64_t> window_sums(std::span<const Number> image, std::size_t width, std::size_t size) {
    const std::size_t height = image.size() / width, stride = width + 1;
    std::vector<std::int64_t> integral(stride * (height + 1), 0), sums;
    for (std::size_t y = 0; y < height; ++y) {
        std::int64_t row = 0;
        for (std::size_t x = 0; x < width; ++x) {
            row += image[y * width + x];
            integral[(y + 1) * stride + x + 1] = integral[y * stride + x + 1] + row;
        }
    }
    sums.reserve((width - size + 1) * (height - size + 1));
    for (std::size_t y = 0; y + size <= height; ++y) {
        const std::int64_t *const low = &integral[y * stride], *const high = &integral[(y + size) * stride];
        for (std::size_t x = 0; x + size <= width; ++x)
            sums.push_back(high[x + size] - high[x] - low[x + size] + low[x]);
    }
    return sums;
}

void require_windows(const char* what, int width, int height, int size) {
    if (width < size || height < size)
        throw InputError(
            std::string("the ") + what + " has " + std::to_string(width) + " x " + std::to_string(height) +
            " pixels; expected at least neighbourhood = " + std::to_string(size) + " in both directions");
}

}  // namespace

/// A window of the target, the best match so far, and the candidates that are compared with it.
struct PatchMatch::Window {
    std::vector<std::uint8_t> pixels;
    std::array<ExemplarPlace, most_candidates> candidates;
    std::array<std::uint32_t, most_candidates> keys;  ///< the same, quicker to compare
    std::array<std::size_t, most_candidates> begins;
    std::array<std::uint32_t, most_candidates> differences;
    std::size_t count = 0;
    ExemplarPlace best{};
    double cost = 0;

    /// Remembers a place to try, unless it is that of the best match or already among the candidates.
    void consider(ExemplarPlace place) {
        if (place == best) return;
        const auto key = std::bit_cast<std::uint32_t>(place);
        for (std::size_t i = count; i-- > 0;) {
            if (keys[i] == key) return;
        }
        keys[count] = key;
        candidates[count++] = place;
    }
};

PatchMatch::PatchMatch(const GreyImage& exemplar, int width, int height, const MatchSettings& settings,
                       int level, std::span<const std::uint8_t> passive)
    : settings_(settings),
      width_(width),
      height_(height),
      exemplar_width_(exemplar.width),
      exemplar_height_(exemplar.height),
      level_(level),
      difference_(settings.neighbourhood, settings.exponent),
      size_(settings.neighbourhood),
      spread_(settings.spread.value_or(usual_spread * size_ * size_)) {
    require_windows("exemplar", exemplar_width_, exemplar_height_, size_);
    require_windows("target", width_, height_, size_);
    if (std::max(exemplar_width_, exemplar_height_) > largest_exemplar)
        throw InputError("the exemplar has " + std::to_string(exemplar_width_) + " x " +
                         std::to_string(exemplar_height_) + " pixels; expected at most " +
                         std::to_string(largest_exemplar) + " in both directions");
    if (!(spread_ >= 0 && spread_ <= 1e6))
        throw InputError("spread = " + std::to_string(spread_) + "; expected 0 to 1e6");
    std::ranges::transform(exemplar.values, std::back_inserter(exemplar_), solid_byte);
    exemplar_rows_ = difference_.all_rows(exemplar_, exemplar_width_, exemplar_height_);
    matches_.resize(static_cast<std::size_t>(windows_across()) * static_cast<std::size_t>(windows_high()));
    mark_active(passive);
    // lambda omega / omega_best in steps of the difference: omega = use / N^2, and the mean of Omega over the
    // exemplar is (windows N^2) / (pixels of the exemplar).
    const double area = static_cast<double>(size_) * size_;
    use_weight_ = difference_.unit() * spread_ * static_cast<double>(exemplar_.size()) /
                  (static_cast<double>(active_) * area * area);
    next_ = matches_;
    begin_randomly();
}

/// Gives the windows that are not all passive a place.
void PatchMatch::mark_active(std::span<const std::uint8_t> passive) {
    std::vector<std::uint8_t> free(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 1);
    if (!passive.empty()) {
        if (passive.size() != free.size())
            throw InputError("the mask of passive elements has " + std::to_string(passive.size()) +
                             " elements; expected " + std::to_string(free.size()));
        std::ranges::transform(passive, free.begin(), [](std::uint8_t p) { return p == 0 ? 1 : 0; });
    }
    const auto free_pixels =
        window_sums<std::uint8_t>(free, static_cast<std::size_t>(width_), static_cast<std::size_t>(size_));
    for (std::size_t i = 0; i < matches_.size(); ++i) {
        if (free_pixels[i] == 0) continue;
        matches_[i] = {0, 0};
        ++active_;
    }
    if (active_ == 0) throw InputError("every element is passive; expected some that can change");
}

void PatchMatch::begin_randomly() {
    for (std::size_t i = 0; i < matches_.size(); ++i) {
        if (matches_[i].x < 0) continue;
        const CounterHash random(settings_.seed, level_, 0, static_cast<std::int64_t>(i), 0);
        const std::uint64_t bits = random.bits(0);
        matches_[i].x = static_cast<std::int16_t>(
            randomly_below(static_cast<std::uint32_t>(bits >> 32U), static_cast<int>(columns())));
        matches_[i].y = static_cast<std::int16_t>(
            randomly_below(static_cast<std::uint32_t>(bits), static_cast<int>(rows())));
    }
}

void PatchMatch::set_state(MatchState state) {
    if (state.matches.empty()) {
        sweeps_ = 0;
        use_.clear();
        begin_randomly();
        return;
    }
    const auto is_place = [&](ExemplarPlace m) {
        return m.x >= 0 && m.x <= last_x() && m.y >= 0 && m.y <= last_y();
    };
    const std::size_t used = state.sweeps > 0 && spread_ > 0 ? columns() * rows() : 0;
    bool fits = state.matches.size() == matches_.size() && state.use.size() == used;
    for (std::size_t i = 0; fits && i < matches_.size(); ++i)
        fits = matches_[i].x < 0 ? state.matches[i] == ExemplarPlace{} : is_place(state.matches[i]);
    if (!fits) throw InputError("the state of matches does not fit the target and the exemplar");
    sweeps_ = state.sweeps;
    matches_ = std::move(state.matches);
    use_ = std::move(state.use);
}

std::vector<std::int64_t> PatchMatch::occurrence() const {
    // A pixel is covered by the windows that begin up to N - 1 pixels before it: the sum of a box over the
    // counts of places, with a border of N - 1 zeros.
    const auto border = static_cast<std::size_t>(size_ - 1);
    const std::size_t wide = columns() + 2 * border, high = rows() + 2 * border;
    std::vector<std::int64_t> places(wide * high, 0);
    for (const ExemplarPlace m : matches_) {
        if (m.x >= 0)
            ++places[(static_cast<std::size_t>(m.y) + border) * wide + static_cast<std::size_t>(m.x) +
                     border];
    }
    return window_sums<std::int64_t>(places, wide, static_cast<std::size_t>(size_));
}

void PatchMatch::average_use() {
    const auto now = window_sums<std::int64_t>(occurrence(), static_cast<std::size_t>(exemplar_width_),
                                               static_cast<std::size_t>(size_));
    if (use_.empty()) use_.assign(now.begin(), now.end());
    const double share = std::min(largest_share, share_by_spread * size_ * size_ / spread_);
    for (std::size_t i = 0; i < now.size(); ++i) use_[i] += share * (static_cast<double>(now[i]) - use_[i]);
}

void PatchMatch::sweep(std::span<const double> target, int sweeps) {
    const auto w = static_cast<std::size_t>(width_), n = static_cast<std::size_t>(size_);
    if (target.size() != w * static_cast<std::size_t>(height_))
        throw FaultError("a target of " + std::to_string(target.size()) + " values; expected " +
                         std::to_string(width_) + " x " + std::to_string(height_));
    target_.resize(target.size());
    std::ranges::transform(target, target_.begin(), solid_byte);
    for (int k = 0; k < sweeps; ++k) {
        ++sweeps_;
        if (spread_ > 0) average_use();
        parallel_for(windows_high(), [&](int y) {
            Window window;
            window.pixels.assign(difference_.window_bytes(), 0);
            for (int x = 0; x < windows_across(); ++x) {
                const std::size_t i = site(x, y);
                if (matches_[i].x < 0) continue;
                const std::uint8_t* from =
                    target_.data() + static_cast<std::size_t>(y) * w + static_cast<std::size_t>(x);
                for (std::size_t row = 0; row < n; ++row, from += w)
                    std::copy_n(from, n, window.pixels.data() + row * difference_.row_bytes());
                next_[i] = improved(x, y, window);
            }
        });
        matches_.swap(next_);
    }
}

ExemplarPlace PatchMatch::improved(int x, int y, Window& window) const {
    window.best = {};
    window.consider(matches_[site(x, y)]);
    for (const int step : flood_steps) {
        for (const auto [dx, dy] : {std::array{-step, 0}, {step, 0}, {0, -step}, {0, step}})
            consider_neighbour(x, y, dx, dy, window);
    }
    compare(window);
    consider_random(site(x, y), window);
    compare(window);
    return window.best;
}

/// Remembers where the match of a window lies that is (dx, dy) away, shifted back.
void PatchMatch::consider_neighbour(int x, int y, int dx, int dy, Window& window) const {
    if (x + dx < 0 || x + dx >= windows_across() || y + dy < 0 || y + dy >= windows_high()) return;
    const ExemplarPlace other = matches_[site(x + dx, y + dy)];
    const int px = other.x - dx, py = other.y - dy;
    if (other.x < 0 || px < 0 || px > last_x() || py < 0 || py > last_y()) return;
    window.consider({static_cast<std::int16_t>(px), static_cast<std::int16_t>(py)});
}

/// Remembers places about the best match, one in each of the ranges that halve.
void PatchMatch::consider_random(std::size_t at, Window& window) const {
    const CounterHash random(settings_.seed, level_, static_cast<std::int64_t>(sweeps_),
                             static_cast<std::int64_t>(at), 0);
    std::uint64_t draw = 0;
    for (int reach = std::max(last_x(), last_y()); reach > 0; reach /= 2) {
        const int from_x = std::max(0, window.best.x - reach),
                  to_x = std::min(last_x(), window.best.x + reach);
        const int from_y = std::max(0, window.best.y - reach),
                  to_y = std::min(last_y(), window.best.y + reach);
        const std::uint64_t bits = random.bits(draw++);
        const int px = from_x + randomly_below(static_cast<std::uint32_t>(bits >> 32U), to_x - from_x + 1);
        const int py = from_y + randomly_below(static_cast<std::uint32_t>(bits), to_y - from_y + 1);
        window.consider({static_cast<std::int16_t>(px), static_cast<std::int16_t>(py)});
    }
}

/// Makes the best of the candidates the best match, if it is better, and forgets them.
void PatchMatch::compare(Window& window) const {
    for (std::size_t i = 0; i < window.count; ++i) {
        const ExemplarPlace p = window.candidates[i];
        window.begins[i] = difference_.window_begin(p.x, p.y, exemplar_height_);
    }
    difference_.differences(window.pixels.data(), exemplar_rows_.data(), {window.begins.data(), window.count},
                            window.differences.data());
    const auto order = [&](ExemplarPlace p) { return p.y * exemplar_width_ + p.x; };
    for (std::size_t i = 0; i < window.count; ++i) {
        const ExemplarPlace p = window.candidates[i];
        double cost = window.differences[i];
        if (spread_ > 0)
            cost +=
                use_weight_ * use_[static_cast<std::size_t>(p.y) * columns() + static_cast<std::size_t>(p.x)];
        if (window.best.x >= 0 &&
            (cost > window.cost || (cost == window.cost && order(p) > order(window.best))))
            continue;
        window.best = p;
        window.cost = cost;
    }
    window.count = 0;
}

}  // namespace lamella
