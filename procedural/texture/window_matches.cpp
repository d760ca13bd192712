// Sweeps over the windows of all sites, in parallel.
#include "procedural/texture/window_matches.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/voronoi/counter_hash.h"

namespace lamella {

namespace {

constexpr int largest_exemplar = 1024;
constexpr std::size_t most_parts = 24;
constexpr std::size_t sites_a_task = 256;
constexpr std::array<int, 3> steps{1, 2, 4};
constexpr std::size_t most_candidates = 4 * steps.size() + 24;
constexpr float newest_share = 0.25F;  // of the newest count of uses in their mean over sweeps
// Cost of a part that a site does not want, a pixel of the window: several times the usual difference.
constexpr float unwanted = 0.2F;

std::uint8_t byte_of(double share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

std::vector<std::uint8_t> bytes_of(const GreyImage& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.values.size());
    for (const double value : image.values) bytes.push_back(byte_of(value));
    return bytes;
}

int below(std::uint64_t random, int count) {
    return static_cast<int>((random >> 32U) * static_cast<std::uint64_t>(count) >> 32U);
}

}  // namespace

/// A window of the sites, its best match so far, and candidates.
struct WindowMatches::Search {
    std::vector<std::uint8_t> solid, distance;
    std::array<ExemplarPixel, most_candidates> candidates;
    std::array<std::size_t, most_candidates> begins;
    std::array<std::uint32_t, most_candidates> by_solid, by_distance;
    std::size_t count = 0;
    ExemplarPixel best{};
    float cost = 0, difference = 0;

    void consider(ExemplarPixel pixel) {
        if (std::find(candidates.begin(), candidates.begin() + count, pixel) == candidates.begin() + count)
            candidates[count++] = pixel;
    }
};

WindowMatches::WindowMatches(const SiteWindows& windows, const Exemplar& exemplar, int level,
                             const SynthesisSettings& settings)
    : windows_(windows),
      exemplar_(exemplar),
      settings_(settings),
      level_(level),
      width_(exemplar.solid.width),
      height_(exemplar.solid.height),
      radius_(windows.radius()),
      columns_(static_cast<std::size_t>(std::max(width_ - windows.size + 1, 0))),
      rows_(static_cast<std::size_t>(std::max(height_ - windows.size + 1, 0))),
      difference_(windows.size, 2) {
    const std::size_t sites = windows.sites.size() / windows.area(), parts = exemplar.parts.size();
    for (const ExemplarPart& part : exemplar.parts) {
        if (std::min(part.width, part.height) < windows.size ||
            std::max(part.width, part.height) > largest_exemplar)
            throw InputError("an exemplar of " + std::to_string(part.width) + " x " +
                             std::to_string(part.height) + " pixels; expected " +
                             std::to_string(windows.size) + " to " + std::to_string(largest_exemplar) +
                             " in both directions");
    }
    if (parts == 0 || parts > most_parts || exemplar.weights.size() != (parts > 1 ? parts * sites : 0))
        throw InputError("an exemplar of " + std::to_string(parts) + " parts with " +
                         std::to_string(exemplar.weights.size()) + " weights; expected 1 to " +
                         std::to_string(most_parts) + ", with one for each site");
    exemplar_solid_ = difference_.all_rows(bytes_of(exemplar.solid), width_, height_);
    exemplar_distance_ = difference_.all_rows(bytes_of(exemplar.distance), width_, height_);
    matches_.resize(sites);
    next_.resize(sites);
    differences_.resize(sites);
    use_.assign(columns_ * rows_, 0);
    for (std::size_t i = 0; i < sites; ++i) {
        const CounterHash random(settings.seed, level, 0, static_cast<std::int64_t>(i), 0);
        const ExemplarPart& part = exemplar.parts[wanted_part(i, random.uniform(2))];
        const int columns = part.width - windows.size + 1, rows = part.height - windows.size + 1;
        matches_[i] = {static_cast<std::int16_t>(radius_ + below(random.bits(0), columns)),
                       static_cast<std::int16_t>(part.first_row + radius_ + below(random.bits(1), rows))};
    }
}

/// Returns a part by chance, the more a site wants it the likelier.
std::size_t WindowMatches::wanted_part(std::size_t site, double random) const {
    const std::size_t parts = exemplar_.parts.size();
    if (parts == 1) return 0;
    const std::span<const float> weights(exemplar_.weights.data() + site * parts, parts);
    double left = 0;
    for (const float weight : weights) left += static_cast<double>(weight);
    left *= random;
    std::size_t part = 0;
    while (part + 1 < parts && left >= static_cast<double>(weights[part]))
        left -= static_cast<double>(weights[part++]);
    return part;
}

float WindowMatches::reluctance(std::size_t site, ExemplarPixel pixel) const {
    if (exemplar_.weights.empty()) return 0;
    return unwanted * (1 - exemplar_.weights[site * exemplar_.parts.size() + part_of(pixel)]);
}

void WindowMatches::begin_with_patches() {
    const double chance = 2.0 / static_cast<double>(windows_.area());  // of a site to be a patch's middle
    std::vector<int> nearest(matches_.size(), std::numeric_limits<int>::max());
    for (std::size_t i = 0; i < matches_.size(); ++i) {
        const CounterHash random(settings_.seed, level_, -1, static_cast<std::int64_t>(i), 0);
        if (random.uniform(0) > chance) continue;
        const ExemplarPixel middle = matches_[i];
        const auto window = windows_.of(i);
        for (std::size_t k = 0; k < window.size(); ++k) {
            const int across = static_cast<int>(k) % windows_.size - radius_,
                      up = static_cast<int>(k) / windows_.size - radius_;
            const int square = across * across + up * up;
            if (square >= nearest[window[k]]) continue;
            nearest[window[k]] = square;
            next_[window[k]] = clamped(middle.x + across, middle.y + up, part_of(middle));
        }
    }
    for (std::size_t i = 0; i < matches_.size(); ++i) {
        if (nearest[i] < std::numeric_limits<int>::max()) matches_[i] = next_[i];
    }
}

void WindowMatches::begin_with(std::span<const std::uint32_t> pixels, std::vector<std::uint8_t> kept) {
    if (pixels.size() != matches_.size() || kept.size() != matches_.size())
        throw InputError("matches of " + std::to_string(pixels.size()) + " sites; expected " +
                         std::to_string(matches_.size()));
    const auto width = static_cast<std::uint32_t>(width_);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const int x = static_cast<int>(pixels[i] % width), y = static_cast<int>(pixels[i] / width);
        matches_[i] = clamped(x, y, exemplar_.part_of(y));
    }
    next_ = matches_;  // those that are kept are in both
    kept_ = std::move(kept);
}

