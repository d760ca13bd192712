// Follows each bisector of two sites to the point where it meets a third one, from which two others go on.
#include "printers/polygons/bisector_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "printers/polygons/bisector.h"
#include "printers/polygons/box_grid.h"

namespace lamella {

namespace {

constexpr std::size_t few_sites = 24;  // are tried one by one
constexpr int tried_neighbours = 3;    // on either side, before others
constexpr std::size_t most_sites = 100000;

class AxisTracer {
  public:
    AxisTracer(std::span<const std::vector<dvec2>> rings, double tolerance)
        : tolerance_(tolerance), rings_(rings.size()) {
        for (const std::vector<dvec2>& ring : rings) add_sites(ring);
        if (sites_.size() <= few_sites) return;
        std::vector<Rect> boxes;
        boxes.reserve(sites_.size());
        for (const BorderSite& site : sites_)
            boxes.push_back({glm::min(site.a, site.b), glm::max(site.a, site.b)});
        grid_.emplace(boxes);
    }

    std::optional<MedialAxis> trace() {
        if (corners_ == 0 || sites_.size() > most_sites) return {};
        const std::size_t first = sharpest_corner();
        const dvec2 at = sites_[first].a;
        if (!follow({sites_[first].before, first, new_node(at, 0), at})) return {};
        while (!open_.empty()) {
            const auto [number, way] = open_.back();
            open_.pop_back();
            Meeting& meeting = meetings_[number];
            if (std::exchange(meeting.followed[way], true)) continue;
            if (!follow({meeting.sites[way], meeting.sites[(way + 1) % 3], meeting.node, meeting.at}))
                return {};
        }
        if (!is_whole()) return {};
        return std::move(axis_);
    }

  private:
    /// A bisector that is followed from a node on.
    struct Branch {
        std::size_t left, right;
        std::uint32_t node;
        dvec2 at;
    };
    /// A point as far from three sites. Bisectors leave it between each of them, on the left, and the next.
    struct Meeting {
        std::array<std::size_t, 3> sites;
        std::uint32_t node;
        dvec2 at;
        std::array<bool, 3> followed{};
    };
    /// Where a bisector ends.
    struct End {
        double s = infinity;
        enum class Kind : std::uint8_t { none, corner, left_turns, right_turns, meets } kind = Kind::none;
        std::size_t site = 0;  ///< that it meets
    };

    void add_sites(std::span<const dvec2> ring);
    std::size_t sharpest_corner() const;
    bool follow(Branch branch);
    End end_of(const Bisector& bisector, const Branch& branch, double from) const;
    void meet(const Bisector& bisector, const Branch& branch, double from, std::size_t number,
              End& end) const;
    bool add_meeting(const Bisector& bisector, std::size_t site, Branch& branch);
    bool is_whole() const;
    bool add_piece(const Bisector& bisector, double from, double to, Branch& branch);
    bool add_edge(const Bisector& bisector, dvec2 to, double radius, Branch& branch);

    std::uint32_t new_node(dvec2 at, double radius) {
        axis_.nodes.push_back({at, radius});
        return static_cast<std::uint32_t>(axis_.nodes.size() - 1);
    }

    double tolerance_;
    std::size_t rings_;
    std::vector<BorderSite> sites_;  ///< ring by ring
    std::optional<BoxGrid> grid_;    ///< of the sites, if they are many
    std::size_t corners_ = 0;        ///< where the border turns left
    std::size_t ends_ = 0;           ///< of them, where the axis has ended so far
    std::vector<Meeting> meetings_;
    std::multimap<std::array<std::size_t, 3>, std::size_t> meetings_of_;  ///< by their sites
    std::vector<std::pair<std::size_t, std::size_t>> open_;               ///< ways out of meetings
    MedialAxis axis_;
};

void AxisTracer::add_sites(std::span<const dvec2> ring) {
    // Without points on the straight line between their neighbours.
    std::vector<dvec2> corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 in = ring[i] - ring[(i + ring.size() - 1) % ring.size()],
                    out = ring[(i + 1) % ring.size()] - ring[i];
        if (cross(in, out) != 0 || dot(in, out) < 0) corners.push_back(ring[i]);
    }
    const std::size_t n = corners.size(), first = sites_.size();
    if (n < 3) return;
    for (std::size_t i = 0; i < n; ++i) {
        const dvec2 a = corners[i], b = corners[(i + 1) % n];
        const dvec2 in = a - corners[(i + n - 1) % n];
        if (cross(in, b - a) < 0) {
            sites_.push_back({.a = a, .b = a, .corner = true});
        } else {
            ++corners_;
        }
        sites_.push_back({.a = a, .b = b, .along = (b - a) / length(b - a)});
    }
    for (std::size_t i = first; i < sites_.size(); ++i) {
        sites_[i].before = (i > first ? i : sites_.size()) - 1;
        sites_[i].after = i + 1 < sites_.size() ? i + 1 : first;
    }
}

/// Returns the segment after the corner at which the border turns left the most.
std::size_t AxisTracer::sharpest_corner() const {
    std::size_t best = 0;
    double least = 2;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        const BorderSite &site = sites_[i], &last = sites_[site.before];
        if (site.corner || last.corner || dot(site.along, last.along) >= least) continue;
        least = dot(site.along, last.along);
        best = i;
    }
    return best;
}

