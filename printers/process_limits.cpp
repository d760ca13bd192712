// The limits of processes, and what a profile changes of them. Sources of the sizes:
// [1] addema, design guide for stereolithography (addema.se/guides-sla)
// [2] addema, design guide for selective laser sintering (addema.se/guides-sls)
// [3] HLH Prototypes, "SLS 3D printing design tips" (hlhprototypes.com/sls-3d-printing-design-tips)
// [4] Neway, design guidelines for binder jetting (neway3dp.com/services/binder-jetting)
// [5] Rigid Prints, design guide for filament, wall thickness (rigidprints.co.uk/design-guide/wall-thickness)
// [6] Cut Laser Cut, "What is laser kerf" (cutlasercut.com/resources/tips-and-advice/what-is-laser-kerf)
// [7] PrusaSlicer, SLA::SupportPointGenerator (github.com/prusa3d/PrusaSlicer)
#include "printers/process_limits.h"

#include <algorithm>
#include <initializer_list>

#include "printers/registry.h"

namespace lamella {
namespace {

struct Rule {
    Check check;
    Severity verdict;
};

constexpr Severity fail = Severity::fail, warn = Severity::warn, off = Severity::off;

void apply(PrintLimits& limits, std::initializer_list<Rule> rules) {
    for (const Rule& rule : rules) limits.verdicts[static_cast<std::size_t>(rule.check)] = rule.verdict;
}

/// Beads need something under them. Closed voids and cups are as good as any other, and layers of several
/// pieces are the rule.
PrintLimits filament_limits(const PrinterProfile& profile) {
    PrintLimits limits;
    apply(limits, {{Check::connectivity, fail},
                   {Check::islands, fail},
                   {Check::overhangs, fail},
                   {Check::bridges, fail},
                   {Check::thickness, fail},
                   {Check::build_volume, fail},
                   {Check::empty_layers, fail},
                   {Check::necks, warn},
                   {Check::gaps, warn}});
    const double nozzle = profile.filament.nozzle;
    limits.piece = 0.5 * nozzle * nozzle * nozzle;  // by practice: a dot, half as high as it is wide
    limits.island = nozzle * nozzle;                // by practice: a dot
    limits.thickness = nozzle;                      // by practice: one bead as wide as the nozzle
    limits.gap = nozzle;                            // by practice: beads side by side fuse
    limits.neck = 2 * profile.filament.line_width;  // [5] walls are safe from two beads on
    return limits;
}

/// What hangs over the plate is peeled off the film with each layer: pieces must hold. Resin stays in closed
/// voids, and a cup sucks itself to the film. A gap that closes costs a detail, not the print: where two
/// struts of a foam meet there always is one.
PrintLimits resin_limits(const PrinterProfile& profile) {
    PrintLimits limits;
    apply(limits, {{Check::connectivity, fail},
                   {Check::islands, fail},
                   {Check::cavities, fail},
                   {Check::thickness, fail},
                   {Check::build_volume, fail},
                   {Check::empty_layers, fail},
                   {Check::overhangs, warn},
                   {Check::necks, warn},
                   {Check::gaps, warn},
                   {Check::cups, warn},
                   {Check::peel, warn}});
    const double pixel = std::max(profile.image.pixel_x, profile.image.pixel_y);
    const bool has_pixels = find_backend(profile.backend).content == LayerContent::pixels;
    if (has_pixels) limits.piece = pixel * pixel * pixel;          // what is smaller hardens nowhere
    limits.thickness = std::max(0.4, has_pixels ? 2 * pixel : 0);  // [1] walls held at two sides
    limits.island = 0.25 * limits.thickness * limits.thickness;    // by practice: half as thick as a wall
    limits.gap = std::max(0.5, has_pixels ? 2 * pixel : 0);        // [1] holes and clearances
    limits.neck = 0.6;                                             // [1] walls held at one side
    limits.cavity = 1;                                             // by practice
    limits.cup = 10;                                               // by practice
    limits.peel = 60;  // [7] a tip 0.4 mm wide holds 7.7 mm^2 of a layer
    return limits;
}

/// Powder holds what is made and must come out again.
PrintLimits powder_limits() {
    PrintLimits limits;
    apply(limits, {{Check::connectivity, fail},
                   {Check::cavities, fail},
                   {Check::thickness, fail},
                   {Check::build_volume, fail},
                   {Check::empty_layers, fail},
                   {Check::gaps, warn},
                   {Check::necks, warn}});
    limits.piece = 0.001;       // by practice: a grain
    limits.thickness = 0.8;     // [2] features, [3] pins
    limits.thickness_up = 0.8;  // the same: grains do not know what is up
    limits.gap = 0.5;           // [3] clearances and slots
    limits.gap_up = 0.5;
    limits.neck = 2;    // [4] walls, as recommended
    limits.cavity = 1;  // by practice
    return limits;
}

/// A sheet that falls into pieces is lost; how sheets hold on each other is the glue's affair.
PrintLimits cutting_limits(const PrinterProfile& profile) {
    PrintLimits limits;
    const CuttingProfile& cutting = profile.cutting;
    apply(limits, {{Check::sheets, cutting.ties == Ties::join ? warn : fail},
                   {Check::thickness, fail},
                   {Check::gaps, fail},
                   {Check::build_volume, fail},
                   {Check::connectivity, warn},
                   {Check::necks, warn},
                   {Check::cavities, warn},
                   {Check::empty_layers, warn}});
    limits.thickness = 1;                                // [6] what is narrower is fragile and warps
    limits.gap = cutting.kerf > 0 ? cutting.kerf : 0.2;  // the beam's width, of most materials about 0.2 [6]
    limits.neck = 2;                                     // by practice
    limits.cavity = 1;                                   // by practice
    return limits;
}

double chosen(double given, double usual) { return given < 0 ? usual : given; }

Severity chosen(SeverityOverride given, Severity usual) {
    switch (given) {
        case SeverityOverride::off:
            return off;
        case SeverityOverride::warn:
            return warn;
        case SeverityOverride::fail:
            return fail;
        case SeverityOverride::none:
            break;
    }
    return usual;
}

}  // namespace

PrintLimits default_limits(Process process, const PrinterProfile& profile) {
    switch (process) {
        case Process::filament:
            return filament_limits(profile);
        case Process::powder:
            return powder_limits();
        case Process::cutting:
            return cutting_limits(profile);
        case Process::from_backend:
        case Process::resin:
            break;
    }
    return resin_limits(profile);
}

PrintLimits process_limits(const PrinterProfile& profile) {
    PrintLimits limits = default_limits(process_of(profile), profile);
    const CheckProfile& check = profile.check;
    limits.piece = chosen(check.min_piece, limits.piece);
    limits.island = chosen(check.min_island, limits.island);
    limits.thickness = chosen(check.min_thickness, limits.thickness);
    limits.thickness_up = chosen(check.min_thickness_up, limits.thickness_up);
    limits.gap = chosen(check.min_gap, limits.gap);
    limits.gap_up = chosen(check.min_gap_up, limits.gap_up);
    limits.neck = chosen(check.min_neck, limits.neck);
    limits.large_part = chosen(check.large_part, limits.large_part);
    limits.cavity = chosen(check.min_cavity, limits.cavity);
    limits.cup = chosen(check.min_cup, limits.cup);
    limits.peel = chosen(check.max_peel, limits.peel);
    for (std::size_t i = 0; i < check_count; ++i) {
        limits.verdicts[i] = chosen(check.concerns[i], limits.verdicts[i]);
    }
    limits.free_stretch = profile.support.free_stretch;
    limits.bridge = profile.support.own_bridge;
    limits.support_spacing = profile.support.spacing;
    limits.support_gap = profile.support.gap;
    return limits;
}

}  // namespace lamella
