// Splits beams level by level, to sample all radii of a level at once.
#include "procedural/foam/tapered_beams.h"

#include <cmath>

namespace lamella {
namespace {

constexpr int max_splits = 4;
constexpr double bend = 0.02;  // share of the radius

/// A radius plus a length.
class GrownRadius : public Grading {
  public:
    GrownRadius(GradingPtr radius, double by) : radius_(std::move(radius)), by_(by) {}
    double at(dvec3 p) const override { return radius_->at(p) + by_; }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        numbers_of(*radius_, points, out, [&](double radius) { return radius + by_; });
    }
    Interval range(const Box& box) const override {
        const Interval radius = radius_->range(box);
        return {radius.lo + by_, radius.hi + by_};
    }

  private:
    GradingPtr radius_;
    double by_;
};

dvec3 along(const Beam& beam, double t) { return beam.a + (beam.b - beam.a) * t; }

}  // namespace

NodeRadius NodeRadius::grown(double by) const {
    if (const auto radius = radius_->constant()) return NodeRadius(*radius + by);
    return {std::make_shared<GrownRadius>(radius_.pointer(), by), largest_ + by};
}

void TaperedBeams::append(std::vector<Beam>& beams) {
    if (ends_.empty()) return;
    if (radius_.constant()) {
        const double radius = radius_.at(ends_.front());
        for (std::size_t i = 0; i < ends_.size(); i += 2)
            beams.push_back({ends_[i], radius, ends_[i + 1], radius});
        ends_.clear();
    } else {
        // Sampling may throw; clear what was added first.
        places_.swap(ends_);
        ends_.clear();
        find_radii();
        parts_.clear();
        for (std::size_t i = 0; i < places_.size(); i += 2)
            parts_.push_back({{places_[i], found_[i], places_[i + 1], found_[i + 1]}, false});
        for (int splits = 0; splits < max_splits; ++splits) {
            if (!split()) break;
        }
        for (const Part& part : parts_) beams.push_back(part.beam);
    }
}

/// Samples the radii at places_.
void TaperedBeams::find_radii() {
    found_.resize(places_.size());
    if (!places_.empty()) radius_.grading().numbers(places_, found_);
}

/// Splits each part whose radius is not linear into halves. Returns false if no part may need another split.
bool TaperedBeams::split() {
    places_.clear();
    for (const auto& [beam, is_straight] : parts_) {
        if (!is_straight)
            places_.insert(places_.end(), {(beam.a + beam.b) * 0.5, along(beam, 0.25), along(beam, 0.75)});
    }
    find_radii();
    halves_.clear();
    std::size_t next = 0;
    for (const auto& [beam, is_straight] : parts_) {
        const auto bends = [&, &part = beam](double t, double found) {
            return std::abs(found - (part.ra + (part.rb - part.ra) * t)) > bend * found;
        };
        if (is_straight) {
            halves_.push_back({beam, true});
            continue;
        }
        const double *const found = found_.data() + next, middle_radius = found[0];
        const dvec3 middle = places_[next];
        next += 3;
        if (bends(0.5, middle_radius) || bends(0.25, found[1]) || bends(0.75, found[2])) {
            halves_.push_back({{beam.a, beam.ra, middle, middle_radius}, false});
            halves_.push_back({{middle, middle_radius, beam.b, beam.rb}, false});
        } else {
            halves_.push_back({beam, true});
        }
    }
    parts_.swap(halves_);
    return next > 0;
}

}  // namespace lamella
