// Writes cuts as lines of G-code.
#include "printers/gcode/laser_gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/common/layer_heights.h"
#include "printers/gcode/gcode_flavour.h"
#include "printers/gcode/gcode_moves.h"
#include "printers/gcode/gcode_script.h"
#include "printers/gcode/gcode_settings.h"
#include "printers/gcode/gcode_text.h"
#include "printers/vector/cut_notes.h"

namespace lamella {
namespace {

/// Returns a comment without the characters on which GRBL acts wherever they stand: other senders than ours
/// may pass comments on.
std::string quiet_comment(const std::string& text) {
    std::string clean = comment_text(text);
    std::ranges::replace_if(
        clean, [](char c) { return c == '!' || c == '~' || c == '?'; }, '.');
    return clean;
}

struct LaserProduct : LayerProduct {
    void serialize(Archive& parcel) override {
        plan.serialize(parcel);
        parcel(text, seconds, length, slowed);
    }

    CutPlan plan;
    std::string text;  ///< empty for an empty layer
    std::vector<double> seconds;
    double length = 0;  ///< cut length, mm
    double slowed = 0;  ///< part of it that was slowed for the rate of lines, mm
};

/// Turns one layer's paths into moves and lines.
class LaserWriter {
  public:
    explicit LaserWriter(const PrinterProfile& profile) : profile_(profile) {}

    void path(const SheetPath& path, dvec2 shift) {
        std::vector<dvec2> points;
        for (const dvec2 p : path.points) add(points, p + shift);
        if (path.closed && !points.empty()) add(points, path.points.front() + shift);
        if (points.size() < 2) return;
        const bool cut = path.purpose == CutPurpose::inner || path.purpose == CutPurpose::outer;
        const LaserProfile& laser = profile_.laser;
        const int passes = cut ? laser.cut_passes : 1;
        for (int pass = 0; pass < passes; ++pass) {
            if (pass == 0 || !path.closed) travel(points.front());
            for (const PathPiece& piece : pieces(points)) {
                GcodeMove move = move_to(GcodeMove::Kind::extrude, piece.to, piece.length,
                                         cut ? laser.cut_speed : laser.engrave_speed);
                move.turn = piece.turn;
                move.center = piece.center;
                move.bead = cut ? cutting : engraving;
                moves_.push_back(move);
            }
        }
    }
    std::vector<GcodeMove>& moves() { return moves_; }

    /// Returns the lines of all moves, with the beam off during travel.
    std::string text() const {
        std::string text = laser_on_line(profile_.laser) + "\n";
        dvec2 from{0};
        double speed = 0, power = 0;
        for (const GcodeMove& move : moves_) {
            const bool beam = move.kind == GcodeMove::Kind::extrude;
            text += !beam ? "G0" : move.turn == 0 ? "G1" : move.turn > 0 ? "G3" : "G2";
            word(text, 'X', move.to.x, 3);
            word(text, 'Y', move.to.y, 3);
            if (beam && move.turn != 0) {
                word(text, 'I', move.center.x - std::round(from.x * 1000) / 1000, 3);
                word(text, 'J', move.center.y - std::round(from.y * 1000) / 1000, 3);
            }
            if (const double wanted = power_of(move); wanted != power || !beam)
                word(text, 'S', power = wanted, 0);
            if (beam && move.speed != speed) word(text, 'F', (speed = move.speed) * 60, 0);
            text += '\n';
            from = move.to;
        }
        return text + "M5\n";
    }

  private:
    static constexpr int cutting = 0, engraving = 1;  // GcodeMove::bead

