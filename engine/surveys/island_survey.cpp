// Island survey: a back-end of the layer stream. Layers are labelled in parallel and joined in order.
#include "engine/surveys/island_survey.h"

#include <algorithm>
#include <map>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/layers/survey_rows.h"

namespace lamella {
namespace {

constexpr std::uint32_t outside = UINT32_MAX;

struct LabelledProduct : LayerProduct {
    LabelledLayer part, body;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts;  ///< (part's component, body's component)
};

void find_contacts(const RunRows& part, LabelledProduct& product) {
    for (std::size_t l = 0; l < part.lines(); ++l) {
        for_touching(part.line(l), product.body.row(static_cast<int>(l)),
                     [&](const Run& run, const LabelledRun& body) {
                         const auto i = static_cast<std::size_t>(&run - part.runs().data());
                         product.contacts.emplace_back(product.part.owners[i], body.component);
                     });
    }
    std::sort(product.contacts.begin(), product.contacts.end());
    product.contacts.erase(std::unique(product.contacts.begin(), product.contacts.end()),
                           product.contacts.end());
}

class IslandSurveyor : public LayerPass {
  public:
    IslandSurveyor(const Job& job, FieldPtr body, const IslandSurveyOptions& options)
        : body_(std::move(body)),
          options_(options),
          growth_{run_unit, 1, static_cast<int>(std::ceil(options.pitch / job.layers.least_height()))},
          band_(rows_over(job.bounds.rect(), options.pitch)),
          grid_{{job.bounds.lo.x, job.bounds.lo.y}, options.pitch, job.z0(), job.layers.least_height()},
          part_components_(growth_, options.max_runs),
          body_components_(Growth{}, 0) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;

    IslandSurvey result();

  private:
    /// Returns the numbers of the components that are the largest of a group, ascending.
    std::vector<std::uint32_t> largest_of_groups();
    Island describe(const RunComponents::Component& component) const;
    double volume(std::int64_t length) const {
        return static_cast<double>(length) / run_unit * grid_.pitch * grid_.pitch * grid_.layer_height;
    }

