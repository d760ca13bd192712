// The checks side by side: layers are prepared in parallel and compared in order.
#include "engine/checks/print_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/checks/check_rows.h"
#include "engine/checks/fault_list.h"
#include "engine/checks/layer_checks.h"
#include "engine/checks/neck_check.h"
#include "engine/checks/overhang_check.h"
#include "engine/checks/streaming_faults.h"
#include "engine/checks/thickness_check.h"
#include "engine/checks/void_check.h"
#include "engine/layers/survey_rows.h"
#include "engine/morphology/layer_opening.h"
#include "engine/morphology/thin_feature_search.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr double max_rows = 1 << 15;  // along a side

CheckRows check_rows(const Job& job, const PrintCheckOptions& options) {
    return options.lines ? CheckRows(job, *options.lines) : CheckRows(job, options.pitch);
}

/// What the layers of a check have in common.
struct LayerShape {
    std::size_t lines = 0;
    bool labels_part = false, labels_printed = false, labels_voids = false;
};

/// What the checks need of one layer.
struct CheckedLayer : LayerProduct {
    explicit CheckedLayer(const LayerShape& given) : shape(given) {}

    void serialize(Archive& parcel) override {
        parcel(rows.part, rows.supports, rows.part_with_supports, part, printed, voids, thin, narrow);
        if (parcel.unpacks() && !fits()) throw FaultError("a layer's parcel is of another check");
    }

    LayerShape shape;
    LayerFootprint rows;
    LabelledLayer part, printed;  ///< printed only where there are supports
    LabelledLayer voids;
    std::optional<LayerCells> cells;  ///< of the part; not carried, and made anew where it is missing
    RunRows thin, narrow;

  private:
    bool has_lines(const RunRows& found) const { return found.lines() == shape.lines; }
    bool are_labels(const LabelledLayer& labels, bool wanted) const {
        return labels.starts.size() == (wanted ? shape.lines + 1 : 0);
    }
    /// Whether what was unpacked can be held against other layers.
    bool fits() const {
        if (!has_lines(rows.part) || !has_lines(rows.supports) || !has_lines(rows.printed())) return false;
        if (!are_labels(part, shape.labels_part) || !are_labels(voids, shape.labels_voids)) return false;
        if (shape.labels_part && part.owners.size() != rows.part.runs().size()) return false;
        if (shape.labels_voids && voids.row(0).empty()) return false;
        const bool has_supports = !rows.supports.runs().empty();
        return are_labels(printed, shape.labels_printed && has_supports) &&
               (printed.starts.empty() || printed.owners.size() == rows.printed().runs().size());
    }
};

/// The part and its supports.
RunRows printed_rows(const Layer& layer, const RowBand& band, Scratch& scratch) {
    RunRows part = all_rows(layer.part(), band, scratch);
    return layer.supports() == nullptr ? part : united(part, all_rows(*layer.supports(), band, scratch));
}

/// `where`: what the bound follows from.
void check_number(const char* name, double value, double above, const std::string& where = "") {
    if (value > above && value < 1e9) return;
    const bool printable = std::abs(value) < 1e9;
    throw InputError(std::string("print check: the ") + name +
                     (printable ? " of " + format_number(value, 9) : std::string()) + " makes no sense" +
                     where + "; accepted: numbers greater than " + format_number(above, 9) +
                     " and below 1e9");
}

void check_options(const Job& job, const PrintCheckOptions& options) {
    const PrintLimits& limits = options.limits;
    const dvec3 size = job.bounds.size();
    if (!job.part || job.bounds.empty() || !std::isfinite(size.x + size.y + size.z))
        throw InputError("print check: there is no part, or its bounds are infinite");
    const auto wanted = [&](Check check) { return limits.verdict(check) != Severity::off; };
    const double pitch = options.lines ? std::abs(options.lines->line_pitch()) : options.pitch;
    check_number("pitch", pitch, std::max(size.x, size.y) / max_rows * (1 - 1e-9));
    // A ball that fits must reach a row at least.
    const double least = 2 * pitch;
    const std::string in_rows = " in rows " + format_number(pitch, 9) + " mm apart";
    if (wanted(Check::thickness)) check_number("least thickness", limits.thickness, least, in_rows);
    if (wanted(Check::gaps)) check_number("least gap", limits.gap, least, in_rows);
    if (wanted(Check::necks)) check_number("least neck", limits.neck, least, in_rows);
    check_number("overhang", limits.overhang, 0);
    check_number("support spacing", limits.support_spacing, 0);
}

}  // namespace

