// The G-code file: start, layers, end.
#include "printers/gcode.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/error.h"
#include "engine/number_format.h"
#include "printers/gcode_text.h"
#include "printers/toolpath.h"

namespace lamella {
namespace {

constexpr double prime_strip = 6;      // mm along the bed's edges that stay free of the part
constexpr double prime_height = 0.3;   // mm
constexpr double prime_length = 60;    // mm
constexpr double retract_between = 2;  // mm of travel between islands that oozing may not spoil
constexpr double retract_within = 10;  // mm of travel over the island itself

struct GcodeProduct : LayerProduct {
    std::string text;  ///< from the first bead on; empty for an empty layer
    dvec2 first{0};    ///< on the bed, mm
    dvec2 last{0};
    GcodeUse use;
    double support_filament = 0;  ///< of `use`, mm
    int islands_left_out = 0;
};

const char* role_name(Role role) {
    switch (role) {
        case Role::external_perimeter:
            return "External perimeter";
        case Role::perimeter:
            return "Perimeter";
        case Role::internal_infill:
            return "Internal infill";
        case Role::solid_infill:
            return "Solid infill";
        case Role::gap_fill:
            return "Gap fill";
        case Role::skirt:
            return "Skirt/Brim";
        case Role::support:
            return "Support material";
    }
    return "Custom";
}

/// What goes into a comment: printable ASCII, and not too much of it.
std::string comment_text(const std::string& text) {
    constexpr std::size_t most = 64;
    std::string clean;
    for (const char c : text.substr(0, most)) clean += ' ' <= c && c <= '~' ? c : '?';
    return clean;
}

std::string duration(double seconds) {
    const auto s = static_cast<std::int64_t>(std::min(seconds, 1e12));
    if (s >= 86400) return fmt::format("{}d {}h {}m {}s", s / 86400, s / 3600 % 24, s / 60 % 60, s % 60);
    if (s >= 3600) return fmt::format("{}h {}m {}s", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}m {}s", s / 60, s % 60);
}

/// Writes the beads of a layer, each change of role or width announced.
class BeadWriter {
  public:
    BeadWriter(const PrinterProfile& profile, double height, bool first_layer, dvec2 shift)
        : text_(profile.filament),
          height_(height),
          speed_(first_layer ? profile.filament.first_layer_speed : profile.filament.print_speed),
          support_speed_(first_layer ? profile.filament.first_layer_speed : profile.support.speed),
          shift_(shift) {}

    void bead(const Bead& bead) {
        const dvec2 start = bead.points.front() + shift_;
        if (island_ < 0) {
            text_.start_at(start);
        } else {
            const dvec2 way = start - text_.position();
            const double limit = bead.island == island_ ? retract_within : retract_between;
            text_.travel(start, way.x * way.x + way.y * way.y > limit * limit);
        }
        island_ = bead.island;
        announce(bead);
        const double speed = bead.role == Role::support ? support_speed_ : speed_;
        const std::size_t n = bead.points.size();
        for (std::size_t i = 1; i < n + (bead.closed ? 1 : 0); ++i) {
            const double area =
                (bead_area(bead.width_at(i - 1), height_) + bead_area(bead.width_at(i % n), height_)) / 2;
            to(bead.points[i % n], area * bead.flow, speed);
        }
    }
    const GcodeText& text() const { return text_; }

  private:
    void to(dvec2 point, double area, double speed) {
        point += shift_;
        const dvec2 way = point - text_.position();
        constexpr double shortest = 0.002;  // mm; shorter ones would vanish in the rounding of the words
        if (way.x * way.x + way.y * way.y >= shortest * shortest) text_.extrude(point, area, speed);
    }
    void announce(const Bead& bead) {
        if (!announced_ || bead.role != role_) text_.line(std::string(";TYPE:") + role_name(bead.role));
        const std::string width = format_number(bead.width, 3);
        if (width != width_) text_.line(";WIDTH:" + width);
        announced_ = true;
        role_ = bead.role;
        width_ = width;
    }

    GcodeText text_;
    double height_;
    double speed_;
    double support_speed_;
    dvec2 shift_;
    int island_ = -1;
    bool announced_ = false;
    Role role_ = Role::external_perimeter;
    std::string width_;
};

class Gcode : public Backend {
  public:
    Gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output)
        : profile_(profile), filament_(profile_.filament), output_(std::move(output)) {}
    Gcode(const Gcode&) = delete;
    Gcode& operator=(const Gcode&) = delete;

