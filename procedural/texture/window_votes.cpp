// The inverse of the windows, site by site, and sums over it.
#include "procedural/texture/window_votes.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {

namespace {

constexpr std::uint32_t places_a_window = 128;  // a power of two beyond the largest window

}  // namespace

WindowVotes::WindowVotes(const SiteWindows& windows, const Exemplar& exemplar)
    : windows_(windows), exemplar_(exemplar) {
    const std::size_t area = windows.area(), sites = windows.sites.size() / area;
    if (sites > (std::uint64_t{1} << 32U) / places_a_window)
        throw InputError(std::to_string(sites) + " sites; expected at most 33 million");
    const int radius = windows.radius();
    for (int up = -radius; up <= radius; ++up) {
        for (int across = -radius; across <= radius; ++across)
            falloff_.push_back(static_cast<float>(
                exponential(-2.0 * (across * across + up * up) / (0.25 * windows.size * windows.size))));
    }
    first_.assign(sites + 1, 0);
    for (const std::uint32_t site : windows.sites) ++first_[site + 1];
    for (std::size_t i = 0; i < sites; ++i) first_[i + 1] += first_[i];
    covers_.resize(windows.sites.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < windows.sites.size(); ++i) {
        covers_[next[windows.sites[i]]++] =
            static_cast<std::uint32_t>(i / area) * places_a_window + static_cast<std::uint32_t>(i % area);
    }
}

std::vector<float> WindowVotes::rarity(const SitePattern& pattern) const {
    constexpr std::size_t bins = 16;
    const auto bin = [](double distance) {
        return std::min(static_cast<std::size_t>(std::max(distance * bins, 0.0)), bins - 1);
    };
    std::array<double, bins> here{}, wanted{};
    const double sites = static_cast<double>(pattern.distance.size());
    for (const float distance : pattern.distance) here[bin(static_cast<double>(distance))] += 1 / sites;
    for (const ExemplarPart& part : exemplar_.parts) {
        const double share = part.weight / (static_cast<double>(part.width) * part.height);
        for (int y = 0; y < part.height; ++y) {
            for (int x = 0; x < part.width; ++x)
                wanted[bin(exemplar_.distance.values[exemplar_.distance.index(x, part.first_row + y)])] +=
                    share;
        }
    }
    std::vector<float> counts;
    counts.reserve(exemplar_.distance.values.size());
    for (const double distance : exemplar_.distance.values) {
        const std::size_t b = bin(distance);
        // No part has what is beside a narrow one.
        counts.push_back(
            static_cast<float>(wanted[b] > 0 ? 1 / (1 + std::max(here[b] / wanted[b] - 1, 0.0)) : 1));
    }
    return counts;
}

void WindowVotes::vote(const WindowMatches& matches, std::span<const std::uint8_t> fixed,
                       SitePattern& pattern) const {
    constexpr double least_difference = 1e-3, exponent = 1.2;
    const std::size_t sites = first_.size() - 1;
    std::vector<float> weights(sites);
    const std::vector<float> counts = rarity(pattern);
    const double area = static_cast<double>(windows_.area());
    parallel_for(sites, [&](std::size_t i) {
        const double difference = area * static_cast<double>(matches.differences()[i]);
        weights[i] = static_cast<float>(1 / (least_difference + power(difference, exponent)));
    });
    parallel_for(sites, [&](std::size_t i) {
        if (!fixed.empty() && fixed[i] != 0) return;
        float sum = 0, solid = 0, distance = 0;
        for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
            const std::uint32_t site = covers_[k] / places_a_window, place = covers_[k] % places_a_window;
            const int across = static_cast<int>(place) % windows_.size - windows_.radius(),
                      up = static_cast<int>(place) / windows_.size - windows_.radius();
            const ExemplarPixel match = matches.matches()[site];
            const std::size_t pixel = exemplar_.solid.index(match.x + across, match.y + up);
            const float weight = weights[site] * falloff_[place] * counts[pixel];
            sum += weight;
            solid += weight * static_cast<float>(exemplar_.solid.values[pixel]);
            distance += weight * static_cast<float>(exemplar_.distance.values[pixel]);
        }
        if (!(sum > 0)) return;
        pattern.solid[i] = solid / sum;
        pattern.distance[i] = distance / sum;
    });
}

}  // namespace lamella
