// The G-code back-end: start, layers and end of a file.
#include "printers/gcode/gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/gcode/gcode_flavour.h"
#include "printers/gcode/gcode_roles.h"
#include "printers/gcode/gcode_script.h"
#include "printers/gcode/gcode_settings.h"
#include "printers/gcode/gcode_text.h"
#include "printers/gcode/gcode_thumbnail.h"
#include "printers/gcode/gcode_travel.h"
#include "printers/gcode/laser_gcode.h"
#include "printers/toolpath/neighbour_layers.h"
#include "printers/toolpath/skirt.h"

namespace lamella {
namespace {

constexpr double prime_strip = 6;     // mm along the bed's edges that are kept clear of the part
constexpr double prime_height = 0.3;  // mm
constexpr double prime_length = 60;   // mm

/// Returns how far brim and skirt reach beyond the part, mm.
double reach_beside(const PrinterProfile& profile, double layer_height) {
    const FilamentProfile& filament = profile.filament;
    return skirt_reach(profile.toolpath, {filament.line_width, layer_height, filament.tolerance});
}

struct GcodeProduct : LayerProduct {
    void serialize(Archive& parcel) override {
        parcel(text, first, last, trail, filament, support_filament, slowed, seconds, islands_left_out);
    }

    std::string text;  ///< from the first bead on; empty for an empty layer
    dvec2 first{0};    ///< start of the first bead on the bed, mm
    dvec2 last{0};
    std::vector<dvec2> trail;     ///< path from the end of the last bead along which the nozzle may be wiped
    double filament = 0;          ///< mm
    double support_filament = 0;  ///< share of supports in `filament`, mm
    double slowed = 0;            ///< length of extrusion slowed down for the rate of lines, mm
    std::vector<double> seconds;  ///< duration of each move
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
        check_range(job, range);
        for (const EqualLayers& layers : job.layers.runs()) check_filament_profile(profile_, layers.height);
        neighbours_.emplace(job, filament_.tolerance);
        supported_ = job.supports != nullptr;
        if (supported_) check_support_speed(profile_.support);
        check_fit(job);
        layers_ = job.layers;
        range_ = range;
        const dvec3 center = job.bounds.center();
        shift_ = dvec2(filament_.bed_x, filament_.bed_y) * 0.5 - dvec2(center.x, center.y);
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
        const auto outlines = neighbours_->outlines(layer.index());
        stop_if_cancelled(layer.cancel());
        const std::vector<Contour>& contours = outlines->part;
        const std::vector<Contour>& supports = outlines->supports;
        for (const Contour& contour : contours) product->area += signed_area(contour.points);
        for (const Contour& contour : supports) product->support_area += signed_area(contour.points);
        // Brim and skirt come first, then supports, because the part rests on them. Supports are always
        // filled completely.
        const std::optional<LayerBelow> footing = this->footing(layer);
        const std::optional<PlacedPolygons> core = this->core(layer);
        const auto pointer = [](const auto& held) { return held ? &*held : nullptr; };
        Toolpaths paths = round(layer, contours, supports);
        append(plan(layer, supports, 1, {pointer(footing), nullptr}), paths, Role::support);
        append(plan(layer, contours, filament_.infill_density, {pointer(footing), pointer(core)}), paths);
        product->islands_left_out = paths.islands_left_out;
        for (Bead& bead : paths.beads) {
            if (bead.role != Role::skirt)
                bead.object = labels_.object_at({bead.points[bead.points.size() / 2], layer.z()});
        }
        if (paths.beads.empty()) {
            product->area = product->support_area = 0;  // sections too small for a bead
        } else {
            lay(paths, layer, *product);
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
        text.line(fan_line(gcode_.flavour, fan(index)));
        if (index > range_.first) change_heat(index, text);
        text.lines(expand_script(layer_script(gcode_), values(index)));
        const bool prints = !product.text.empty();
        const double below = index > range_.first ? layer.bottom() : gcode_.prime_line ? prime_height : 0;
        GcodeMoves moves(profile_, position_, below);
        if (prints) {
            if (moves.retracts()) moves.retract(trail_);
            moves.lift(travel_height(profile_, layer.top(), glm::distance(position_, product.first)));
            moves.travel(product.first);
        }
        moves.lift(layer.top());
        if (prints && moves.retracts()) moves.restore();
        append(moves, text);
        add(product.seconds);
        filament_used_ += product.filament;
        if (prints) {
            position_ = product.last;
            trail_ = product.trail;
        } else {
            trail_.clear();  // the nozzle has left the trail
        }
        support_filament_ += product.support_filament;
        slowed_ += product.slowed;
        islands_left_out_ += product.islands_left_out;
        neighbours_->forget_below(index - profile_.toolpath.bottom_layers);
        output_->commit(text.text() + product.text, index + 1, state());
    }

