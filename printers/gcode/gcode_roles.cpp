// Tables of role properties: one switch per property.
#include "printers/gcode/gcode_roles.h"

namespace lamella {

const char* role_name(const Bead& bead) {
    switch (bead.role) {
        case Role::external_perimeter:
            return bead.hangs ? "Overhang perimeter" : "External perimeter";
        case Role::perimeter:
            return bead.hangs ? "Overhang perimeter" : "Perimeter";
        case Role::internal_infill:
            return bead.hangs ? "Bridge infill" : "Internal infill";
        case Role::solid_infill:
            return bead.hangs ? "Bridge infill" : "Solid infill";
        case Role::gap_fill:
            return bead.hangs ? "Bridge infill" : "Gap fill";
        case Role::skirt:
            return "Skirt/Brim";
        case Role::support:
            return "Support material";
        case Role::purge_tower:
            return "Wipe tower";
    }
    return "Custom";
}

double role_speed(const PrinterProfile& profile, const Bead& bead, bool first_layer) {
    if (first_layer) return profile.filament.first_layer_speed;
    if (bead.hangs && profile.gcode.bridge_speed > 0) return profile.gcode.bridge_speed;
    const auto own = [&](double speed) { return speed > 0 ? speed : profile.filament.print_speed; };
    switch (bead.role) {
        case Role::external_perimeter:
            return own(profile.gcode.wall_speed);
        case Role::perimeter:
            return own(profile.gcode.inner_wall_speed);
        case Role::internal_infill:
            return own(profile.gcode.infill_speed);
        case Role::solid_infill:
            return own(profile.gcode.solid_speed);
        case Role::gap_fill:
            return own(profile.gcode.thin_speed);
        case Role::skirt:
        case Role::purge_tower:
            return profile.filament.print_speed;
        case Role::support:
            return profile.support.speed;
    }
    return profile.filament.print_speed;
}

double role_acceleration(const GcodeProfile& profile, const Bead& bead, bool first_layer) {
    if (first_layer && profile.first_layer_acceleration > 0) return profile.first_layer_acceleration;
    if (bead.role == Role::external_perimeter && profile.wall_acceleration > 0)
        return profile.wall_acceleration;
    return profile.acceleration;
}

double travel_acceleration(const GcodeProfile& profile) {
    return profile.travel_acceleration > 0 ? profile.travel_acceleration : profile.acceleration;
}

bool sets_acceleration(const GcodeProfile& profile) {
    return profile.wall_acceleration > 0 || profile.travel_acceleration > 0 ||
           profile.first_layer_acceleration > 0;
}

}  // namespace lamella