struct PrintCheck::State {
    State(const Job& job, const PrintCheckOptions& given)
        : options(given),
          rows(check_rows(job, given)),
          grid{rows.band(), job.z0(), job.layer_height},
          layer_count(job.layer_count),
          sheets(grid, given.max_places),
          empty(grid, given.max_places),
          reach(grid, given.limits.build_volume, given.max_places) {
        const PrintLimits& limits = given.limits;
        const std::size_t most = given.max_places;
        if (wants(Check::connectivity)) pieces.emplace(grid, 0, most);
        if (wants(Check::islands) || wants(Check::overhangs) || wants(Check::bridges))
            hold.emplace(grid, limits, most);
        if (wants(Check::thickness))
            thickness.emplace(grid, layer_count, limits.thickness, limits.thickness_up, FeatureKind::wall,
                              most);
        if (wants(Check::gaps))
            gaps.emplace(grid, layer_count, limits.gap, limits.gap_up, FeatureKind::gap, most);
        if (wants(Check::necks)) necks.emplace(grid, limits.neck, limits.large_part, most);
        if (wants(Check::cavities) || wants(Check::cups))
            voids.emplace(grid, limits.cavity, limits.cup, most);
        double reach_of_cells = 0;
        for (const std::optional<ThicknessCheck>* check : {&thickness, &gaps})
            if (*check) reach_of_cells = std::max(reach_of_cells, (*check)->reach());
        cells.emplace(Run{0, grid.band.hi * run_unit}, static_cast<std::size_t>(grid.band.lines()),
                      reach_of_cells, run_unit);
    }

    bool wants(Check check) const { return options.limits.verdict(check) != Severity::off; }
    LayerShape shape() const {
        return {static_cast<std::size_t>(grid.band.lines()), pieces || hold || wants(Check::sheets),
                hold.has_value(), voids.has_value()};
    }
    void finish();
    void report_all();
    void report_one(Check check, double limit, const FaultList* faults);

    PrintCheckOptions options;
    CheckRows rows;
    CheckGrid grid;
    int layer_count;
    std::optional<StreamingFaults> pieces;
    std::optional<OverhangCheck> hold;
    std::optional<ThicknessCheck> thickness;
    std::optional<ThicknessCheck> gaps;
    std::optional<NeckCheck> necks;
    std::optional<VoidCheck> voids;
    std::optional<CellLattice> cells;
    SheetCheck sheets;
    EmptyCheck empty;
    ReachCheck reach;
    CheckReport report;
};

bool CheckReport::passed() const {
    return std::ranges::all_of(results, [](const CheckResult& result) {
        return result.passed() || result.verdict != Severity::fail;
    });
}

double check_pitch(const Job& job, const PrintLimits& limits) {
    const dvec3 size = job.bounds.size();
    constexpr double where_nothing_is_thin = 0.5;  // mm
    double least = where_nothing_is_thin;
    const auto consider = [&](Check check, double thickness) {
        if (limits.verdict(check) != Severity::off) least = std::min(least, thickness);
    };
    consider(Check::thickness, limits.thickness);
    consider(Check::gaps, limits.gap);
    consider(Check::necks, limits.neck);
    return std::max(least / pitches_in_a_thickness, std::max(size.x, size.y) / max_rows);
}

PrintCheck::PrintCheck(const Job& job, const PrintCheckOptions& options) {
    check_options(job, options);
    state_ = std::make_unique<State>(job, options);
}
PrintCheck::~PrintCheck() = default;

int PrintCheck::open(const Job& /*job*/, LayerRange range, bool /*resume*/) {
    if (range.first != 0 || range.last != state_->layer_count)
        throw InputError("a check looks at all layers of a job; a range of them cannot be checked");
    return 0;
}

std::optional<RowBand> PrintCheck::shared_lines() const { return state_->rows.lines(); }

