// The G-code back-end: start, layers and end of a file.
#include "printers/gcode/gcode.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/gcode/bead_text.h"
#include "printers/gcode/gcode_flavour.h"
#include "printers/gcode/gcode_heat.h"
#include "printers/gcode/gcode_roles.h"
#include "printers/gcode/gcode_script.h"
#include "printers/gcode/gcode_settings.h"
#include "printers/gcode/gcode_text.h"
#include "printers/gcode/gcode_thumbnail.h"
#include "printers/gcode/gcode_totals.h"
#include "printers/gcode/gcode_travel.h"
#include "printers/gcode/laid_beads.h"
#include "printers/gcode/laser_gcode.h"
#include "printers/gcode/layer_beads.h"
#include "printers/gcode/one_by_one.h"
#include "printers/toolpath/purge_tower.h"
#include "printers/toolpath/skirt.h"

namespace lamella {
namespace {

constexpr double prime_strip = 6;     // mm along the bed's edges that are kept clear of the part
constexpr double prime_height = 0.3;  // mm
constexpr double prime_length = 60;   // mm
constexpr double over_parts = 1;      // mm between the nozzle and parts that it passes

/// Returns how far brim and skirt reach beyond the part, mm.
double reach_beside(const PrinterProfile& profile, double layer_height) {
    const FilamentProfile& filament = profile.filament;
    return skirt_reach(profile.toolpath, {filament.line_width, layer_height, filament.tolerance});
}

struct GcodeProduct : LayerProduct {
    void serialize(Archive& parcel) override { parcel(texts, islands_left_out); }