    FieldPtr body_;
    const IslandSurveyOptions& options_;
    Growth growth_;
    RowBand band_;
    SurveyGrid grid_;
    RunComponents part_components_, body_components_;
    std::size_t groups_ = 0;
};

std::unique_ptr<LayerProduct> IslandSurveyor::render(const Layer& layer) const {
    auto product = std::make_unique<LabelledProduct>();
    Scratch scratch;
    const RunRows part = all_rows(layer.part(), band_, scratch);
    product->part = label_layer(part, layer.index(), growth_);
    product->area = static_cast<double>(part.total_length()) / run_unit * grid_.pitch * grid_.pitch;
    if (body_) {
        SliceContext context;
        const RunRows body = all_rows(context.slice(*body_, layer.z()), band_, scratch);
        product->body = label_layer(body, layer.index(), Growth{});
        find_contacts(part, *product);
    }
    return product;
}

void IslandSurveyor::write(const Layer& layer, LayerProduct& product) {
    auto& labelled = static_cast<LabelledProduct&>(product);
    const auto bodies = body_components_.add(std::move(labelled.body), layer.index());
    const auto parts = part_components_.add(std::move(labelled.part), layer.index());
    for (const auto& [part, body] : labelled.contacts) {
        part_components_.mark(parts[part], body_components_.find(bodies[body]));
    }
    if (part_components_.runs_kept() > options_.max_kept) {
        throw InputError(
            "the part falls into too many pieces to remember all that may float free; a survey "
            "with a coarser pitch than " +
            format_number(grid_.pitch, 6) + " mm needs less room");
    }
}

std::vector<std::uint32_t> IslandSurveyor::largest_of_groups() {
    std::map<std::uint32_t, std::uint32_t> largest;
    for (const std::uint32_t number : part_components_.numbers()) {
        const auto& component = part_components_.component(number);
        std::vector<std::uint32_t> groups;
        groups.reserve(component.groups.size() + 1);
        for (const std::uint32_t group : component.groups) groups.push_back(body_components_.find(group));
        if (groups.empty()) groups.push_back(outside);
        for (const std::uint32_t group : groups) {
            const auto [found, first] = largest.emplace(group, number);
            const auto& rival = part_components_.component(found->second);
            if (!first && component.extent.length > rival.extent.length) found->second = number;
        }
    }
    groups_ = largest.size();
    std::vector<std::uint32_t> kept;
    kept.reserve(largest.size());
    for (const auto& [group, number] : largest) kept.push_back(number);
    std::sort(kept.begin(), kept.end());
    return kept;
}

Island IslandSurveyor::describe(const RunComponents::Component& component) const {
    const ComponentExtent& extent = component.extent;
    Island island;
    island.volume = volume(extent.length);
    island.box =
        unite(grid_.box({extent.first_layer, extent.first_row, extent.along.begin, extent.along.end}),
              grid_.box({extent.last_layer, extent.last_row, extent.along.begin, extent.along.end}));
    island.first_layer = extent.first_layer;
    island.end_layer = extent.last_layer + 1;
    island.dropped = component.run_count <= options_.max_runs;
    return island;
}

IslandSurvey IslandSurveyor::result() {
    IslandSurvey survey;
    IslandReport& report = survey.report;
    const auto kept = largest_of_groups();
    report.bodies = groups_;
    std::int64_t part_length = 0, island_length = 0;
    std::vector<PlacedRun> runs;
    for (const std::uint32_t number : part_components_.numbers()) {
        const auto& component = part_components_.component(number);
        ++report.components;
        part_length += component.extent.length;
        if (std::binary_search(kept.begin(), kept.end(), number)) continue;
        ++report.count;
        island_length += component.extent.length;
        report.largest.push_back(describe(component));
        if (!report.largest.back().dropped) ++report.too_large;
        for (PlacedRun run : component.runs) {
            const std::int32_t middle = run.layer;
            for (int k = -growth_.layers; k <= growth_.layers; ++k) {
                run.layer = middle + k;
                runs.push_back(run);
            }
        }
    }
    report.part_volume = volume(part_length);
    report.volume = volume(island_length);
    std::stable_sort(report.largest.begin(), report.largest.end(),
                     [](const Island& a, const Island& b) { return a.volume > b.volume; });
    if (report.largest.size() > options_.report_largest) report.largest.resize(options_.report_largest);
    survey.dropped = std::make_shared<RunBoxes>(grid_, std::move(runs));
    return survey;
}

void check(const Job& job, const IslandSurveyOptions& options) {
    const Interval suited = survey_pitch_range(job);
    if (options.pitch > 0 && suited.contains(options.pitch)) return;
    const bool printable = std::abs(options.pitch) < 1e9;
    throw InputError("island survey: the pitch" +
                     (printable ? " of " + format_number(options.pitch, 9) + " mm" : std::string()) +
                     " does not suit the part; accepted: " + format_number(suited.lo, 9) + " to " +
                     format_number(suited.hi, 9) +
                     " mm, that is at most 2^20 rows and columns, and 16 layers in a pitch");
}

}  // namespace

IslandSurvey survey_islands(const Job& given, const FieldPtr& body, const IslandSurveyOptions& options) {
    const Job job = in_equal_layers(given);
    check(job, options);
    IslandSurveyor surveyor(job, body, options);
    survey_layers(job, surveyor, options);
    IslandSurvey survey = surveyor.result();
    for (Island& island : survey.report.largest) {
        island.first_layer = given.layers.layer_at(job.layers.middle(island.first_layer));
        island.end_layer = given.layers.layer_at(job.layers.middle(island.end_layer - 1)) + 1;
    }
    return survey;
}

}  // namespace lamella
