// Least-area triangulation for short loops, ear clipping for long ones.
#include "engine/mesh/triangulate.h"

#include <algorithm>
#include <queue>

namespace lamella {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

constexpr std::size_t min_area_limit = 32;      // cubic time: 5 microseconds a corner at this size
constexpr std::size_t containment_limit = 512;  // quadratic time: longer loops are first shortened

/// Returns the area plus a small penalty for needles, so that well-shaped triangles win among equal areas.
double cost(dvec3 a, dvec3 b, dvec3 c) {
    const dvec3 cross = glm::cross(b - a, c - a);
    const double area = 0.5 * std::sqrt(squared_length(cross));
    const double longest = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
    const double slenderness = area * 1e3 > longest ? longest / area : 1e3;
    return area + 1e-6 * longest * slenderness;
}

void min_area(std::span<const dvec3> p, Triangles& out) {
    const std::size_t n = p.size();
    std::array<std::array<double, min_area_limit>, min_area_limit> best;
    std::array<std::array<std::uint8_t, min_area_limit>, min_area_limit> apex;
    for (std::size_t i = 0; i + 1 < n; ++i) best[i][i + 1] = 0.0;
    for (std::size_t gap = 2; gap < n; ++gap) {
        for (std::size_t i = 0; i + gap < n; ++i) {
            const std::size_t k = i + gap;
            best[i][k] = infinity;
            apex[i][k] = static_cast<std::uint8_t>(i + 1);
            for (std::size_t j = i + 1; j < k; ++j) {
                const double total = best[i][j] + best[j][k] + cost(p[i], p[j], p[k]);
                if (total < best[i][k]) {
                    best[i][k] = total;
                    apex[i][k] = static_cast<std::uint8_t>(j);
                }
            }
        }
    }
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
    while (!open.empty()) {
        const auto [i, k] = open.back();
        open.pop_back();
        if (k < i + 2) continue;
        const std::size_t j = apex[i][k];
        out.push_back(
            {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(k)});
        open.emplace_back(i, j);
        open.emplace_back(j, k);
    }
}

/// Projects the loop along its mean normal (Newell 1972), so that it is counter-clockwise.
std::vector<dvec2> flattened(std::span<const dvec3> p) {
    dvec3 normal(0.0);
    for (std::size_t i = 0; i < p.size(); ++i)
        normal += glm::cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]);
    const dvec3 size = glm::abs(normal);
    dvec3 axis(0.0, 0.0, 1.0);
    if (size.z >= size.x && size.z >= size.y) axis = dvec3(1.0, 0.0, 0.0);
    if (squared_length(normal) == 0.0) normal = dvec3(0.0, 0.0, 1.0);
    dvec3 u = glm::cross(axis, normal);
    u /= std::sqrt(squared_length(u));
    dvec3 v = glm::cross(normal, u);
    v /= std::sqrt(squared_length(v));
    std::vector<dvec2> flat;
    flat.reserve(p.size());
    for (const dvec3& q : p) flat.emplace_back(glm::dot(q - p[0], u), glm::dot(q - p[0], v));
    return flat;
}

double turn(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Clips ears off a ring of corners until three are left.
class EarClipper {
  public:
    EarClipper(std::span<const dvec3> loop, Triangles& out)
        : points_(loop), flat_(flattened(loop)), out_(out), left_(loop.size()) {
        const auto n = static_cast<std::uint32_t>(loop.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            before_.push_back((i + n - 1) % n);
            after_.push_back((i + 1) % n);
        }
        age_.assign(n, 0);
    }

    void run() {
        refill();
        int refills = 0;
        bool forced = false;
        while (left_ > 3) {
            if (ears_.empty()) {
                // No ear is clear: each is reflex or contains another corner. If ears have been cut since,
                // new ones may be clear now. A loop that crosses itself never gets any; then the shortest
                // diagonal is cut regardless.
                forced = ++refills > longest_patience || !cut_since_refill_;
                refill();
            }
            const Ear ear = ears_.top();
            ears_.pop();
            if (age_[ear.corner] != ear.age || (!forced && !is_clear(ear.corner))) continue;
            cut(ear.corner);
            forced = forced && refills > longest_patience;
        }
        const std::uint32_t a = last_;
        emit(before_[a], a, after_[a]);
    }

  private:
    struct Ear {
        double size;
        std::uint32_t corner;
        std::uint32_t age;
        bool operator<(const Ear& other) const {
            return size != other.size ? size > other.size : corner > other.corner;
        }
    };
    static constexpr int longest_patience = 16;
    static constexpr std::uint32_t gone = 0xffffffffU;

    void refill() {
        ears_ = {};
        cut_since_refill_ = false;
        std::uint32_t corner = last_;
        for (std::size_t i = 0; i < left_; ++i, corner = after_[corner]) push(corner);
    }

    void push(std::uint32_t corner) {
        double size = squared_length(points_[after_[corner]] - points_[before_[corner]]);
        if (is_reflex(corner)) size *= 16.0;
        ears_.push({size, corner, age_[corner]});
    }

    bool is_reflex(std::uint32_t corner) const {
        return turn(flat_[before_[corner]], flat_[corner], flat_[after_[corner]]) <= 0.0;
    }

    /// Returns true if the corner is convex and no other corner lies in the ear. Long loops are not tested:
    /// their first, shortest ears are local, and testing each against all corners would be quadratic.
    bool is_clear(std::uint32_t corner) const {
        if (left_ > containment_limit) return true;
        if (is_reflex(corner)) return false;
        const dvec2 a = flat_[before_[corner]];
        const dvec2 b = flat_[corner];
        const dvec2 c = flat_[after_[corner]];
        for (std::uint32_t i = after_[after_[corner]]; i != before_[corner]; i = after_[i]) {
            const dvec2 q = flat_[i];
            if (q == a || q == b || q == c) continue;
            if (turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= 0.0) return false;
        }
        return true;
    }

    void cut(std::uint32_t corner) {
        const std::uint32_t a = before_[corner];
        const std::uint32_t c = after_[corner];
        emit(a, corner, c);
        after_[a] = c;
        before_[c] = a;
        age_[corner] = gone;
        last_ = a;
        --left_;
        cut_since_refill_ = true;
        for (const std::uint32_t neighbour : {a, c}) {
            ++age_[neighbour];
            push(neighbour);
        }
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) { out_.push_back({a, b, c}); }

    std::span<const dvec3> points_;
    std::vector<dvec2> flat_;
    Triangles& out_;
    std::vector<std::uint32_t> before_, after_, age_;
    std::priority_queue<Ear> ears_;
    std::size_t left_;
    std::uint32_t last_ = 0;
    bool cut_since_refill_ = false;
};

}  // namespace

void triangulate_loop(std::span<const dvec3> loop, Triangles& out) {
    if (loop.size() < 3) return;
    if (loop.size() == 3) {
        out.push_back({0, 1, 2});
    } else if (loop.size() <= min_area_limit) {
        min_area(loop, out);
    } else {
        EarClipper(loop, out).run();
    }
}

}  // namespace lamella
