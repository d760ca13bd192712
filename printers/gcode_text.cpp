// Words, moves and their costs.
#include "printers/gcode_text.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/error.h"
#include "engine/number_format.h"

namespace lamella {
namespace {

constexpr double z_speed = 10;  // mm/s; screws are slow

double distance(dvec2 a, dvec2 b) {
    const dvec2 d = b - a;
    return std::sqrt(d.x * d.x + d.y * d.y);
}

constexpr double slowest = 0.1;  // mm/s
constexpr double fastest = 2000;

void check(const char* key, double value, double lo, double hi) {
    if (!(value >= lo && value <= hi)) {
        throw InputError(fmt::format("{} = {}: must be {} to {}", key, value, lo, hi));
    }
}

}  // namespace

void GcodeText::word(char letter, double value, int decimals) {
    text_ += ' ';
    text_ += letter;
    append_number(text_, value, decimals);
}

void GcodeText::speed(double mm_per_second) {
    if (mm_per_second == speed_) return;
    speed_ = mm_per_second;
    word('F', mm_per_second * 60, 0);
}

void GcodeText::retract(bool forward) {
    text_ += "G1";
    word('E', forward ? profile_.retraction : -profile_.retraction, 5);
    speed(profile_.retraction_speed);
    text_ += '\n';
    use_.seconds += profile_.retraction / profile_.retraction_speed;
}

void GcodeText::travel(dvec2 to, bool retracted) {
    retracted = retracted && retracts();
    if (retracted) retract(false);
    text_ += "G0";
    word('X', to.x, 3);
    word('Y', to.y, 3);
    speed(profile_.travel_speed);
    text_ += '\n';
    if (retracted) retract(true);
    use_.seconds += distance(position_, to) / profile_.travel_speed;
    position_ = to;
}

void GcodeText::travel_z(double z) {
    text_ += "G0";
    word('Z', z, 3);
    speed(z_speed);
    text_ += '\n';
}

void GcodeText::extrude(dvec2 to, double area, double mm_per_second) {
    constexpr double pi = 3.14159265358979323846;
    const double length = distance(position_, to);
    const double filament = length * area / (pi / 4 * profile_.filament * profile_.filament);
    text_ += "G1";
    word('X', to.x, 3);
    word('Y', to.y, 3);
    word('E', filament, 5);
    speed(mm_per_second);
    text_ += '\n';
    use_.filament += filament;
    use_.seconds += length / mm_per_second;
    position_ = to;
}

void check_filament_profile(const FilamentProfile& profile, double height) {
    check("bed_x", profile.bed_x, 30, 10000);
    check("bed_y", profile.bed_y, 30, 10000);
    check("bed_z", profile.bed_z, 1, 10000);
    check("nozzle", profile.nozzle, 0.05, 5);
    check("filament", profile.filament, 0.5, 5);
    check("line_width", profile.line_width, 0.05, 10);
    check("infill_density", profile.infill_density, 0, 1);
    check("nozzle_temperature", profile.nozzle_temperature, 0, 500);
    check("bed_temperature", profile.bed_temperature, 0, 250);
    check("print_speed", profile.print_speed, slowest, fastest);
    check("first_layer_speed", profile.first_layer_speed, slowest, fastest);
    check("travel_speed", profile.travel_speed, slowest, fastest);
    check("retraction", profile.retraction, 0, 20);
    check("retraction_speed", profile.retraction_speed, 0.1, 500);
    check("tolerance", profile.tolerance, 0.0001, 1);
    if (profile.infill_density > 0 && profile.infill_density < 0.01) {
        throw InputError(fmt::format("infill_density = {}: must be 0, or 0.01 to 1", profile.infill_density));
    }
    if (!(height > 0 && height <= profile.line_width)) {
        throw InputError(
            fmt::format("layers of {} mm cannot be made with lines {} mm wide: a line is at least as "
                        "wide as high; choose thinner layers or a larger line_width",
                        height, profile.line_width));
    }
}

void check_support_speed(const SupportProfile& profile) {
    check("speed of supports", profile.speed, slowest, fastest);
}

}  // namespace lamella