/// Follows a bisector up to a corner, or up to where it meets a third site.
bool AxisTracer::follow(Branch branch) {
    for (std::size_t turns = 0; turns <= 2 * sites_.size(); ++turns) {
        const auto bisector = bisector_of(sites_[branch.left], sites_[branch.right], branch.at);
        if (!bisector) return false;
        const double from = bisector->parameter(branch.at);
        const End end = end_of(*bisector, branch, from);
        switch (end.kind) {
            case End::Kind::none:
                return false;
            case End::Kind::corner:
                ++ends_;
                return add_edge(*bisector, bisector->left->a, 0, branch);
            case End::Kind::left_turns:
                if (!add_piece(*bisector, from, end.s, branch)) return false;
                branch.left = bisector->left->before;
                break;
            case End::Kind::right_turns:
                if (!add_piece(*bisector, from, end.s, branch)) return false;
                branch.right = bisector->right->after;
                break;
            case End::Kind::meets:
                return add_piece(*bisector, from, end.s, branch) && add_meeting(*bisector, end.site, branch);
        }
    }
    return false;
}

/// Returns where the bisector's nearest point on the left or on the right turns to the next site, or another
/// site is as near, or where both segments meet.
AxisTracer::End AxisTracer::end_of(const Bisector& bisector, const Branch& branch, double from) const {
    const BorderSite &left = *bisector.left, &right = *bisector.right;
    End end;
    const auto turn = [&](const Quadratic& left_over, End::Kind kind) {
        const double s = left_over.first_end(from);
        if (s < end.s) end = {s, kind};
    };
    const BorderSite &next = sites_[right.after], &last = sites_[left.before];
    if (right.after == branch.left && bisector.of_segments())
        end = {bisector.parameter(left.a), End::Kind::corner};
    if (right.corner || next.corner)
        turn(-bisector.component(right.b, right.corner ? next.along : right.along), End::Kind::right_turns);
    if (left.corner || last.corner)
        turn(bisector.component(left.a, left.corner ? last.along : left.along), End::Kind::left_turns);
    const auto try_site = [&](std::size_t i) { meet(bisector, branch, from, i, end); };
    if (!grid_) {
        for (std::size_t i = 0; i < sites_.size(); ++i) try_site(i);
        return end;
    }
    std::size_t on_right = branch.right, on_left = branch.left;
    for (int i = 0; i < tried_neighbours; ++i) {
        try_site(on_right = sites_[on_right].after);
        try_site(on_left = sites_[on_left].before);
    }
    if (end.kind == End::Kind::none) {
        for (std::size_t i = 0; i < sites_.size(); ++i) try_site(i);
    } else {
        grid_->visit(bisector.reach(from, end.s), try_site);
    }
    return end;
}