    static void add(std::vector<dvec2>& points, dvec2 p) {
        constexpr double shortest = 0.002;  // mm; shorter pieces vanish when coordinates are rounded
        if (points.empty() || glm::distance(points.back(), p) >= shortest) points.push_back(p);
    }
    static void word(std::string& text, char letter, double value, int decimals) {
        (text += ' ') += letter;
        append_number(text, value, decimals);
    }
    GcodeMove move_to(GcodeMove::Kind kind, dvec2 to, double length, double speed) const {
        GcodeMove move{kind};
        move.to = to;
        move.length = length;
        move.speed = speed;
        move.acceleration = profile_.gcode.acceleration;
        return move;
    }
    void travel(dvec2 to) {
        const dvec2 from = moves_.empty() ? dvec2(0) : moves_.back().to;
        moves_.push_back(
            move_to(GcodeMove::Kind::travel, to, glm::distance(from, to), profile_.filament.travel_speed));
    }
    std::vector<PathPiece> pieces(const std::vector<dvec2>& points) const {
        constexpr double word_unit = 0.001;  // mm; last decimal of a word
        const double tolerance = profile_.vector.tolerance;
        const bool merge = profile_.gcode.lines_per_second > 0;
        if (profile_.gcode.arcs) return arc_pieces(points, tolerance, merge, word_unit);
        return merge ? merged_pieces(points, tolerance) : straight_pieces(points);
    }
    double power_of(const GcodeMove& move) const {
        if (move.kind != GcodeMove::Kind::extrude) return 0;
        const LaserProfile& laser = profile_.laser;
        return std::round((move.bead == cutting ? laser.cut_power : laser.engrave_power) * laser.power_steps);
    }

    const PrinterProfile& profile_;
    std::vector<GcodeMove> moves_;
};

class LaserGcode : public Backend {
  public:
    LaserGcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output)
        : profile_(profile),
          gcode_(profile_.gcode),
          output_(std::move(output)),
          rate_(std::max(2, profile.gcode.planner_blocks)) {}
    LaserGcode(const LaserGcode&) = delete;
    LaserGcode& operator=(const LaserGcode&) = delete;

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check_laser_profile(profile_);
        check_able(job);
        check_layer_heights(LayerHeights::equal, job.layers, range, "a sheet of material");
        job_ = job;
        range_ = range;
        shift_ = dvec2(cut_allowance(profile_.cutting)) - dvec2(job.bounds.lo.x, job.bounds.lo.y);
        const int next = output_->begin({job.identity, settings(), range}, resume);
        if (const nlohmann::ordered_json state = output_->state(); !state.is_null()) {
            restore(state);
        } else {
            output_->commit(start(), next, this->state());
        }
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<LaserProduct>();
        product->plan = plan_cuts(job_, layer, profile_.cutting, profile_.vector.tolerance);
        product->area = product->plan.area;
        LaserWriter writer(profile_);
        for (const SheetPath& path : product->plan.paths) writer.path(path, shift_);
        std::vector<GcodeMove>& moves = writer.moves();
        if (moves.empty()) return product;
        product->slowed = slow_to_rate(moves, gcode_);
        product->seconds = seconds_of(moves, dvec2(0), gcode_);
        for (const GcodeMove& move : moves) {
            if (move.kind == GcodeMove::Kind::extrude) product->length += move.length;
        }
        product->text = writer.text();
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<LaserProduct>(); }

    void write(const Layer& layer, LayerProduct& any) override {
        const auto& product = dynamic_cast<LaserProduct&>(any);
        notes_.count(layer.index(), product.plan, profile_.cutting);
        std::string text = fmt::format(";LAYER:{}\n;Z:{}\n", layer.index(), format_number(layer.top(), 3));
        if (!product.text.empty()) {
            // The first sheet is already in place.
            if (sections_ > 0 || !gcode_.layer_script.empty())
                text += expand_script(layer_script(gcode_), values(layer.index()));
            text += product.text + "G0 X0 Y0\n";
            ++sections_;
        }
        for (const double s : product.seconds) {
            seconds_ += s;
            rate_.add(s);
        }
        length_ += product.length;
        slowed_ += product.slowed;
        output_->commit(text, layer.index() + 1, state());
    }

    void finish() override {
        std::string text = "M5\n";
        text += expand_script(end_script(gcode_), values(range_.last - 1));
        const auto fact = [&](const char* name, const std::string& value) {
            text += fmt::format("; {} = {}\n", name, value);
        };
        fact("length cut [mm]", format_number(length_, 1));
        fact("estimated time", duration_text(seconds_));
        fact("worst segment rate [lines/s]",
             fmt::format("{} over {} lines", format_number(rate_.worst(), 1), gcode_.planner_blocks));
        if (gcode_.lines_per_second > 0) fact("slowed for the segment rate [mm]", format_number(slowed_, 1));
        fact("sheets", std::to_string(sections_));
        output_->end(text);
    }

    std::vector<std::string> notes() const override { return notes_.texts(profile_.cutting); }