    void finish() override {
        GcodeText text(profile_);
        const double top = layers_.bottom(range_.last);
        const double parked = std::min(top + 10, std::max(filament_.bed_z, top));
        text.line(";TYPE:Custom");
        GcodeMoves moves(profile_, position_, top);
        if (moves.retracts()) moves.retract(trail_);
        moves.lift(parked);
        moves.travel({0, filament_.bed_y});
        append(moves, text);
        text.lines(expand_script(end_script(gcode_), values(range_.last - 1)));
        text.line(end_progress(gcode_.flavour, range_.last));
        write_facts(text);
        output_->end(text.text());
    }

  private:
    Toolpaths plan(const Layer& layer, const std::vector<Contour>& contours, double density,
                   const LayerNeighborhood& around) const {
        const ToolpathProfile& t = profile_.toolpath;
        return plan_toolpaths(contours, {line(layer), t.walls, density, t.infill, t.seam}, layer.index(),
                              around, layer.cancel());
    }
    /// Returns the layer below; empty for the first layer.
    std::optional<LayerBelow> footing(const Layer& layer) const {
        if (layer.index() == 0) return std::nullopt;
        return neighbours_->footing(layer.index(), filament_.line_width / 4);
    }
    /// Returns the region where infill may be sparse; empty if no solid layers are required.
    std::optional<PlacedPolygons> core(const Layer& layer) const {
        const ToolpathProfile& t = profile_.toolpath;
        if (filament_.infill_density >= 1 || t.top_layers + t.bottom_layers == 0) return std::nullopt;
        return neighbours_->core(layer.index(), t.bottom_layers, t.top_layers);
    }
    LineSettings line(const Layer& layer) const {
        return {filament_.line_width, layer.thickness(), filament_.tolerance};
    }

    /// Returns brim and skirt of the first layer; empty for other layers.
    Toolpaths round(const Layer& layer, const std::vector<Contour>& part,
                    const std::vector<Contour>& supports) const {
        if (layer.index() > 0) return {};
        Polygons standing;
        for (const std::vector<Contour>* contours : {&part, &supports}) {
            for (const Contour& contour : *contours) standing.push_back(to_polygon(contour.points));
        }
        Toolpaths paths;
        paths.beads = skirt_beads(standing, profile_.toolpath, line(layer));
        if (!paths.beads.empty()) paths.outlines.emplace_back();  // empty: travel is not confined
        return paths;
    }

    static void append(Toolpaths added, Toolpaths& paths, std::optional<Role> role = {}) {
        const auto islands = static_cast<int>(paths.outlines.size());
        for (Bead& bead : added.beads) {
            bead.island += islands;
            bead.role = role.value_or(bead.role);
        }
        std::ranges::move(added.beads, std::back_inserter(paths.beads));
        std::ranges::move(added.outlines, std::back_inserter(paths.outlines));
        paths.islands_left_out += added.islands_left_out;
    }

    /// Turns beads into lines. The beads of supports come first.
    void lay(const Toolpaths& paths, const Layer& layer, GcodeProduct& product) const {
        const std::vector<Bead>& beads = paths.beads;
        product.first = beads.front().points.front() + shift_;
        GcodeMoves planned(profile_, product.first, layer.top());
        product.trail = add_beads(paths, profile_, layer.thickness(), layer.index() == 0, shift_, planned,
                                  layer.cancel());
        std::vector<GcodeMove>& moves = planned.moves();
        slow_to_time(moves, product.first, gcode_);
        product.slowed = slow_to_rate(moves, gcode_);
        product.seconds = seconds_of(moves, product.first, gcode_);
        product.last = planned.position();
        GcodeText text(profile_, &labels_);
        text.fan(fan(layer.index()), gcode_.bridge_fan);
        text.moves(moves, product.first, beads);
        product.text = text.text();
        product.filament = text.filament();
        for (const GcodeMove& move : moves) {
            if (move.bead >= 0 && beads[static_cast<std::size_t>(move.bead)].role == Role::support)
                product.support_filament += move.filament;
        }
    }

