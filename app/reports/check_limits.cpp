// Combines the machine's limits, the job's layers, and settings that change verdicts.
#include "app/reports/check_limits.h"

#include <cmath>

#include "printers/masks/mask.h"
#include "printers/registry.h"
#include "recipe/build/build_supports.h"

namespace lamella {
namespace {

Severity& verdict_of(PrintLimits& limits, Check check) {
    return limits.verdicts[static_cast<std::size_t>(check)];
}

/// Turns off connectivity checks for several parts: they need not be connected to each other.
void allow_several(CheckPlan& plan, int parts) {
    if (parts < 2) return;
    bool asked = false;
    for (const Check check : {Check::connectivity, Check::sheets}) {
        Severity& verdict = verdict_of(plan.options.limits, check);
        asked = asked || verdict != Severity::off;
        verdict = Severity::off;
    }
    if (asked) {
        plan.notes.push_back(
            "Several parts stand on the plate: whether each of them is one piece is not "
            "looked at; `lamella check` looks at the part alone.");
    }
}

/// Notes faults that the output repairs itself.
void note_ties(CheckPlan& plan, const PrinterProfile& printer) {
    if (plan.process != Process::cutting || printer.cutting.ties != Ties::join) return;
    if (plan.options.limits.verdict(Check::sheets) == Severity::off) return;
    plan.notes.push_back("Ties join the loose pieces of a sheet (printer.ties).");
}

void note_sheets(CheckPlan& plan, const PrinterProfile& printer) {
    if (printer.cutting.sheet.empty() || plan.process != Process::cutting) return;
    plan.notes.push_back("Whether each layer fits a sheet is seen when the layers are laid out.");
}

/// Aligns the check's rows with lines of the masks if a multiple of their spacing is near the wanted pitch,
/// so that runs are computed once for both. A larger pitch would miss walls that must be crossed by a certain
/// number of rows (check_pitch).
void lie_on_masks(PrintCheckOptions& options, const PrinterProfile& printer, const Job& job) {
    constexpr double min_share = 0.875;  // as a share of the wanted pitch: denser rows take longer
    if (find_backend(printer.backend).content != LayerContent::pixels) return;
    std::optional<RowBand> lines = mask_lines(printer.image, job.bounds);
    if (!lines) return;
    const double pitch = std::abs(lines->line_pitch());
    lines->step = static_cast<int>(options.pitch / pitch * (1 + 1e-9));
    const double found = lines->step * pitch;
    if (found < min_share * options.pitch) return;
    options.lines = lines;
    options.pitch = found;
}

}  // namespace

CheckPlan plan_check(const PrinterProfile& printer, const Job& job, int parts) {
    CheckPlan plan;
    plan.process = process_of(printer);
    PrintLimits& limits = plan.options.limits;
    limits = process_limits(printer);
    limits.overhang = printable_overhang(printer, job.layers.least_height());
    limits.overhang_grows = printer.support.overhang == 0 && !makes_beads(printer);
    limits.build_volume = build_volume_limits(printer, job.layers.height(0));
    if (limits.build_volume == dvec3(infinity)) verdict_of(limits, Check::build_volume) = Severity::off;
    plan.options.max_places = static_cast<std::size_t>(printer.check.places);
    allow_several(plan, parts);
    note_ties(plan, printer);
    note_sheets(plan, printer);
    plan.options.pitch = printer.check.pitch;
    if (plan.options.pitch > 0) return plan;
    plan.options.pitch = check_pitch(job, limits);
    lie_on_masks(plan.options, printer, job);
    return plan;
}

}  // namespace lamella
