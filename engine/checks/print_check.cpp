// The checks side by side: layers are prepared in parallel and compared in order.
#include "engine/checks/print_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/checks/check_rows.h"
#include "engine/checks/check_table.h"
#include "engine/checks/thickness_check.h"
#include "engine/layers/survey_rows.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr double max_rows = 1 << 15;  // along a side

CheckRows check_rows(const Job& job, const PrintCheckOptions& options) {
    return options.lines ? CheckRows(job, *options.lines) : CheckRows(job, options.pitch);
}

/// Whether labels have the rows of a layer, or none where nobody reads them.
bool are_labels(const LabelledLayer& labels, const RunRows& rows, bool wanted) {
    if (!wanted) return labels.starts.empty();
    return labels.starts.size() == rows.lines() + 1 && labels.owners.size() == rows.runs().size();
}

/// Whether a check reads labels of some kind.
bool any_reads(const std::vector<ActiveCheck>& checks, bool CheckPass::*labels) {
    return std::ranges::any_of(checks, [&](const ActiveCheck& active) { return active.pass->*labels; });
}

/// What the checks need of one layer.
struct CheckedLayer : LayerProduct {
    CheckedLayer(const std::vector<ActiveCheck>& given, std::size_t line_count)
        : checks(given), lines(line_count) {}

    void serialize(Archive& parcel) override {
        LayerFootprint& rows = layer.rows;
        parcel(rows.part, rows.supports, rows.part_with_supports, layer.part, layer.part_with_supports);
        prepared.resize(checks.size());
        for (PreparedRows& one : prepared) parcel(one);
        if (parcel.unpacks() && !fits()) throw FaultError("a layer's parcel is of another check");
    }

    const std::vector<ActiveCheck>& checks;
    std::size_t lines;
    LayerSample layer;                   ///< its cells are not sent between processes
    std::vector<PreparedRows> prepared;  ///< by check

  private:
    /// Whether the unpacked rows can be compared with other layers.
    bool fits() const {
        const LayerFootprint& rows = layer.rows;
        if (rows.part.lines() != lines || rows.supports.lines() != lines || rows.printed().lines() != lines)
            return false;
        if (!are_labels(layer.part, rows.part, any_reads(checks, &CheckPass::reads_part_labels)))
            return false;
        const bool has_supports = !rows.supports.runs().empty();
        if (!are_labels(layer.part_with_supports, rows.part_with_supports,
                        has_supports && any_reads(checks, &CheckPass::reads_printed_labels)))
            return false;
        for (std::size_t i = 0; i < checks.size(); ++i)
            if (!checks[i].check->accepts(prepared[i], lines)) return false;
        return true;
    }
};

/// Returns the part and its supports.
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
    const double pitch = options.lines ? std::abs(options.lines->line_pitch()) : options.pitch;
    check_number("pitch", pitch, std::max(size.x, size.y) / max_rows * (1 - 1e-9));
    // A ball that fits must reach a row at least.
    const double least = 2 * pitch;
    const std::string in_rows = " in rows " + format_number(pitch, 9) + " mm apart";
    for (const Check check : all_checks()) {
        const CheckInfo& info = check_info(check);
        if (info.thickness_limit != nullptr && limits.wants(check))
            check_number(info.thickness_limit, limits.*info.limit, least, in_rows);
    }
    check_number("overhang", limits.overhang, 0);
    check_number("support spacing", limits.support_spacing, 0);
    check_number("peel factor", limits.peel, 0);
}

}  // namespace

struct PrintCheck::State {
    State(const Job& job, const PrintCheckOptions& given)
        : options(given), rows(check_rows(job, given)), grid{rows.band(), job.z0(), job.layers} {
        const CheckContext context{grid, given.limits, given.max_places};
        std::optional<double> reach;
        for (const CheckPass& pass : check_passes()) {
            const auto wants = [&](Check check) { return given.limits.wants(check); };
            if (std::ranges::none_of(pass.finds, wants)) continue;
            checks.push_back({&pass, pass.make(context)});
            reach = std::max(reach, checks.back().check->cell_reach());  // empty is least
        }
        if (reach) cells.emplace(Run{0, grid.band.hi * run_unit}, lines(), *reach, run_unit);
    }

