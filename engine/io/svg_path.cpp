// A reader of commands, and chords of curves.
#include "engine/io/svg_path.h"

#include <charconv>
#include <cmath>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/text.h"

namespace lamella {

namespace {

constexpr int most_chords = 1000;  // of a curve

/// Returns into how many chords an arc of this angle (radians) is cut.
int chords_of(double radius, double angle, double tolerance) {
    // A chord over the angle a deviates by r (1 - cos(a / 2)), nearly r a^2 / 8.
    const double step = std::sqrt(8 * tolerance / std::max(radius, 1e-300));
    return static_cast<int>(std::clamp(std::ceil(std::abs(angle) / step), 3.0, double{most_chords}));
}

class PathReader {
  public:
    PathReader(std::string_view data, double tolerance, const std::string& where)
        : data_(data), tolerance_(tolerance), where_(where) {}

    std::vector<SvgSubpath> read() {
        skip_separators();
        if (at_ < data_.size() && data_[at_] != 'M' && data_[at_] != 'm') refuse("does not begin with M");
        for (char command = 0; skip_separators(), at_ < data_.size();) {
            if (is_command(data_[at_])) {
                command = data_[at_++];
            } else if (command == 0 || command == 'z' || command == 'Z') {
                refuse("has " + excerpt(data_.substr(at_, 12)) + " where a command belongs");
            }
            run(command);
            // Further pairs after M are lines.
            if (command == 'M') command = 'L';
            if (command == 'm') command = 'l';
        }
        end_subpath(false);
        return std::move(found_);
    }

  private:
    static bool is_command(char c) {
        return std::string_view("MmZzLlHhVvCcSsQqTtAa").find(c) != std::string_view::npos;
    }
    [[noreturn]] void refuse(const std::string& wrong) const {
        throw InputError(where_ + ": the path " + wrong +
                         "; accepted: SVG path data such as M 0 0 L 5 0 L 0 5 Z");
    }
    void skip_separators() {
        while (at_ < data_.size() && (is_space(data_[at_]) || data_[at_] == ',')) ++at_;
    }
    double number() {
        skip_separators();
        if (at_ < data_.size() && data_[at_] == '+') ++at_;
        double value = 0;
        const char* const begin = data_.data() + at_;
        const auto [end, error] = std::from_chars(begin, data_.data() + data_.size(), value);
        if (error != std::errc() || !(std::abs(value) < 1e9))
            refuse("has " + excerpt(data_.substr(at_, 12)) + " where a number below 1e9 belongs");
        at_ += static_cast<std::size_t>(end - begin);
        return value;
    }
    bool flag() {
        skip_separators();
        if (at_ >= data_.size() || (data_[at_] != '0' && data_[at_] != '1')) refuse("lacks a flag of an arc");
        return data_[at_++] == '1';
    }
    dvec2 point(bool is_relative) {
        const double x = number(), y = number();
        return dvec2(x, y) + (is_relative ? now_ : dvec2(0));
    }
    void add(dvec2 p) {
        if (points_.empty()) points_.push_back(now_);
        if (++count_ > most_svg_points) refuse("has more than a million points");
        points_.push_back(p);
        now_ = p;
    }
    void end_subpath(bool is_closed) {
        const bool returns = points_.size() > 1 && points_.front() == points_.back();
        if (returns) points_.pop_back();
        if (points_.size() > 1) found_.push_back({std::move(points_), is_closed || returns});
        points_.clear();
    }
    void cubic(dvec2 a, dvec2 b, dvec2 end);
    void quadratic(dvec2 control, dvec2 end) {
        const dvec2 begin = now_;
        cubic(begin + 2.0 / 3 * (control - begin), end + 2.0 / 3 * (control - end), end);
    }
    void arc(dvec2 radii, double rotation, bool is_large, bool is_positive, dvec2 end);
    void run(char command);