std::unique_ptr<LayerProduct> PrintCheck::render(const Layer& layer) const {
    const State& state = *state_;
    auto product = std::make_unique<CheckedLayer>(state.shape());
    Scratch scratch;
    RunRows part = state.rows.part_rows(layer, scratch);
    product->area = state.grid.area(part.total_length());
    if (product->shape.labels_part) product->part = label_layer(part, layer.index(), Growth{});
    if (state.voids) product->voids = VoidCheck::label(part, state.grid, layer.index());
    if (state.thickness || state.gaps || state.hold) product->cells.emplace(part, *state.cells);
    if (state.thickness) product->thin = state.thickness->prepare(part, *product->cells);
    if (state.gaps) product->narrow = state.gaps->prepare(part, *product->cells);
    RunRows supports = state.rows.support_rows(layer, scratch);
    product->support_area = state.grid.area(supports.total_length());
    if (!supports.runs().empty()) {
        product->rows.part_with_supports = united(part, supports);
        if (state.hold)
            product->printed = label_layer(product->rows.part_with_supports, layer.index(), Growth{});
    }
    product->rows.part = std::move(part);
    product->rows.supports = std::move(supports);
    return product;
}

std::unique_ptr<LayerProduct> PrintCheck::empty_product() const {
    return std::make_unique<CheckedLayer>(state_->shape());
}

void PrintCheck::write(const Layer& layer, LayerProduct& product) {
    State& state = *state_;
    auto& checked = static_cast<CheckedLayer&>(product);
    const int index = layer.index();
    const RunRows& part = checked.rows.part;
    state.report.volume += checked.area * state.grid.layer_height;
    if (state.wants(Check::sheets)) state.sheets.add(checked.part, index);
    if (state.wants(Check::empty_layers)) state.empty.add(checked.rows.printed(), index);
    if (state.wants(Check::build_volume)) state.reach.add(checked.rows.printed(), index);
    if (state.voids) state.voids->add(std::move(checked.voids), index);
    if (state.thickness) state.thickness->add(part, checked.thin);
    if (state.gaps) state.gaps->add(part, checked.narrow);
    if (state.necks) state.necks->push(part);
    if (state.hold) {
        if (!checked.cells) checked.cells.emplace(part, *state.cells);
        Scratch scratch;
        state.hold->add(
            std::move(checked.rows), *std::move(checked.cells),
            checked.printed.starts.empty() ? checked.part : checked.printed,
            [&](const RowBand& band) { return printed_rows(layer, band, scratch); }, index);
    }
    if (state.pieces) state.pieces->add(std::move(checked.part), index);
}

void PrintCheck::finish() { state_->finish(); }

const CheckReport& PrintCheck::report() const { return state_->report; }

void PrintCheck::State::finish() {
    if (pieces) {
        pieces->finish();
        pieces->excuse_greatest();  // the part itself
    }
    if (hold) hold->finish();
    if (thickness) thickness->finish();
    if (gaps) gaps->finish();
    if (necks) necks->finish();
    if (voids) voids->finish();
    empty.finish(layer_count);
    reach.finish();
    report_all();
}

void PrintCheck::State::report_all() {
    const PrintLimits& limits = options.limits;
    report.band = grid.band;
    report_one(Check::connectivity, 0, pieces ? &pieces->faults() : nullptr);
    report_one(Check::sheets, 0, &sheets.faults());
    report_one(Check::islands, 0, hold ? &hold->islands() : nullptr);
    report_one(Check::overhangs, limits.overhang, hold ? &hold->overhangs() : nullptr);
    report_one(Check::bridges, limits.bridge, hold ? &hold->bridges() : nullptr);
    report_one(Check::thickness, limits.thickness, thickness ? &thickness->faults() : nullptr);
    report_one(Check::necks, limits.neck, necks ? &necks->necks() : nullptr);
    report_one(Check::gaps, limits.gap, gaps ? &gaps->faults() : nullptr);
    report_one(Check::cavities, limits.cavity, voids ? &voids->cavities() : nullptr);
    report_one(Check::cups, limits.cup, voids ? &voids->cups() : nullptr);
    report_one(Check::build_volume, 0, &reach.faults());
    report_one(Check::empty_layers, 0, &empty.faults());
}

void PrintCheck::State::report_one(Check check, double limit, const FaultList* faults) {
    if (!wants(check) || faults == nullptr) return;
    CheckResult result;
    result.check = check;
    result.verdict = options.limits.verdict(check);
    result.limit = limit;
    faults->report(result);
    report.results.push_back(std::move(result));
}

}  // namespace lamella