  private:
    void check_able(const Job& job) const {
        if (job.supports) {
            throw InputError(
                "a laser prints no supports; accepted: support.kind = \"none\", or another flavour than "
                "grbl");
        }
        if (!profile_.cutting.sheet.empty()) {
            throw InputError(
                "printer.sheet: under grbl each layer is a sheet of its own; accepted: no sheet, or the "
                "back-ends svg and dxf");
        }
        const double more = 2 * cut_allowance(profile_.cutting);
        const dvec3 size = job.bounds.size();
        const FilamentProfile& bed = profile_.filament;
        const dvec3 available = laser_build_volume(profile_);
        constexpr double slack = 1e-9;
        if (size.x <= available.x + bed.bed_x * slack && size.y <= available.y + bed.bed_y * slack) return;
        throw InputError(fmt::format(
            "the part with its kerf is {:.3f} x {:.3f} mm but the bed has {:.3f} x {:.3f} mm; scale or "
            "turn the part, or choose a larger machine (bed_x, bed_y)",
            size.x + more, size.y + more, bed.bed_x, bed.bed_y));
    }

    std::string settings() const {
        const LaserProfile& l = profile_.laser;
        const CuttingProfile& c = profile_.cutting;
        return gcode_settings(profile_) +
               fmt::format(" laser {} {} {} {} {} {} {} cut {} {} {} {} {} {} {}", l.cut_power,
                           l.engrave_power, l.cut_speed, l.engrave_speed, l.power_steps, l.dynamic_power,
                           l.cut_passes, c.kerf, static_cast<int>(c.ties), c.tie_width, c.numbers,
                           c.number_height, c.next_outline, profile_.vector.tolerance);
    }

    std::string start() const {
        std::string text;
        for (const std::string& comment :
             {std::string("generated by Lamella " LAMELLA_VERSION), "job: " + quiet_comment(job_.name),
              "identity: " + quiet_comment(job_.identity), "printer: " + quiet_comment(profile_.name),
              fmt::format("layers {}:{} of {}", range_.first, range_.last, job_.layers.count())}) {
            text += "; " + comment + "\n";
        }
        for (const std::string& note : job_.notes) text += "; " + quiet_comment(note) + "\n";
        text += expand_script(start_script(gcode_), values(range_.first));
        for (const char* mode : {"G21", "G90", "G94", "G17", "M5"}) (text += mode) += '\n';
        return text;
    }

    ScriptValues values(int layer) const {
        ScriptValues v;
        v.layer = layer + 1;
        v.layers = job_.layers.count();
        v.z = job_.layers.top(layer);
        v.height = job_.layers.height(layer);
        v.bed_x = profile_.filament.bed_x;
        v.bed_y = profile_.filament.bed_y;
        v.bed_z = profile_.filament.bed_z;
        return v;
    }

    nlohmann::ordered_json state() const {
        return {sections_, seconds_, length_, slowed_, rate_.worst(), rate_.recent()};
    }
    void restore(const nlohmann::ordered_json& state) {
        try {
            sections_ = whole_number<int>(state.at(0));
            seconds_ = state.at(1).get<double>();
            length_ = state.at(2).get<double>();
            slowed_ = state.at(3).get<double>();
            rate_.restore(state.at(5).get<std::vector<double>>(), state.at(4).get<double>());
        } catch (const nlohmann::json::exception&) {
            throw output_->damaged_state();
        }
    }

    PrinterProfile profile_;
    const GcodeProfile& gcode_;
    std::unique_ptr<GcodeOutput> output_;
    Job job_;
    LayerRange range_;
    dvec2 shift_{0};  // from part to bed coordinates, mm
    CutNotes notes_;
    int sections_ = 0;
    double seconds_ = 0;
    double length_ = 0;  // mm
    double slowed_ = 0;  // mm
    RateMeter rate_;
};

}  // namespace

dvec3 laser_build_volume(const PrinterProfile& profile) {
    const double beside = 2 * cut_allowance(profile.cutting);
    return {profile.filament.bed_x - beside, profile.filament.bed_y - beside, infinity};
}

std::unique_ptr<Backend> make_laser_gcode(const PrinterProfile& profile,
                                          std::unique_ptr<GcodeOutput> output) {
    return std::make_unique<LaserGcode>(profile, std::move(output));
}

}  // namespace lamella