    std::string_view data_;
    double tolerance_;
    const std::string& where_;
    std::size_t at_ = 0, count_ = 0;
    dvec2 now_{0}, begin_{0};
    dvec2 reflected_cubic_{0}, reflected_quadratic_{0};  ///< the control point that S and T mirror
    std::vector<dvec2> points_;
    std::vector<SvgSubpath> found_;
};

void PathReader::cubic(dvec2 a, dvec2 b, dvec2 end) {
    const dvec2 begin = now_;
    // The second derivative is at most 6 times the larger of these; a chord over t deviates by t^2 / 8 of it.
    const double bend = 6 * std::max(length(begin - 2.0 * a + b), length(a - 2.0 * b + end));
    const double chords = std::clamp(std::ceil(std::sqrt(bend / (8 * tolerance_))), 1.0, double{most_chords});
    for (int k = 1; k < static_cast<int>(chords); ++k) {
        const double t = k / chords, s = 1 - t;
        add(s * s * s * begin + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * end);
    }
    add(end);
}

/// From endpoints to the centre (appendix B.2.4 of that standard).
void PathReader::arc(dvec2 radii, double rotation, bool is_large, bool is_positive, dvec2 end) {
    const dvec2 begin = now_;
    radii = glm::abs(radii);
    if (begin == end) return;
    if (radii.x == 0 || radii.y == 0) return add(end);
    const SineCosine turn = sine_cosine(rotation * pi / 180);
    const auto to_frame = [&](dvec2 p) {
        return dvec2(turn.cosine * p.x + turn.sine * p.y, turn.cosine * p.y - turn.sine * p.x);
    };
    const auto from_frame = [&](dvec2 p) {
        return dvec2(turn.cosine * p.x - turn.sine * p.y, turn.cosine * p.y + turn.sine * p.x);
    };
    // In the frame in which the ellipse is the unit circle.
    dvec2 half = to_frame(0.5 * (begin - end)) / radii;
    const double grow = length(half);
    if (grow > 1) {
        radii *= grow;
        half /= grow;
    }
    const double off = std::sqrt(std::max(1 / squared_length(half) - 1, 0.0));
    const dvec2 centre = (is_large == is_positive ? -1.0 : 1.0) * off * dvec2(half.y, -half.x);
    const dvec2 from = half - centre, to = -half - centre;
    double sweep = arctangent2(cross(from, to), dot(from, to));
    if (is_positive && sweep < 0) sweep += 2 * pi;
    if (!is_positive && sweep > 0) sweep -= 2 * pi;
    const dvec2 middle = 0.5 * (begin + end) + from_frame(radii * centre);
    const int chords = chords_of(std::max(radii.x, radii.y), sweep, tolerance_);
    for (int k = 1; k < chords; ++k) {
        const SineCosine by = sine_cosine(sweep * k / chords);
        const dvec2 on_circle(by.cosine * from.x - by.sine * from.y, by.sine * from.x + by.cosine * from.y);
        add(middle + from_frame(radii * on_circle));
    }
    add(end);
}

/// Runs a command with its first set of numbers.
void PathReader::run(char command) {
    const bool is_relative = command >= 'a';
    const auto mirror = [&](dvec2 control) { return 2.0 * now_ - control; };
    switch (is_relative ? command - 'a' + 'A' : command) {
        case 'M':
            end_subpath(false);
            now_ = begin_ = point(is_relative);
            break;
        case 'Z':
            end_subpath(true);
            now_ = begin_;
            break;
        case 'L':
            add(point(is_relative));
            break;
        case 'H':
            add({number() + (is_relative ? now_.x : 0), now_.y});
            break;
        case 'V':
            add({now_.x, number() + (is_relative ? now_.y : 0)});
            break;
        case 'C':
        case 'S': {
            const bool is_smooth = command == 'S' || command == 's';
            const dvec2 a = is_smooth ? reflected_cubic_ : point(is_relative);
            const dvec2 b = point(is_relative), end = point(is_relative);
            cubic(a, b, end);
            reflected_cubic_ = mirror(b);
            reflected_quadratic_ = now_;
            return;
        }
        case 'Q':
        case 'T': {
            const bool is_smooth = command == 'T' || command == 't';
            const dvec2 control = is_smooth ? reflected_quadratic_ : point(is_relative);
            quadratic(control, point(is_relative));
            reflected_quadratic_ = mirror(control);
            reflected_cubic_ = now_;
            return;
        }
        default: {
            const double rx = number(), ry = number(), rotation = number();
            const bool is_large = flag(), is_positive = flag();
            arc({rx, ry}, rotation, is_large, is_positive, point(is_relative));
            break;
        }
    }
    reflected_cubic_ = reflected_quadratic_ = now_;
}

}  // namespace

std::vector<SvgSubpath> flattened_path(std::string_view data, double tolerance, const std::string& where) {
    return PathReader(data, tolerance, where).read();
}

std::vector<dvec2> flattened_ellipse(dvec2 centre, dvec2 radii, double tolerance) {
    const int chords = chords_of(std::max(radii.x, radii.y), 2 * pi, tolerance);
    std::vector<dvec2> points;
    for (int k = 0; k < chords; ++k) {
        const SineCosine by = sine_cosine(2 * pi * k / chords);
        points.push_back(centre + radii * dvec2(by.cosine, by.sine));
    }
    return points;
}

}  // namespace lamella
