// Constant, depth and clamped gradings; tight ranges by branch and bound; surveys over a lattice.
#include "engine/field/grading.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <queue>

#include "engine/base/error.h"

namespace lamella {
namespace {

class ConstantGrading : public Grading {
  public:
    explicit ConstantGrading(double number) : number_(number) {}
    double at(dvec3 /*p*/) const override { return number_; }
    Interval range(const Box& /*box*/) const override {
        return std::isnan(number_) ? Interval{infinity, infinity} : Interval{number_, number_};
    }
    std::optional<double> constant() const override { return number_; }

  private:
    double number_;
};

class DepthGrading : public Grading {
  public:
    explicit DepthGrading(FieldPtr body) : body_(std::move(body)) {}
    double at(dvec3 p) const override { return -body_->value(p); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        body_->values(points, out);
        for (double& number : out) number = -number;
    }
    Interval range(const Box& box) const override {
        const Interval values = body_->range(box);
        return {-values.hi, -values.lo};
    }

  private:
    FieldPtr body_;
};

class ClampedGrading : public Grading {
  public:
    ClampedGrading(GradingPtr grading, Interval limits) : grading_(std::move(grading)), limits_(limits) {}
    double at(dvec3 p) const override { return clamped(grading_->at(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*grading_, points, out, [&](double number) { return clamped(number); });
    }
    Interval range(const Box& box) const override {
        const Interval r = grading_->range(box);
        return {std::min(std::max(r.lo, limits_.lo), limits_.hi),
                std::max(std::min(r.hi, limits_.hi), limits_.lo)};
    }
    std::optional<double> constant() const override {
        if (limits_.lo == limits_.hi) return limits_.lo;
        return grading_->constant() ? std::optional(at(dvec3(0))) : std::nullopt;
    }

  private:
    double clamped(double number) const {
        if (number < limits_.lo) return limits_.lo;
        return number <= limits_.hi ? number : limits_.hi;
    }

    GradingPtr grading_;
    Interval limits_;
};

constexpr int max_divisions = 4000;
constexpr double tight_enough = 0.02;

/// A box whose enclosure is still wide.
struct Open {
    double bound;
    Box box;
    friend bool operator<(const Open& a, const Open& b) { return a.bound < b.bound; }
};

using Halves = std::array<Open, 2>;

/// Halves the box along the axis that lowers the sum of both bounds most. Ties go to the axis of the longest
/// side.
template <typename Bound>
Halves divide(const Open& open, const Bound& bound) {
    const dvec3 size = open.box.size();
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    Halves best{};
    double least = infinity;
    for (int turn = 0; turn < 3; ++turn) {
        const int axis = (longest + turn) % 3;
        Halves halves{open, open};
        halves[0].box.hi[axis] = halves[1].box.lo[axis] = open.box.center()[axis];
        for (Open& half : halves) half.bound = bound(half.box);
        const double sum = halves[0].bound + halves[1].bound;
        if (turn > 0 && !(sum < least)) continue;
        least = sum;
        best = halves;
    }
    return best;
}

/// Returns an upper bound of sign * grading over the box, or over the body's points in it, close to the
/// supremum.
double upper_bound(const Grading& grading, const Field* body, const Box& box, double sign, int divisions) {
    const auto bound = [&](const Box& b) {
        if (body != nullptr && body->range(b).lo > 0) return -infinity;
        const Interval r = grading.range(b);
        return sign > 0 ? r.hi : -r.lo;
    };
    std::priority_queue<Open> open;
    open.push({bound(box), box});
    double most = -infinity, least = infinity;
    for (int i = 0; i < divisions; ++i) {
        const Open worst = open.top();
        if (worst.bound == -infinity) break;
        const dvec3 center = worst.box.center();
        const double number = sign * grading.at(center);
        if (!std::isnan(number) && (body == nullptr || body->value(center) <= 0)) {
            most = std::max(most, number);
            least = std::min(least, number);
        }
        if (worst.bound <= most + tight_enough * (most - least) + 1e-9 * std::abs(most)) break;
        open.pop();
        for (const Open& half : divide(worst, bound)) open.push(half);
    }
    return open.top().bound;
}

}  // namespace

GradingPtr make_constant_grading(double number) { return std::make_shared<ConstantGrading>(number); }

GradingPtr make_depth_grading(FieldPtr body) { return std::make_shared<DepthGrading>(std::move(body)); }

GradingPtr make_clamped_grading(GradingPtr grading, Interval limits) {
    if (limits.empty()) throw InputError("the lower limit of a graded number exceeds the upper one");
    return std::make_shared<ClampedGrading>(std::move(grading), limits);
}

Interval tight_range(const Grading& grading, const Box& box) {
    return {-upper_bound(grading, nullptr, box, -1, max_divisions),
            upper_bound(grading, nullptr, box, 1, max_divisions)};
}

Interval range_in(const Field& body, const Grading& grading) {
    // The distance to a mesh is dear.
    constexpr int divisions = 1000;
    const Box box = body.bounds();
    return {-upper_bound(grading, &body, box, -1, divisions), upper_bound(grading, &body, box, 1, divisions)};
}

Interval positive_range(const Grading& length, const Box& region, const std::string& what) {
    const Interval range = tight_range(length, region);
    if (range.lo > 0 && std::isfinite(range.hi)) return range;
    if (const auto constant = length.constant()) {
        throw InputError(fmt::format("{} is {:.6g} mm; it must be positive", what, *constant));
    }
    if (!(range.lo > 0)) {
        throw InputError(
            fmt::format("{} goes down to {:.6g} mm; it must be positive: give it limits", what, range.lo));
    }
    throw InputError(
        fmt::format("{} is infinite or not defined somewhere in the part; it must be a finite "
                    "length everywhere: give it limits",
                    what));
}

std::vector<dvec3> points_inside(const Field& body, int per_side) {
    std::vector<dvec3> points;
    const Box box = body.bounds();
    const dvec3 size = box.size();
    const double step = std::max({size.x, size.y, size.z}) / per_side;
    if (!(step > 0) || !std::isfinite(step)) return points;
    // At least one point along every side, so that flat bodies are sampled too.
    const glm::ivec3 n(glm::max(glm::ceil(size / step - 1e-9), dvec3(1)));
    for (int k = 0; k < n.z; ++k) {
        for (int j = 0; j < n.y; ++j) {
            for (int i = 0; i < n.x; ++i) {
                const dvec3 p = box.lo + size * (dvec3(i, j, k) + 0.5) / dvec3(n);
                if (body.value(p) < 0) points.push_back(p);
            }
        }
    }
    return points;
}

GradingSurvey survey_grading(const Grading& grading, const Field& body, Interval limits, int per_side) {
    GradingSurvey survey;
    const std::vector<dvec3> points = points_inside(body, per_side);
    std::vector<double> numbers(points.size());
    grading.numbers(points, numbers);
    for (const double number : numbers) {
        ++survey.points;
        survey.below += number < limits.lo;
        survey.above += number > limits.hi;
        survey.undefined += std::isnan(number);
        if (std::isnan(number)) continue;
        survey.asked = {std::min(survey.asked.lo, number), std::max(survey.asked.hi, number)};
    }
    return survey;
}

}  // namespace lamella