    std::size_t lines() const { return static_cast<std::size_t>(grid.band.lines()); }
    CheckResult result(Check check, const FaultList& faults) const;
    void make_report();

    PrintCheckOptions options;
    CheckRows rows;
    CheckGrid grid;
    std::vector<ActiveCheck> checks;
    std::optional<CellLattice> cells;  // where a check reads cells
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
    for (const Check check : all_checks()) {
        const CheckInfo& info = check_info(check);
        if (info.thickness_limit != nullptr && limits.wants(check))
            least = std::min(least, limits.*info.limit);
    }
    return std::max(least / pitches_in_a_thickness, std::max(size.x, size.y) / max_rows);
}

PrintCheck::PrintCheck(const Job& job, const PrintCheckOptions& options) {
    check_options(job, options);
    state_ = std::make_unique<State>(job, options);
}
PrintCheck::~PrintCheck() = default;

int PrintCheck::open(const Job& job, LayerRange range, bool /*resume*/) {
    check_range(job, range);
    if (range.first != 0 || range.last != state_->grid.layers.count())
        throw InputError("a check looks at all layers of a job; a range of them cannot be checked");
    return 0;
}

std::optional<RowBand> PrintCheck::shared_lines() const { return state_->rows.lines(); }

std::unique_ptr<LayerProduct> PrintCheck::render(const Layer& layer) const {
    const State& state = *state_;
    auto product = std::make_unique<CheckedLayer>(state.checks, state.lines());
    LayerSample& sample = product->layer;
    sample.index = layer.index();
    Scratch scratch;
    sample.rows.part = state.rows.part_rows(layer, scratch);
    const RunRows& part = sample.rows.part;
    product->area = state.grid.area(part.total_length());
    if (any_reads(state.checks, &CheckPass::reads_part_labels))
        sample.part = label_layer(part, layer.index(), Growth{});
    if (state.cells) sample.cells.emplace(part, *state.cells);
    for (const ActiveCheck& active : state.checks) product->prepared.push_back(active.check->prepare(sample));
    sample.rows.supports = state.rows.support_rows(layer, scratch);
    const RunRows& supports = sample.rows.supports;
    product->support_area = state.grid.area(supports.total_length());
    if (!supports.runs().empty()) {
        sample.rows.part_with_supports = united(part, supports);
        if (any_reads(state.checks, &CheckPass::reads_printed_labels))
            sample.part_with_supports = label_layer(sample.rows.part_with_supports, layer.index(), Growth{});
    }
    return product;
}

std::unique_ptr<LayerProduct> PrintCheck::empty_product() const {
    return std::make_unique<CheckedLayer>(state_->checks, state_->lines());
}

void PrintCheck::write(const Layer& layer, LayerProduct& product) {
    State& state = *state_;
    auto& checked = static_cast<CheckedLayer&>(product);
    LayerSample& sample = checked.layer;
    sample.index = layer.index();
    state.report.volume += checked.area * layer.thickness();
    if (state.cells && !sample.cells) sample.cells.emplace(sample.rows.part, *state.cells);
    Scratch scratch;
    sample.rows_in = [&](const RowBand& band) { return printed_rows(layer, band, scratch); };
    for (std::size_t i = 0; i < state.checks.size(); ++i)
        state.checks[i].check->add(sample, std::move(checked.prepared[i]));
}

void PrintCheck::finish() {
    for (const ActiveCheck& active : state_->checks) active.check->finish();
    state_->make_report();
}

const CheckReport& PrintCheck::report() const { return state_->report; }

void PrintCheck::State::make_report() {
    report.band = grid.band;
    for (const ActiveCheck& active : checks) active.check->complete(report);
    for (const Check check : all_checks()) {
        if (!options.limits.wants(check)) continue;
        const auto finder = std::ranges::find_if(checks, [&](const ActiveCheck& active) {
            return std::ranges::find(active.pass->finds, check) != active.pass->finds.end();
        });
        report.results.push_back(result(check, finder->check->faults(check)));
    }
}

CheckResult PrintCheck::State::result(Check check, const FaultList& faults) const {
    CheckResult result;
    result.check = check;
    result.verdict = options.limits.verdict(check);
    const auto limit = check_info(check).limit;
    if (limit != nullptr) result.limit = options.limits.*limit;
    faults.report(result);
    return result;
}

}  // namespace lamella