    int begin(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check_filament_profile(filament_, job.layer_height);
        supported_ = job.supports != nullptr;
        if (supported_) check_support_speed(profile_.support);
        check_fit(job);
        height_ = job.layer_height;
        layer_count_ = job.layer_count;
        range_ = range;
        const dvec3 center = job.bounds.center();
        shift_ = dvec2(filament_.bed_x, filament_.bed_y) * 0.5 - dvec2(center.x, center.y);
        const int next = output_->begin({job.identity, settings(), range}, resume);
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
        const std::vector<Contour> contours = layer.contours(filament_.tolerance);
        const std::vector<Contour> supports = layer.support_contours(filament_.tolerance);
        for (const Contour& contour : contours) product->area += signed_area(contour.points);
        for (const Contour& contour : supports) product->support_area += signed_area(contour.points);
        // Supports first: the part comes to rest on them. They are filled whatever the part is.
        Toolpaths under = plan(layer, supports, 1);
        Toolpaths paths = plan(layer, contours, filament_.infill_density);
        for (Bead& bead : under.beads) bead.role = Role::support;
        for (Bead& bead : paths.beads) bead.island += under.islands;
        product->islands_left_out = under.islands_left_out + paths.islands_left_out;
        if (under.beads.empty() && paths.beads.empty()) return product;
        BeadWriter writer(profile_, height_, layer.index() == 0, shift_);
        for (const Bead& bead : under.beads) writer.bead(bead);
        product->support_filament = writer.text().use().filament;
        for (const Bead& bead : paths.beads) writer.bead(bead);
        const Bead& first = under.beads.empty() ? paths.beads.front() : under.beads.front();
        product->text = writer.text().text();
        product->first = first.points.front() + shift_;
        product->last = writer.text().position();
        product->use = writer.text().use();
        return product;
    }

    void write(const Layer& layer, LayerProduct& any) override {
        const auto& product = dynamic_cast<GcodeProduct&>(any);
        GcodeText text(filament_);
        text.start_at(position_);
        text.line(";LAYER_CHANGE");
        text.line(";Z:" + format_number(layer.top(), 3));
        text.line(";HEIGHT:" + format_number(height_, 3));
        text.line(fmt::format("M73 P{}", 100LL * layer.index() / layer_count_));
        // The first layer has to stick, later ones to set.
        text.line(layer.index() == 0 ? "M107" : "M106 S255");
        const bool moves = !product.text.empty();
        const bool retract = moves && text.retracts();
        if (retract) text.retract(false);
        text.travel_z(layer.top());
        if (moves) text.travel(product.first, false);
        if (retract) text.retract(true);
        add(text.use());
        add(product.use);
        if (moves) position_ = product.last;
        support_filament_ += product.support_filament;
        islands_left_out_ += product.islands_left_out;
        output_->commit(text.text() + product.text, layer.index() + 1, state());
    }

    void end() override {
        GcodeText text(filament_);
        text.start_at(position_);
        const double top = range_.last * height_;
        text.line(";TYPE:Custom");
        if (text.retracts()) text.retract(false);
        text.travel_z(std::min(top + 10, std::max(filament_.bed_z, top)));
        text.travel({0, filament_.bed_y}, false);
        for (const char* off : {"M104 S0", "M140 S0", "M107", "M84", "M73 P100"}) text.line(off);
        constexpr double pi = 3.14159265358979323846;
        const double section = pi / 4 * filament_.filament * filament_.filament;
        text.line("; filament used [mm] = " + format_number(use_.filament, 2));
        text.line("; filament used [cm3] = " + format_number(use_.filament * section / 1000, 3));
        if (supported_) {
            text.line("; support material used [mm] = " + format_number(support_filament_, 2));
            text.line("; support material used [cm3] = " +
                      format_number(support_filament_ * section / 1000, 3));
        }
        text.line("; estimated printing time (normal mode) = " + duration(use_.seconds));
        text.line(fmt::format("; total layers count = {}", range_.count()));
        text.line("; layer_height = " + format_number(height_, 4));
        text.line(fmt::format("; islands too small for a bead = {}", islands_left_out_));
        output_->end(text.text());
    }

  private:
    Toolpaths plan(const Layer& layer, const std::vector<Contour>& contours, double density) const {
        return plan_toolpaths(contours, {{filament_.line_width, height_, filament_.tolerance}, 1, density},
                              layer.index());
    }

