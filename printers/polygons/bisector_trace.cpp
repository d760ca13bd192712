// Bisectors are polynomials of a parameter, along which the differences of squared or plain distances to
// sites are quadratic at most.
#include "printers/polygons/bisector_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "printers/polygons/box_grid.h"

namespace lamella {

namespace {

constexpr double rounding = 1e-4;      // of places on the border
constexpr std::size_t few_sites = 24;  // are tried one by one
constexpr int tried_neighbours = 3;    // on either side, before others
constexpr std::size_t most_sites = 100000;

dvec2 left_of(dvec2 v) { return {-v.y, v.x}; }

/// A segment of the border; or a corner where it turns right, which has no length.
struct BorderSite {
    dvec2 a{0}, b{0};
    dvec2 along{0};  ///< unit vector from a to b
    bool corner = false;
    std::size_t before = 0, after = 0;  ///< its neighbours on the ring

    dvec2 nearest(dvec2 p) const {
        if (corner) return a;
        return a + along * std::clamp(dot(p - a, along), 0.0, length(b - a));
    }
    /// Returns the signed distance of a point to the segment's line.
    double height(dvec2 p) const { return dot(p - a, left_of(along)); }
};

/// c0 + c1 s + c2 s^2
struct Quadratic {
    double c0 = 0, c1 = 0, c2 = 0;

    double at(double s) const { return c0 + s * (c1 + s * c2); }
    Quadratic operator-() const { return {-c0, -c1, -c2}; }

    /// Returns the first place from s on where the values are not positive; infinity where they stay so, or
    /// where they are not at s, but rise.
    double first_end(double s) const {
        const double value = at(s), slope = c1 + 2 * c2 * s;
        if (value <= 0) return slope < 0 || (slope == 0 && c2 < 0) ? s : infinity;
        const double root = slope * slope - 4 * c2 * value;
        if (root < 0) return infinity;
        if (slope < 0) return s + 2 * value / (-slope + std::sqrt(root));
        return c2 < 0 ? s + (slope + std::sqrt(root)) / (-2 * c2) : infinity;
    }
};

/// The points as far from one site, on the left, as from another one, on the right, in the order in which the
/// nearest points move on along the border on the right, and back on the left.
struct Bisector {
    const BorderSite *left = nullptr, *right = nullptr;
    dvec2 p0{0}, p1{0}, p2{0};  ///< p0 + p1 s + p2 s^2
    double r0 = 0, r1 = 0;      ///< of two segments: distance r0 + r1 s
    double half = 0;            ///< of two corners: distance sqrt(half^2 + s^2)
    double height = 0;          ///< of a corner over a segment

    bool of_segments() const { return !left->corner && !right->corner; }
    bool of_corners() const { return left->corner && right->corner; }
    const BorderSite& segment() const { return right->corner ? *left : *right; }
    const BorderSite& corner() const { return right->corner ? *right : *left; }

    dvec2 at(double s) const { return p0 + s * (p1 + s * p2); }
    /// Returns the dot product of the points less `from` with a vector.
    Quadratic component(dvec2 from, dvec2 v) const { return {dot(p0 - from, v), dot(p1, v), dot(p2, v)}; }

    /// Returns the parameter of a point on the bisector.
    double parameter(dvec2 p) const { return dot(p - p0, p1) / dot(p1, p1); }

    /// Returns a rectangle around the discs between two parameters that touch both sites.
    Rect reach(double from, double to) const {
        // A curve of degree two lies in the triangle of its ends and the point where their tangents meet.
        Rect box;
        for (const dvec2 p : {at(from), at(to), p0 + 0.5 * (from + to) * p1 + from * to * p2})
            box = unite(box, Rect{p, p});
        const double radius =
            std::max(length(at(from) - right->nearest(at(from))), length(at(to) - right->nearest(at(to)))) +
            1;
        return {box.lo - radius, box.hi + radius};
    }
    /// Returns how much farther a site is than those of the bisector: a difference of distances, or of
    /// squares.
    Quadratic farther(const BorderSite& site) const {
        if (site.corner && !of_segments()) {
            const dvec2 apart = site.a - corner().a;
            Quadratic result = component(corner().a, -2.0 * apart);
            result.c0 += dot(apart, apart);
            return result;
        }
        if (site.corner) {
            const dvec2 from = p0 - site.a;
            return {dot(from, from) - r0 * r0, 2 * (dot(from, p1) - r0 * r1), 1 - r1 * r1};
        }
        if (!of_corners()) {
            const Quadratic to = component(site.a, left_of(site.along)),
                            own = component(segment().a, left_of(segment().along));
            return {to.c0 - own.c0, to.c1 - own.c1, to.c2 - own.c2};
        }
        const Quadratic to = component(site.a, left_of(site.along));
        return {to.c0 * to.c0 - half * half, 2 * to.c0 * to.c1, to.c1 * to.c1 - 1};
    }
};

/// Returns the bisector of two sites through a point; nothing if they have none.
std::optional<Bisector> bisector_of(const BorderSite& left, const BorderSite& right, dvec2 through) {
    Bisector result{.left = &left, .right = &right};
    if (result.of_segments()) {
        const dvec2 way = right.along - left.along;
        const double size = length(way);
        constexpr double straight = 1e-9;
        if (!(size > straight)) return {};
        result.p0 = through;
        result.p1 = way / size;
        result.r0 = right.height(through);
        result.r1 = dot(result.p1, left_of(right.along));
        return result;
    }
    if (result.of_corners()) {
        const dvec2 apart = right.a - left.a;
        const double size = length(apart);
        if (!(size > rounding)) return {};
        result.p0 = 0.5 * (left.a + right.a);
        result.p1 = left_of(apart) / size;
        result.half = 0.5 * size;
        return result;
    }
    // A parabola: with x along the segment, y = (x^2 + height^2) / (2 height).
    const BorderSite &segment = result.segment(), &corner = result.corner();
    const dvec2 up = left_of(segment.along);
    result.height = segment.height(corner.a);
    if (!(result.height > rounding)) return {};
    result.p0 = corner.a - 0.5 * result.height * up;
    result.p1 = right.corner ? -segment.along : segment.along;
    result.p2 = up / (2 * result.height);
    return result;
}

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
        if (along < -rounding || along > length(site.b - site.a) + rounding || site.height(p) < -rounding)
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
    if (length(to - from) < 10 * rounding) return true;
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
