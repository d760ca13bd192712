// Flood fill; paths by Dijkstra's algorithm from all pieces at once, and Kruskal's over the places where they
// meet.
#include "procedural/pattern/pattern_pieces.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/base/disjoint_sets.h"

namespace lamella {

namespace {

/// Two neighbours that the paths of different pieces reach.
struct Meeting {
    double length;
    std::uint32_t from, to;
    bool operator<(const Meeting& other) const {
        return std::tie(length, from, to) < std::tie(other.length, other.from, other.to);
    }
};

class PathSearch {
  public:
    PathSearch(const SurfaceSites& sites, const SitePieces& pieces, std::span<const float> reluctance)
        : sites_(sites),
          reluctance_(reluctance),
          owner_(pieces.piece),
          before_(sites.size(), SitePieces::none),
          length_(sites.size(), infinity) {
        for (std::size_t i = 0; i < sites.size(); ++i) {
            if (owner_[i] == SitePieces::none) continue;
            length_[i] = 0;
            open_.emplace(0, static_cast<std::uint32_t>(i));
        }
        while (!open_.empty()) {
            const auto [length, site] = open_.top();
            open_.pop();
            if (length > length_[site]) continue;
            for (const std::uint32_t other : sites_.neighbours(site)) reach(other, site);
        }
    }

    std::vector<Meeting> meetings() const {
        std::vector<Meeting> found;
        for (std::uint32_t i = 0; i < sites_.size(); ++i) {
            for (const std::uint32_t other : sites_.neighbours(i)) {
                if (other < i || owner_[i] == owner_[other] || owner_[i] == SitePieces::none ||
                    owner_[other] == SitePieces::none)
                    continue;
                found.push_back({length_[i] + step(i, other) + length_[other], i, other});
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    std::uint32_t owner(std::uint32_t site) const { return owner_[site]; }

    /// Appends the sites from one back to its piece.
    void trace(std::uint32_t site, std::vector<std::uint32_t>& line) const {
        for (; site != SitePieces::none; site = before_[site]) line.push_back(site);
    }

  private:
    double step(std::uint32_t a, std::uint32_t b) const {
        const dvec3 way = sites_.way(sites_.places[a], sites_.places[b]);
        const double mean = 0.5 * static_cast<double>(reluctance_[a] + reluctance_[b]);
        return std::sqrt(glm::dot(way, way)) * (1 + mean);
    }

    void reach(std::uint32_t site, std::uint32_t from) {
        const double length = length_[from] + step(from, site);
        if (!(length < length_[site])) return;
        length_[site] = length;
        owner_[site] = owner_[from];
        before_[site] = from;
        open_.emplace(length, site);
    }

    using Entry = std::pair<double, std::uint32_t>;
    const SurfaceSites& sites_;
    std::span<const float> reluctance_;
    std::vector<std::uint32_t> owner_, before_;
    std::vector<double> length_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace

SitePieces pieces_of(const SurfaceSites& sites, std::span<const float> values) {
    SitePieces pieces;
    pieces.piece.assign(sites.size(), SitePieces::none);
    std::vector<std::uint32_t> open;
    for (std::uint32_t start = 0; start < sites.size(); ++start) {
        if (!(values[start] > 0) || pieces.piece[start] != SitePieces::none) continue;
        const auto number = static_cast<std::uint32_t>(pieces.sizes.size());
        std::size_t size = 0;
        pieces.piece[start] = number;
        open.assign(1, start);
        while (!open.empty()) {
            const std::uint32_t site = open.back();
            open.pop_back();
            ++size;
            for (const std::uint32_t other : sites.neighbours(site)) {
                if (!(values[other] > 0) || pieces.piece[other] != SitePieces::none) continue;
                pieces.piece[other] = number;
                open.push_back(other);
            }
        }
        pieces.sizes.push_back(size);
    }
    return pieces;
}

std::vector<std::vector<std::uint32_t>> lines_between(const SurfaceSites& sites, const SitePieces& pieces,
                                                      std::span<const float> reluctance) {
    std::vector<std::vector<std::uint32_t>> lines;
    const PathSearch paths(sites, pieces, reluctance);
    DisjointSets joined(pieces.sizes.size());
    for (const Meeting& meeting : paths.meetings()) {
        if (!joined.join(paths.owner(meeting.from), paths.owner(meeting.to))) continue;
        auto& line = lines.emplace_back();
        paths.trace(meeting.from, line);
        std::ranges::reverse(line);
        paths.trace(meeting.to, line);
    }
    return lines;
}

}  // namespace lamella