    void check_fit(const Job& job) const {
        const dvec3 size = job.bounds.size();
        const double room_x = filament_.bed_x - 2 * prime_strip;
        const double room_y = filament_.bed_y - 2 * prime_strip;
        const double top = job.layer_count * job.layer_height;
        constexpr double slack = 1e-9;
        if (size.x <= room_x * (1 + slack) && size.y <= room_y * (1 + slack) &&
            top <= filament_.bed_z * (1 + slack)) {
            return;
        }
        throw InputError(
            fmt::format("{} {:.3f} x {:.3f} x {:.3f} mm but the bed has room for {:.3f} x {:.3f} x {:.3f} "
                        "mm (a strip of {} mm round it is for priming); scale or turn the part, or choose a "
                        "larger printer",
                        supported_ ? "the part with its supports is" : "the part is", size.x, size.y, top,
                        room_x, room_y, filament_.bed_z, prime_strip));
    }

    std::string settings() const {
        const FilamentProfile& f = filament_;
        const std::string supports = supported_ ? fmt::format(" supports {}", profile_.support.speed) : "";
        return fmt::format("marlin {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}{}", f.bed_x, f.bed_y, f.bed_z,
                           f.nozzle, f.filament, f.line_width, f.infill_density, f.nozzle_temperature,
                           f.bed_temperature, f.print_speed, f.first_layer_speed, f.travel_speed,
                           f.retraction, f.retraction_speed, f.tolerance, supports);
    }

    /// Comments, heating, homing and a line that fills the nozzle.
    std::string start(const Job& job) {
        GcodeText text(filament_);
        text.line("; generated by Lamella " LAMELLA_VERSION);
        text.line("; job: " + comment_text(job.name));
        text.line("; identity: " + comment_text(job.identity));
        text.line("; printer: " + comment_text(profile_.name));
        text.line(fmt::format("; layers {}:{} of {}", range_.first, range_.last, layer_count_));
        text.line("M73 P0");
        const std::string bed = format_number(filament_.bed_temperature, 0);
        const std::string nozzle = format_number(filament_.nozzle_temperature, 0);
        text.line("M140 S" + bed);
        text.line("M104 S" + nozzle);
        text.line("G28");
        text.line("M190 S" + bed);
        text.line("M109 S" + nozzle);
        for (const char* mode : {"G21", "G90", "M83", "M107"}) text.line(mode);
        text.line(";TYPE:Custom");
        const double length = std::min(prime_length, filament_.bed_x - 20);
        const double width = std::max(filament_.line_width, prime_height);
        text.travel({10, prime_strip / 2}, false);
        text.travel_z(prime_height);
        text.extrude({10 + length, prime_strip / 2}, bead_area(width, prime_height),
                     filament_.first_layer_speed);
        position_ = text.position();
        add(text.use());
        return text.text();
    }

    void add(const GcodeUse& use) {
        use_.filament += use.filament;
        use_.seconds += use.seconds;
    }

    nlohmann::ordered_json state() const {
        return {position_.x, position_.y, use_.filament, use_.seconds, islands_left_out_, support_filament_};
    }
    void restore(const nlohmann::ordered_json& state) {
        try {
            position_ = {state.at(0).get<double>(), state.at(1).get<double>()};
            use_ = {state.at(2).get<double>(), state.at(3).get<double>()};
            islands_left_out_ = state.at(4).get<std::int64_t>();
            support_filament_ = state.at(5).get<double>();
        } catch (const nlohmann::json::exception&) {
            throw output_->damaged_state();
        }
    }

    PrinterProfile profile_;
    const FilamentProfile& filament_;
    std::unique_ptr<GcodeOutput> output_;
    double height_ = 0;
    int layer_count_ = 0;
    LayerRange range_;
    dvec2 shift_{0};  // from part to bed coordinates, mm
    dvec2 position_{0};
    GcodeUse use_;
    double support_filament_ = 0;  // of use_, mm
    std::int64_t islands_left_out_ = 0;
    bool supported_ = false;
};

}  // namespace

std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, const std::string& path, bool force) {
    return make_gcode(profile, make_gcode_file(path, force));
}

std::unique_ptr<Backend> make_gcode(const PrinterProfile& profile, std::unique_ptr<GcodeOutput> output) {
    return std::make_unique<Gcode>(profile, std::move(output));
}

}  // namespace lamella