/// Ends a bisector at a site if it is as near as the bisector's own before the end so far.
void AxisTracer::meet(const Bisector& bisector, const Branch& branch, double from, std::size_t number,
                      End& end) const {
    if (number == branch.left || number == branch.right) return;
    const BorderSite& site = sites_[number];
    for (const BorderSite* own : {bisector.left, bisector.right}) {
        // A corner and the segments beside it touch the same discs where one turns to the other.
        if ((number == own->before || number == own->after) && (site.corner || own->corner)) return;
    }
    const double s = bisector.farther(site).first_end(from);
    if (!(s < end.s)) return;
    if (!site.corner) {
        const dvec2 p = bisector.at(s);
        const double along = dot(p - site.a, site.along);
        if (along < -border_rounding || along > length(site.b - site.a) + border_rounding ||
            site.height(p) < -border_rounding)
            return;
    }
    end = {s, End::Kind::meets, number};
}

/// Notes where a branch has met a site. Where it was met by another branch before, both become one edge.
bool AxisTracer::add_meeting(const Bisector& bisector, std::size_t site, Branch& branch) {
    constexpr double same = 1;
    std::array<std::size_t, 3> around{branch.left, site, branch.right};
    std::rotate(around.begin(), std::ranges::min_element(around), around.end());
    const auto met = meetings_of_.equal_range(around);
    for (auto i = met.first; i != met.second; ++i) {
        Meeting& meeting = meetings_[i->second];
        if (length(meeting.at - branch.at) > same) continue;
        const auto way =
            static_cast<std::size_t>(std::ranges::find(meeting.sites, branch.right) - meeting.sites.begin());
        if (std::exchange(meeting.followed[way], true)) return false;
        if (branch.node != meeting.node)
            axis_.edges.push_back(
                {{branch.node, meeting.node},
                 {bisector.left->nearest(branch.at), bisector.left->nearest(meeting.at)},
                 {bisector.right->nearest(branch.at), bisector.right->nearest(meeting.at)}});
        return true;
    }
    meetings_of_.emplace(around, meetings_.size());
    const auto arrived = static_cast<std::size_t>(std::ranges::find(around, branch.right) - around.begin());
    meetings_.push_back({around, branch.node, branch.at, {}});
    meetings_.back().followed[arrived] = true;
    for (const std::size_t way : {1U, 2U}) open_.emplace_back(meetings_.size() - 1, (arrived + way) % 3);
    return meetings_.size() <= 2 * sites_.size();
}

/// Returns whether the axis ends at each corner where the border turns left, and has a cycle around each
/// hole.
bool AxisTracer::is_whole() const {
    const std::size_t ends = ends_ + 1;  // with the first
    // Each meeting has three branches, each end one, and each branch two of these.
    return ends == corners_ && meetings_.size() + 2 == ends + 2 * (rings_ - 1);
}

/// Adds the part of a bisector between two parameters, and moves the branch to its end.
bool AxisTracer::add_piece(const Bisector& bisector, double from, double to, Branch& branch) {
    if (bisector.height > 0) {
        // A chord over ds deviates by ds^2 / (8 height).
        const double step = std::sqrt(8 * bisector.height * tolerance_);
        const int count = static_cast<int>(std::clamp(std::ceil((to - from) / step), 1.0, 64.0));
        for (int i = 1; i < count; ++i) {
            const dvec2 p = bisector.at(from + (to - from) * i / count);
            if (!add_edge(bisector, p, length(p - bisector.corner().a), branch)) return false;
        }
    }
    const dvec2 p = bisector.at(to);
    return add_edge(bisector, p, length(p - bisector.right->nearest(p)), branch);
}

/// Adds a straight piece to a point, and moves the branch there. Returns false if the point is not as far
/// from the site on the left as from that on the right.
bool AxisTracer::add_edge(const Bisector& bisector, dvec2 to, double radius, Branch& branch) {
    const dvec2 from = branch.at;
    if (length(to - from) < 10 * border_rounding) return true;
    const std::uint32_t node = new_node(to, radius);
    const BorderSite &left = *bisector.left, &right = *bisector.right;
    constexpr double slack = 0.1;
    if (std::abs(length(to - left.nearest(to)) - length(to - right.nearest(to))) > slack) return false;
    axis_.edges.push_back({{branch.node, node},
                           {left.nearest(from), left.nearest(to)},
                           {right.nearest(from), right.nearest(to)}});
    branch.node = node;
    branch.at = to;
    return true;
}

}  // namespace

std::optional<MedialAxis> trace_medial_axis(std::span<const std::vector<dvec2>> rings, double tolerance) {
    return AxisTracer(rings, tolerance).trace();
}

}  // namespace lamella
