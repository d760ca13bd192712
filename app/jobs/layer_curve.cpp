// Measures layers, several at once.
#include "app/jobs/layer_curve.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "app/http/http_server.h"
#include "app/jobs/layer_content.h"
#include "app/jobs/layer_paths.h"
#include "app/reports/check_limits.h"
#include "engine/base/cancel_token.h"
#include "engine/base/parallel.h"
#include "engine/checks/check_rows.h"
#include "engine/runs/row_sets.h"
#include "engine/runs/run_components.h"
#include "printers/masks/resin.h"
#include "printers/registry.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

/// How the layers of a job share values.
struct Spread {
    Spread(const ServedJob& job, int values) : layers(job.job().layers.count()) {
        each = std::max(1, (layers + values - 1) / values);
    }
    std::size_t count() const { return static_cast<std::size_t>((layers + each - 1) / each); }
    /// The layer in the middle of those of a value.
    int middle(std::size_t value) const {
        return std::min(static_cast<int>(value) * each + each / 2, layers - 1);
    }

    int layers = 0;
    int each = 1;  ///< layers a value
};

/// Returns the area that a slice covers of a page, mm^2.
double area_of(const SliceField* slice, const RowBand& page) {
    if (slice == nullptr) return 0;
    Scratch scratch;
    RunRows rows;
    slice->runs(page, scratch, rows);
    return static_cast<double>(rows.total_length()) / run_unit * page.along_pitch *
           std::abs(page.line_pitch());
}

/// A component of a layer rests on rows if one of its runs overlaps them in its row or a neighbouring one.
void mark_resting(const LabelledLayer& labelled, const RunRows& below, std::vector<std::uint8_t>& rests) {
    for (int row = 0; row < static_cast<int>(below.lines()); ++row) {
        for (const int aside : {-1, 0, 1}) {
            for_touching(labelled.row(row + aside), below.line(static_cast<std::size_t>(row)),
                         [&](const LabelledRun& run, const Run&) { rests[run.component] = 1; });
        }
    }
}

/// Counts the islands of layers.
class IslandCount {
  public:
    IslandCount(const ServedJob& job, const CheckPlan& plan, double pitch)
        : job_(job.job()), rows_(job_, pitch), closer_rows_(job_, pitch / closer) {
        const double layers = plan.options.limits.support_gap / job_.layers.least_height();
        gap_layers_ = static_cast<int>(std::ceil(layers - 1e-9));
    }

    int of(int index, const CancelToken* cancel) const {
        const int lowest = job_.layers.first_of_stack(job_.layers.stack_of(index));
        if (index == lowest) return 0;
        constexpr int anything = 1, in_two_rows = 2;
        if (floating(index, lowest, rows_, anything, cancel) == 0) return 0;
        return floating(index, lowest, closer_rows_, in_two_rows, cancel);
    }

  private:
    static constexpr int closer =
        6;  // rows for one where something floats: it may be joined between the rows

    /// Returns the number of pieces of a layer that touch nothing below and that so many rows meet at least.
    int floating(int index, int lowest, const CheckRows& rows, int least, const CancelToken* cancel) const {
        Scratch scratch;
        const Layer layer(job_, index, cancel);
        const LabelledLayer labelled = label_layer(printed(layer, rows, scratch), 0, Growth{});
        std::vector<std::uint8_t> rests(labelled.components.size(), 0);
        for (int k = index - 1; k >= std::max(lowest, index - 1 - gap_layers_); --k) {
            stop_if_cancelled(cancel);
            const Layer below(job_, k, cancel);
            const bool is_next = k == index - 1;
            mark_resting(labelled,
                         is_next ? printed(below, rows, scratch) : rows.support_rows(below, scratch), rests);
        }
        int found = 0;
        for (std::size_t c = 0; c < rests.size(); ++c) {
            const ComponentExtent& extent = labelled.components[c];
            if (rests[c] == 0 && extent.last_row - extent.first_row + 1 >= least) ++found;
        }
        return found;
    }

    static RunRows printed(const Layer& layer, const CheckRows& rows, Scratch& scratch) {
        return united(rows.part_rows(layer, scratch), rows.support_rows(layer, scratch));
    }

    const Job& job_;
    CheckRows rows_, closer_rows_;
    int gap_layers_ = 0;  // layers that may lie between a support and what it holds
};

double seconds_of(const ServedJob& job, int layer, bool is_laid, const CancelToken* cancel) {
    if (is_laid) return layer_paths(job, layer, cancel).at("seconds").get<double>();
    const ResinProfile& resin = job.recipe.printer.resin;
    return resin.moves + resin_exposure(resin, layer, job.job().layers.height(layer));
}

}  // namespace

Json area_curve(const ServedJob& job, int values, const PassControl& control) {
    const Spread spread(job, values);
    constexpr int rows_across = 128;
    const Rect rect = job.job().bounds.rect();
    const RowBand page = page_of(rect, std::max(rect.size().x, rect.size().y) / rows_across, 1);
    std::vector<double> part(spread.count()), supports(part.size());
    ThreadArena arena(control.threads);
    arena.execute([&] {
        parallel_for(part.size(), [&](std::size_t i) {
            stop_if_cancelled(control.cancel);
            const Layer cut(job.job(), spread.middle(i));
            part[i] = area_of(&cut.part(), page);
            supports[i] = area_of(cut.supports(), page);
        });
    });
    return {{"layers_a_value", spread.each}, {"area_mm2", part}, {"support_area_mm2", supports}};
}

Json island_curve(const ServedJob& job, int values, const PassControl& control) {
    const Spread spread(job, values);
    constexpr int most_rows = 640;
    const CheckPlan plan = plan_check(job.recipe.printer, job.job(), job.parts);
    const dvec2 size = job.job().bounds.rect().size();
    const double pitch = std::max(plan.options.pitch, std::max(size.x, size.y) / most_rows);
    const IslandCount count(job, plan, pitch);
    std::vector<int> islands(static_cast<std::size_t>(spread.layers));
    ThreadArena arena(control.threads);
    arena.execute([&] {
        parallel_for(islands.size(), [&](std::size_t k) {
            stop_if_cancelled(control.cancel);
            islands[k] = count.of(static_cast<int>(k), control.cancel);
        });
    });
    Json sums = Json::array();
    for (int first = 0; first < spread.layers; first += spread.each) {
        const int end = std::min(first + spread.each, spread.layers);
        sums.push_back(std::accumulate(islands.begin() + first, islands.begin() + end, 0));
    }
    return {{"layers_a_value", spread.each}, {"islands", std::move(sums)}, {"pitch_mm", pitch}};
}

Json time_curve(const ServedJob& job, int values, const PassControl& control) {
    const PrinterProfile& printer = job.recipe.printer;
    const bool is_laid = lays_beads(printer);
    if (!is_laid && process_of(printer) != Process::resin)
        throw HttpError(
            400, printer.name + ": no time of its layers is known; accepted: machines for filament or resin");
    const Spread spread(job, values);
    std::vector<double> seconds(spread.count());
    ThreadArena arena(control.threads);
    arena.execute([&] {
        parallel_for(seconds.size(), [&](std::size_t i) {
            stop_if_cancelled(control.cancel);
            seconds[i] = seconds_of(job, spread.middle(i), is_laid, control.cancel);
        });
    });
    return {{"layers_a_value", spread.each}, {"seconds", seconds}};
}

}  // namespace lamella