void WindowMatches::take_bytes(const SitePattern& pattern) {
    solid_.resize(pattern.solid.size());
    distance_.resize(pattern.distance.size());
    for (std::size_t i = 0; i < solid_.size(); ++i) {
        solid_[i] = byte_of(pattern.solid[i]);
        distance_[i] = byte_of(pattern.distance[i]);
    }
}

/// Counts for each window of the exemplar how many matches lie in it, against their mean.
void WindowMatches::average_use() {
    const std::size_t stride = static_cast<std::size_t>(width_) + 1;
    std::vector<std::int64_t> sums(stride * (static_cast<std::size_t>(height_) + 1), 0);
    for (const ExemplarPixel match : matches_)
        ++sums[(static_cast<std::size_t>(match.y) + 1) * stride + static_cast<std::size_t>(match.x) + 1];
    for (std::size_t y = 1; y <= static_cast<std::size_t>(height_); ++y) {
        std::int64_t row = 0;
        for (std::size_t x = 1; x < stride; ++x) {
            row += sums[y * stride + x];
            sums[y * stride + x] = row + sums[(y - 1) * stride + x];
        }
    }
    for (const ExemplarPart& part : exemplar_.parts) {
        const std::size_t lo = static_cast<std::size_t>(part.first_row) * stride,
                          hi = lo + static_cast<std::size_t>(part.height) * stride;
        average_use(part, static_cast<double>(sums[hi + stride - 1] - sums[lo + stride - 1]), sums);
    }
}

/// The same for a part in which so many matches lie; `sums` counts those above and left of a pixel.
void WindowMatches::average_use(const ExemplarPart& part, double matches,
                                std::span<const std::int64_t> sums) {
    const std::size_t stride = static_cast<std::size_t>(width_) + 1,
                      first = static_cast<std::size_t>(part.first_row);
    const auto radius = static_cast<std::size_t>(radius_), size = static_cast<std::size_t>(windows_.size);
    const std::size_t columns = static_cast<std::size_t>(part.width) - size + 1,
                      rows = static_cast<std::size_t>(part.height) - size + 1;
    const double centres = static_cast<double>(columns * rows);
    // Matches are middles of windows, so there are none in a margin about them.
    const auto covered = [&](std::size_t at, std::size_t count) {
        const std::size_t lo = std::max(at, radius), hi = std::min(at + size, count + radius);
        return static_cast<double>(hi - lo);
    };
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t y = first + row;
        for (std::size_t x = 0; x < columns; ++x) {
            const std::int64_t used = sums[(y + size) * stride + x + size] - sums[y * stride + x + size] -
                                      sums[(y + size) * stride + x] + sums[y * stride + x];
            const double usual = matches * covered(x, columns) * covered(row, rows) / centres;
            const auto excess = used == 0 ? -1.0F : static_cast<float>(static_cast<double>(used) / usual - 1);
            float& mean = use_[y * columns_ + x];
            mean += (sweeps_ == 0 ? 1 : newest_share) * (excess - mean);
        }
    }
}

ExemplarPixel WindowMatches::clamped(int x, int y, std::size_t part) const {
    const ExemplarPart& in = exemplar_.parts[part];
    return {static_cast<std::int16_t>(std::clamp(x, radius_, in.width - 1 - radius_)),
            static_cast<std::int16_t>(
                std::clamp(y, in.first_row + radius_, in.first_row + in.height - 1 - radius_))};
}