    std::vector<BeadText> texts;  ///< in printing order
    int islands_left_out = 0;
};

class Gcode : public Backend {
  public:
    Gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output)
        : profile_(profile),
          filament_(profile_.filament),
          gcode_(profile_.gcode),
          output_(std::move(output)),
          rate_(std::max(2, profile.gcode.planner_blocks)) {}
    Gcode(const Gcode&) = delete;
    Gcode& operator=(const Gcode&) = delete;

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range, TakesStacks::yes);
        check_gantry(job, profile_);
        for (const EqualLayers& layers : job.layers.runs()) check_filament_profile(profile_, layers.height);
        beads_.emplace(job, profile_);
        tools_ = tools_of(job);
        tool_ = tools_.front();
        totals_.filament.assign(static_cast<std::size_t>(tools_.back()) + 1, 0);
        supported_ = job.supports != nullptr;
        if (supported_) check_support_speed(profile_.support);
        check_fit(job);
        layers_ = job.layers;
        range_ = range;
        shift_ = bed_shift(job, profile_);
        if (gcode_.label_objects) labels_ = ObjectLabels(job, gcode_.flavour, shift_);
        const std::string supports = supported_ ? fmt::format(" supports {}", profile_.support.speed) : "";
        const int next = output_->begin({job.identity, gcode_settings(profile_) + supports, range}, resume);
        if (const nlohmann::ordered_json state = output_->state(); !state.is_null()) {
            restore(state);
        } else {
            const std::string text = start(job);
            output_->commit(text, next, this->state());
        }
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<GcodeProduct>();
        const LayerPaths paths = beads_->plan(layer, labels_);
        product->islands_left_out = paths.islands_left_out;
        product->texts = bead_texts(paths, layer, {profile_, labels_, shift_, fan(layer.level())});
        if (!product->texts.empty()) {  // else the sections are too small for a bead
            product->area = paths.part_area;
            product->support_area = paths.support_area;
        }
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<GcodeProduct>(); }

    void write(const Layer& layer, LayerProduct& any) override {
        const auto& product = dynamic_cast<GcodeProduct&>(any);
        const int index = layer.index();
        GcodeText text(profile_);
        text.line(";LAYER_CHANGE");
        text.line(";Z:" + format_number(layer.top(), 3));
        text.line(";HEIGHT:" + format_number(layer.thickness(), 3));
        text.line(layer_progress(gcode_.flavour, index, layers_.count()));
        text.line(fan_line(gcode_.flavour, fan(layer.level())));
        if (index > range_.first) change_heat(index, text);
        text.lines(expand_script(layer_script(gcode_), values(index)));
        std::string beads = text.text();
        LaidChoice laid;
        for (const BeadText& next : product.texts) {
            if (!laid.takes(next.tool, next.when, tool_)) continue;
            beads += way_to(next, layer);
            beads += next.text;
            count(next);
        }
        // Where the next part begins with empty layers, the nozzle waits above those that are done.
        if (z_ < layer.top() || (z_ > layer.top() && index == range_.first)) {
            GcodeText rise(profile_);
            GcodeMoves moves(profile_, position_, z_);
            moves.lift(layer.top());
            append(moves, rise);
            beads += rise.text();
            trail_.clear();  // the nozzle has left the trail
        }
        totals_.islands_left_out += product.islands_left_out;
        beads_->forget_below(index);
        output_->commit(beads, index + 1, state());
    }

    void finish() override {
        GcodeText text(profile_);
        const double highest = std::max(z_, highest_done(range_.last));
        const double parked = std::min(highest + 10, std::max(filament_.bed_z, highest));
        text.line(";TYPE:Custom");
        GcodeMoves moves(profile_, position_, z_);
        if (moves.retracts()) moves.retract(trail_);
        moves.lift(parked);
        moves.travel({0, filament_.bed_y});
        append(moves, text);
        for (const int tool : tools_) {
            if (tool != tool_) text.line(heat_line(gcode_.flavour, tool, 0));
        }
        text.lines(expand_script(end_script(gcode_), values(range_.last - 1)));
        text.line(end_progress(gcode_.flavour, range_.last));
        text.lines(facts_text(totals_, profile_, rate_, supported_, range_, layers_.greatest_height()));
        output_->end(text.text());
    }

  private:
    /// Returns the lines from the last bead to the first of these, with a change of tools where they need
    /// one.
    std::string way_to(const BeadText& next, const Layer& layer) {
        GcodeText text(profile_);
        GcodeMoves moves(profile_, position_, z_);
        double way = travel_height(profile_, layer.top(), glm::distance(position_, next.first));
        // The way to the next part leads over those that are done.
        const bool is_over_parts = layer.index() > range_.first && z_ > layer.top();
        if (is_over_parts) way = std::max(way, std::min(z_ + over_parts, filament_.bed_z));
        leave_beads(moves, trail_, way, next.first);
        const auto go_on = [&](GcodeMoves& down) {
            reach_beads(down, layer.top());
            append(down, text);
        };
        if (next.tool == ToolBeads::any || next.tool == tool_) {
            go_on(moves);
        } else {
            append(moves, text);
            change_tool(next.tool, layer.index(), text);
            GcodeMoves down(profile_, position_, moves.z());
            go_on(down);
        }
        return text.text();
    }

    void change_tool(int tool, int layer, GcodeText& text) {
        ScriptValues values = this->values(layer);
        values.previous_tool = std::exchange(tool_, tool);
        values.tool = tool;
        values.nozzle_temperature = nozzle_temperature(layer);
        if (const double standby = tool_profile(profile_, values.previous_tool).standby_temperature;
            standby > 0)
            text.line(heat_line(gcode_.flavour, values.previous_tool, standby));
        text.lines(expand_script(tool_script(gcode_), values));
    }

    void count(const BeadText& laid) {
        add(laid.seconds);
        totals_.filament[static_cast<std::size_t>(tool_)] += laid.filament;
        totals_.support_filament += laid.support_filament;
        totals_.slowed += laid.slowed;
        position_ = laid.last;
        trail_ = laid.trail;
    }

    /// Returns the number of layers below this one that are of the same part, where they are printed one by
    /// one.
    int level(int layer) const { return layer - layers_.first_of_stack(layers_.stack_of(layer)); }
    /// Returns the height of the highest part that is done before a layer, where they are printed one by one,
    /// mm.
    double highest_done(int layer) const {
        double highest = 0;
        for (int stack = 1; layers_.first_of_stack(stack) <= layer && stack <= layers_.stacks(); ++stack)
            highest = std::max(highest, layers_.top(layers_.first_of_stack(stack) - 1));
        return highest;
    }
    double nozzle_temperature(int layer) const {
        return lamella::nozzle_temperature(profile_, tool_, level(layer) == 0);
    }
    double bed_temperature(int layer) const { return lamella::bed_temperature(profile_, level(layer) == 0); }
    /// Sets the temperatures if they differ from those of the layer before, without waiting for them.
    void change_heat(int layer, GcodeText& text) const {
        if (nozzle_temperature(layer) != nozzle_temperature(layer - 1))
            text.line("M104 S" + format_number(nozzle_temperature(layer), 0));
        if (bed_temperature(layer) != bed_temperature(layer - 1))
            text.line("M140 S" + format_number(bed_temperature(layer), 0));
    }
    /// Returns the fan's share of full speed: the first layers must stick, later ones must solidify.
    double fan(int layer) const {
        const int on = layer - gcode_.fan_off_layers + 1;  // number of layers with fan up to this one
        if (on <= 0) return 0;
        return gcode_.fan * std::min(1.0, on / (gcode_.fan_ramp_layers + 1.0));
    }

    ScriptValues values(int layer) const {
        return {layer + 1,
                layers_.count(),
                layers_.top(layer),
                layers_.height(layer),
                nozzle_temperature(layer),
                bed_temperature(layer),
                filament_.nozzle,
                filament_.bed_x,
                filament_.bed_y,
                filament_.bed_z,
                std::accumulate(totals_.filament.begin(), totals_.filament.end(), 0.0),
                tool_,
                tool_};
    }

    std::string with_what(const Job& job, bool skirted) const {
        std::vector<std::string> more;
        if (supported_) more.emplace_back("supports");
        if (job.purge_tower) more.emplace_back("purge tower");
        if (skirted) more.insert(more.end(), {"brim", "skirt"});
        if (more.empty()) return "the part is";
        const std::string last = more.back();
        more.pop_back();
        return fmt::format("the part with its {}{}{} is", fmt::join(more, ", "), more.empty() ? "" : " and ",
                           last);
    }

    void check_fit(const Job& job) const {
        const double reach = reach_beside(profile_, job.layers.height(0));
        const dvec3 size = job.bounds.size() + dvec3(2 * reach, 2 * reach, 0);
        const dvec3 available =
            gcode_build_volume(profile_, job.layers.height(0)) + dvec3(2 * reach, 2 * reach, 0);
        const double top = job.layers.total();
        constexpr double slack = 1e-9;
        if (size.x <= available.x * (1 + slack) && size.y <= available.y * (1 + slack) &&
            top <= available.z * (1 + slack)) {
            return;
        }
        throw InputError(
            fmt::format("{} {:.3f} x {:.3f} x {:.3f} mm but the bed has room for {:.3f} x {:.3f} x {:.3f} "
                        "mm (a strip of {} mm round it is for priming); scale or turn the part, or choose a "
                        "larger printer",
                        with_what(job, reach > 0), size.x, size.y, top, available.x, available.y, available.z,
                        prime_strip));
    }

    /// Returns comments, heating, homing and the priming line.
    std::string start(const Job& job) {
        GcodeText text(profile_);
        text.line("; generated by Lamella " LAMELLA_VERSION);
        text.line("; job: " + comment_text(job.name));
        text.line("; identity: " + comment_text(job.identity));
        text.line("; printer: " + comment_text(profile_.name));
        text.line(fmt::format("; layers {}:{} of {}", range_.first, range_.last, layers_.count()));
        for (const std::string& note : job.notes) text.line("; " + comment_text(note));
        if (gcode_.thumbnails) text.lines(gcode_thumbnails(job.picture));
        text.line(start_progress(gcode_.flavour, layers_.count()));
        text.lines(expand_script(start_script(gcode_), values(range_.first)));
        for (const char* mode : {"G21", "G90", "M83", "M107"}) text.line(mode);
        if (sets_acceleration(gcode_) && has_travel_acceleration(gcode_.flavour))
            text.line(travel_acceleration_line(travel_acceleration(gcode_)));
        text.lines(labels_.definitions());
        select_tool(text);
        if (gcode_.prime_line) prime(text);
        return text.text();
    }

    /// Selects the first tool and begins to heat those that have a nozzle of their own.
    void select_tool(GcodeText& text) const {
        if (tools_.size() == 1 && tool_ == 0) return;
        for (const int tool : tools_) {
            if (tool != tool_ && tool_profile(profile_, tool).standby_temperature > 0)
                text.line(heat_line(gcode_.flavour, tool, tool_profile(profile_, tool).standby_temperature));
        }
        text.line(fmt::format("T{}", tool_));
        text.line("M109 S" + format_number(nozzle_temperature(range_.first), 0));
    }

    void prime(GcodeText& text) {
        text.line(";TYPE:Custom");
        const dvec2 from(10, prime_strip / 2);
        const dvec2 to = from + dvec2(std::min(prime_length, filament_.bed_x - 20), 0);
        const double width = std::max(filament_.line_width, prime_height);
        GcodeMoves moves(profile_, position_, 0);
        moves.travel(from);
        moves.lift(prime_height);
        moves.extrude(straight_pieces(std::vector<dvec2>{from, to}).front(), bead_area(width, prime_height),
                      filament_.first_layer_speed, gcode_.acceleration, -1);
        append(moves, text);
        totals_.filament[static_cast<std::size_t>(tool_)] += text.filament();
    }

    /// Appends moves that begin at the nozzle as lines, and counts their duration.
    void append(GcodeMoves& moves, GcodeText& text) {
        slow_to_rate(moves.moves(), gcode_);
        text.moves(moves.moves(), position_);
        add(seconds_of(moves.moves(), position_, gcode_));
        position_ = moves.position();
        z_ = moves.z();
    }
    void add(const std::vector<double>& seconds) {
        for (const double s : seconds) {
            totals_.seconds += s;
            rate_.add(s);
        }
    }

    nlohmann::ordered_json state() const {
        auto trail = nlohmann::ordered_json::array();
        for (const dvec2 point : trail_) trail.push_back({point.x, point.y});
        return {position_.x,
                position_.y,
                totals_.filament,
                totals_.seconds,
                totals_.islands_left_out,
                totals_.support_filament,
                totals_.slowed,
                rate_.worst(),
                rate_.recent(),
                trail,
                tool_,
                z_};
    }
    void restore(const nlohmann::ordered_json& state) {
        try {
            position_ = {state.at(0).get<double>(), state.at(1).get<double>()};
            const auto used = state.at(2).get<std::vector<double>>();
            const int tool = whole_number<int>(state.at(10));
            if (used.size() != totals_.filament.size() || std::ranges::find(tools_, tool) == tools_.end())
                throw output_->damaged_state();
            totals_.filament = used;
            tool_ = tool;
            z_ = state.at(11).get<double>();
            totals_.seconds = state.at(3).get<double>();
            totals_.islands_left_out = whole_number<std::int64_t>(state.at(4));
            totals_.support_filament = state.at(5).get<double>();
            totals_.slowed = state.at(6).get<double>();
            trail_.clear();
            for (const auto& point : state.at(9))
                trail_.emplace_back(point.at(0).get<double>(), point.at(1).get<double>());
            rate_.restore(state.at(8).get<std::vector<double>>(), state.at(7).get<double>());
        } catch (const nlohmann::json::exception&) {
            throw output_->damaged_state();
        }
    }

    PrinterProfile profile_;
    const FilamentProfile& filament_;
    const GcodeProfile& gcode_;
    std::unique_ptr<GcodeOutput> output_;
    std::optional<LayerBeads> beads_;  // set by open
    LayerPlan layers_;
    ObjectLabels labels_;
    LayerRange range_;
    dvec2 shift_{0};  // from part to bed coordinates, mm
    dvec2 position_{0};
    double z_ = 0;            // of the nozzle over the bed, mm
    std::vector<int> tools_;  // of the job, ascending
    int tool_ = 0;            // in use
    GcodeTotals totals_;
    RateMeter rate_;
    bool supported_ = false;
    std::vector<dvec2> trail_;  // of the last bead, while the nozzle is still there
};

}  // namespace

dvec3 gcode_build_volume(const PrinterProfile& profile, double layer_height) {
    if (profile.gcode.flavour == Flavour::grbl) return laser_build_volume(profile);
    const FilamentProfile& bed = profile.filament;
    const double beside = 2 * (prime_strip + reach_beside(profile, layer_height));
    return {bed.bed_x - beside, bed.bed_y - beside, bed.bed_z};
}

std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, const std::string& path, bool force) {
    return make_gcode(profile, make_gcode_file(path, force));
}

std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output) {
    if (profile.gcode.flavour == Flavour::grbl) return make_laser_gcode(profile, std::move(output));
    return std::make_unique<Gcode>(profile, std::move(output));
}

}  // namespace lamella