    double nozzle_temperature(int layer) const {
        const double first = gcode_.first_layer_nozzle_temperature;
        return layer == 0 && first > 0 ? first : filament_.nozzle_temperature;
    }
    double bed_temperature(int layer) const {
        const double first = gcode_.first_layer_bed_temperature;
        return layer == 0 && first > 0 ? first : filament_.bed_temperature;
    }
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
                filament_used_};
    }

    const char* with_what(bool skirted) const {
        if (skirted)
            return supported_ ? "the part with its supports, brim and skirt is"
                              : "the part with its brim and skirt is";
        return supported_ ? "the part with its supports is" : "the part is";
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
        throw InputError(fmt::format(
            "{} {:.3f} x {:.3f} x {:.3f} mm but the bed has room for {:.3f} x {:.3f} x {:.3f} "
            "mm (a strip of {} mm round it is for priming); scale or turn the part, or choose a "
            "larger printer",
            with_what(reach > 0), size.x, size.y, top, available.x, available.y, available.z, prime_strip));
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
        if (gcode_.prime_line) prime(text);
        return text.text();
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
        filament_used_ += text.filament();
    }

    /// Appends moves that begin at the nozzle as lines, and counts their duration.
    void append(GcodeMoves& moves, GcodeText& text) {
        slow_to_rate(moves.moves(), gcode_);
        text.moves(moves.moves(), position_);
        add(seconds_of(moves.moves(), position_, gcode_));
        position_ = moves.position();
    }
    void add(const std::vector<double>& seconds) {
        for (const double s : seconds) {
            seconds_ += s;
            rate_.add(s);
        }
    }

    /// Writes the facts that hosts and previewers look for at the end of a file, and a summary of the job.
    void write_facts(GcodeText& text) const {
        const double section = pi / 4 * filament_.filament * filament_.filament / 1000;  // cm3 per mm
        const double density = profile_.support.density;
        const auto used = [&](const char* what, double filament) {
            text.line(fmt::format("; {} used [mm] = {}", what, format_number(filament, 2)));
            text.line(fmt::format("; {} used [cm3] = {}", what, format_number(filament * section, 3)));
            text.line(
                fmt::format("; {} used [g] = {}", what, format_number(filament * section * density, 2)));
        };
        used("filament", filament_used_);
        if (supported_) used("support material", support_filament_);
        text.line("; filament density [g/cm3] = " + format_number(density, 3));
        text.line("; estimated printing time (normal mode) = " + duration_text(seconds_));
        text.line(fmt::format("; worst segment rate [lines/s] = {} over {} lines",
                              format_number(rate_.worst(), 1), gcode_.planner_blocks));
        if (gcode_.lines_per_second > 0) {
            text.line("; slowed for the segment rate [mm] = " + format_number(slowed_, 1));
        }
        text.line(fmt::format("; total layers count = {}", range_.count()));
        text.line("; layer_height = " + format_number(layers_.greatest_height(), 4));
        text.line(fmt::format("; islands too small for a bead = {}", islands_left_out_));
    }

    nlohmann::ordered_json state() const {
        auto trail = nlohmann::ordered_json::array();
        for (const dvec2 point : trail_) trail.push_back({point.x, point.y});
        return {position_.x,       position_.y, filament_used_, seconds_,       islands_left_out_,
                support_filament_, slowed_,     rate_.worst(),  rate_.recent(), trail};
    }
    void restore(const nlohmann::ordered_json& state) {
        try {
            position_ = {state.at(0).get<double>(), state.at(1).get<double>()};
            filament_used_ = state.at(2).get<double>();
            seconds_ = state.at(3).get<double>();
            islands_left_out_ = whole_number<std::int64_t>(state.at(4));
            support_filament_ = state.at(5).get<double>();
            slowed_ = state.at(6).get<double>();
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
    std::optional<NeighbourLayers> neighbours_;  // set by open
    LayerPlan layers_;
    ObjectLabels labels_;
    LayerRange range_;
    dvec2 shift_{0};  // from part to bed coordinates, mm
    dvec2 position_{0};
    double filament_used_ = 0;     // mm
    double support_filament_ = 0;  // share of supports in it, mm
    double seconds_ = 0;
    double slowed_ = 0;  // mm of extrusion
    RateMeter rate_;
    std::int64_t islands_left_out_ = 0;
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