void WindowMatches::consider_neighbours(std::size_t site, Search& search) const {
    const auto window = windows_.of(site);
    const auto from = [&](int across, int up) {
        if (std::max(std::abs(across), std::abs(up)) > radius_) return;
        const ExemplarPixel match = matches_[window[windows_.place(across, up)]];
        search.consider(clamped(match.x - across, match.y - up, part_of(match)));
    };
    for (const int step : steps) {
        from(-step, 0);
        from(step, 0);
        from(0, -step);
        from(0, step);
    }
}

void WindowMatches::consider_random(std::size_t site, Search& search) const {
    const CounterHash random(settings_.seed, level_, static_cast<std::int64_t>(sweeps_) + 1,
                             static_cast<std::int64_t>(site), 0);
    std::uint64_t draw = 0;
    const std::size_t part = part_of(search.best);
    const ExemplarPart& here = exemplar_.parts[part];
    for (int reach = std::max(here.width, here.height); reach > 0; reach /= 2) {
        const int x = search.best.x + below(random.bits(draw), 2 * reach + 1) - reach,
                  y = search.best.y + below(random.bits(draw + 1), 2 * reach + 1) - reach;
        draw += 2;
        search.consider(clamped(x, y, part));
    }
    if (exemplar_.parts.size() == 1) return;
    // A picture of another size has the same at the same share of its width and height.
    const std::size_t wanted = wanted_part(site, random.uniform(draw));
    const ExemplarPart& there = exemplar_.parts[wanted];
    const int x = search.best.x * there.width / here.width,
              y = (search.best.y - here.first_row) * there.height / here.height;
    search.consider(clamped(x, there.first_row + y, wanted));
    search.consider(clamped(below(random.bits(draw + 1), there.width),
                            there.first_row + below(random.bits(draw + 2), there.height), wanted));
}

/// Takes the candidate of the lowest cost, unless that of the best match is lower, and forgets the others.
void WindowMatches::compare(std::size_t site, Search& search) const {
    for (std::size_t i = 0; i < search.count; ++i) {
        search.begins[i] = difference_.window_begin(search.candidates[i].x - radius_,
                                                    search.candidates[i].y - radius_, height_);
    }
    const std::span<const std::size_t> begins(search.begins.data(), search.count);
    difference_.differences(search.solid.data(), exemplar_solid_.data(), begins, search.by_solid.data());
    difference_.differences(search.distance.data(), exemplar_distance_.data(), begins,
                            search.by_distance.data());
    const auto scale = static_cast<float>(1 / (difference_.unit() * static_cast<double>(windows_.area())));
    const auto spread = static_cast<float>(settings_.spread / static_cast<double>(windows_.area()));
    for (std::size_t i = 0; i < search.count; ++i) {
        const ExemplarPixel pixel = search.candidates[i];
        const std::size_t place = window_of(pixel), best = window_of(search.best);
        const float difference = scale * static_cast<float>(search.by_solid[i] + search.by_distance[i]);
        const float cost = difference + spread * std::max(use_[place], 0.0F) + reluctance(site, pixel);
        if (cost > search.cost || (cost == search.cost && place >= best)) continue;
        search.cost = cost;
        search.difference = difference;
        search.best = pixel;
    }
    search.count = 0;
}

void WindowMatches::improve(std::size_t site, Search& search) {
    const auto window = windows_.of(site);
    const std::size_t row_bytes = difference_.row_bytes(), size = static_cast<std::size_t>(windows_.size);
    for (std::size_t y = 0; y < size; ++y) {
        for (std::size_t x = 0; x < size; ++x) {
            search.solid[y * row_bytes + x] = solid_[window[y * size + x]];
            search.distance[y * row_bytes + x] = distance_[window[y * size + x]];
        }
    }
    search.best = clamped(width_, height_,
                          exemplar_.parts.size() - 1);  // the highest, so that an equal one replaces it
    search.cost = std::numeric_limits<float>::infinity();
    search.consider(matches_[site]);
    consider_neighbours(site, search);
    compare(site, search);
    consider_random(site, search);
    compare(site, search);
    next_[site] = search.best;
    differences_[site] = search.difference;
}

void WindowMatches::sweep(const SitePattern& pattern, int sweeps) {
    take_bytes(pattern);
    for (int i = 0; i < sweeps; ++i) {
        stop_if_cancelled(settings_.cancel);
        average_use();
        const std::size_t tasks = (matches_.size() + sites_a_task - 1) / sites_a_task;
        parallel_for(tasks, [&](std::size_t task) {
            Search search;
            search.solid.assign(difference_.window_bytes(), 0);
            search.distance.assign(difference_.window_bytes(), 0);
            const std::size_t end = std::min(matches_.size(), (task + 1) * sites_a_task);
            for (std::size_t site = task * sites_a_task; site < end; ++site) {
                if (kept_.empty() || kept_[site] == 0) improve(site, search);
            }
        });
        matches_.swap(next_);
        ++sweeps_;
    }
}

}  // namespace lamella
