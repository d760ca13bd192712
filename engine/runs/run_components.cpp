// Labelling within a layer, and union-find over the layers.
#include "engine/runs/run_components.h"

#include <algorithm>
#include <cassert>

#include "engine/base/archive.h"

namespace lamella {
namespace {

bool begins_first(const LabelledRun& a, const LabelledRun& b) { return a.begin < b.begin; }

/// Appends the union of the dilated runs of lines [first, last] as one row, each run a component of its own.
void append_grown_row(const RunRows& lines, int first, int last, std::int32_t units,
                      std::vector<LabelledRun>& row, LabelledLayer& out) {
    row.clear();
    for (int l = first; l <= last; ++l) {
        const auto sorted = static_cast<std::ptrdiff_t>(row.size());
        for (const Run& run : lines.line(static_cast<std::size_t>(l))) {
            row.push_back({run.begin - units, run.end + units, 0});
        }
        std::inplace_merge(row.begin(), row.begin() + sorted, row.end(), begins_first);
    }
    const std::size_t start = out.runs.size();
    for (const LabelledRun& run : row) {
        if (out.runs.size() > start && run.begin <= out.runs.back().end) {
            out.runs.back().end = std::max(out.runs.back().end, run.end);
        } else {
            out.runs.push_back({run.begin, run.end, static_cast<std::uint32_t>(out.runs.size())});
        }
    }
    out.starts.push_back(static_cast<std::uint32_t>(out.runs.size()));
}

/// Provisional labels of a layer's runs, assigned row by row.
class PartNumbers {
  public:
    /// Returns the label of the next run: that of the first run it touches in the previous row, or a new one.
    std::uint32_t next(std::int32_t begin, std::int32_t end) {
        const LabelledRun* const before_end = before_.data() + before_.size();
        while (first_ != before_end && first_->end < begin) ++first_;
        if (first_ == before_end || first_->begin > end) return sets_.add();
        const std::uint32_t number = first_->component;
        for (const LabelledRun* other = first_ + 1; other != before_end && other->begin <= end; ++other) {
            if (number != other->component) sets_.join(number, other->component);
        }
        return number;
    }
    /// Starts a row; `before` is the previous one.
    void begin_row(std::span<const LabelledRun> before) {
        before_ = before;
        first_ = before.data();
    }
    DisjointSets& sets() { return sets_; }

  private:
    DisjointSets sets_;  // most runs take the label of one before them, which nothing else joins
    std::span<const LabelledRun> before_;
    const LabelledRun* first_ = nullptr;  // first run of before_ that a later run may still touch
};

/// Final numbers of a layer's components.
struct Numbering {
    std::vector<std::uint32_t> numbers;  ///< for each provisional label its component, by first appearance
    std::uint32_t count = 0;             ///< number of components
};

Numbering numbering_of(DisjointSets& sets) {
    Numbering numbering;
    numbering.numbers.resize(sets.size());
    for (std::uint32_t i = 0; i < sets.size(); ++i) {
        const std::uint32_t root = sets.find(i);
        numbering.numbers[i] = root == i ? numbering.count++ : numbering.numbers[root];
    }
    return numbering;
}

std::span<const LabelledRun> row_before(const LabelledLayer& layer, std::size_t r) {
    if (r == 0) return {};
    return std::span(layer.runs).subspan(layer.starts[r - 1], layer.starts[r] - layer.starts[r - 1]);
}

/// Gives each run a provisional label and returns the final number of each label.
Numbering number_parts(LabelledLayer& layer) {
    PartNumbers parts;
    for (std::size_t r = 0; r + 1 < layer.starts.size(); ++r) {
        parts.begin_row(row_before(layer, r));
        for (std::size_t i = layer.starts[r]; i < layer.starts[r + 1]; ++i)
            layer.runs[i].component = parts.next(layer.runs[i].begin, layer.runs[i].end);
    }
    return numbering_of(parts.sets());
}

}  // namespace

void ComponentExtent::include(const ComponentExtent& other) {
    length += other.length;
    along = {std::min(along.begin, other.along.begin), std::max(along.end, other.along.end)};
    first_row = std::min(first_row, other.first_row);
    last_row = std::max(last_row, other.last_row);
    first_layer = std::min(first_layer, other.first_layer);
    last_layer = std::max(last_layer, other.last_layer);
}

void LabelledLayer::serialize(Archive& parcel) {
    parcel(first_row, starts, runs, components, owners);
    if (!parcel.unpacks() || (starts.empty() && runs.empty())) return;  // where nothing was labelled
    check_row_starts(starts, runs.size());
    const auto is_known = [&](std::uint32_t component) { return component < components.size(); };
    if (!std::ranges::all_of(runs, is_known, &LabelledRun::component) ||
        !std::ranges::all_of(owners, is_known))
        throw FaultError("a layer's parcel has runs of unknown components");
}

namespace {

/// Labels without growth: each run stays as it is.
LabelledLayer label_as_it_is(const RunRows& rows, int layer) {
    LabelledLayer out;
    out.starts.reserve(rows.lines() + 1);
    out.starts.push_back(0);
    out.runs.reserve(rows.runs().size());
    PartNumbers parts;
    const auto end_rows_before = [&](std::size_t l) {
        out.starts.resize(l + 1, static_cast<std::uint32_t>(out.runs.size()));
    };
    for (std::size_t l = rows.line_with_runs(0); l < rows.lines(); l = rows.line_with_runs(l + 1)) {
        end_rows_before(l);
        parts.begin_row(row_before(out, l));
        for (const Run& run : rows.line(l))
            out.runs.push_back({run.begin, run.end, parts.next(run.begin, run.end)});
        end_rows_before(l + 1);
    }
    end_rows_before(rows.lines());
    const Numbering numbering = numbering_of(parts.sets());
    out.components.resize(numbering.count);
    out.owners.resize(out.runs.size());
    std::size_t i = 0;
    for (std::size_t l = rows.line_with_runs(0); l < rows.lines(); l = rows.line_with_runs(l + 1)) {
        const int r = static_cast<int>(l);
        for (const std::size_t end = out.starts[l + 1]; i < end; ++i) {
            LabelledRun& run = out.runs[i];
            run.component = numbering.numbers[run.component];
            ComponentExtent& extent = out.components[run.component];
            extent.length += run.end - run.begin;
            extent.along = {std::min(extent.along.begin, run.begin), std::max(extent.along.end, run.end)};
            if (r < extent.first_row) extent.first_row = r;
            extent.last_row = r;
            out.owners[i] = run.component;
        }
    }
    for (ComponentExtent& extent : out.components) extent.first_layer = extent.last_layer = layer;
    return out;
}

}  // namespace

LabelledLayer label_layer(const RunRows& rows, int layer, const Growth& growth) {
    if (growth.units == 0 && growth.rows == 0) return label_as_it_is(rows, layer);
    LabelledLayer out;
    out.first_row = -growth.rows;
    out.starts.push_back(0);
    const int count = static_cast<int>(rows.lines());
    std::vector<LabelledRun> row;
    for (int r = -growth.rows; r < count + growth.rows; ++r) {
        append_grown_row(rows, std::max(r - growth.rows, 0), std::min(r + growth.rows, count - 1),
                         growth.units, row, out);
    }
    const Numbering numbering = number_parts(out);
    for (LabelledRun& run : out.runs) run.component = numbering.numbers[run.component];
    out.components.resize(numbering.count);
    for (int r = 0; r < count; ++r) {
        for_touching(
            rows.line(static_cast<std::size_t>(r)), out.row(r),
            [&](const Run& run, const LabelledRun& grown) {
                out.components[grown.component].include({run.end - run.begin, run, r, r, layer, layer});
                out.owners.push_back(grown.component);
            });
    }
    assert(out.owners.size() == rows.runs().size());
    return out;
}

RunComponents::RunComponents(const Growth& growth, std::size_t max_runs)
    : reach_(2 * growth.layers + 1), max_runs_(max_runs) {}

std::uint32_t RunComponents::find(std::uint32_t number) { return sets_.find(number); }

std::vector<std::uint32_t> RunComponents::add(LabelledLayer layer, int index) {
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> numbers(layer.components.size(), none);
    const auto link = [&](const LabelledRun& run, const LabelledRun& older) {
        std::uint32_t& number = numbers[run.component];
        if (number == older.component) return;
        if (number == none) {
            number = older.component;
        } else {
            unite(number, older.component);
        }
    };
    for (const LabelledLayer& older : recent_) {
        for (int r = layer.first_row; r < layer.first_row + layer.rows(); ++r) {
            if (layer.row(r).empty()) continue;
            for (int near = r - 1; near <= r + 1; ++near) {
                for_touching(layer.row(r), older.row(near), link);
            }
        }
    }
    for (std::size_t c = 0; c < numbers.size(); ++c) {
        if (numbers[c] == none) {
            numbers[c] = sets_.add();
            components_.push_back(std::make_unique<Component>());
        }
        numbers[c] = find(numbers[c]);
        components_[numbers[c]]->extent.include(layer.components[c]);
    }
    for (int r = layer.first_row; r < layer.first_row + layer.rows(); ++r) {
        for (const LabelledRun& run : layer.row(r)) {
            Component& component = *components_[numbers[run.component]];
            if (++component.run_count <= max_runs_) {
                component.runs.push_back({index, r, run.begin, run.end});
                ++runs_kept_;
            } else {
                forget_runs(component);
            }
        }
    }
    for (LabelledRun& run : layer.runs) run.component = numbers[run.component];
    recent_.push_back(std::move(layer));
    if (recent_.size() > static_cast<std::size_t>(reach_)) recent_.pop_front();
    return numbers;
}

void RunComponents::unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    const std::uint32_t low = std::min(a, b), high = std::max(a, b);
    Component& kept = *components_[low];
    Component& joined = *components_[high];
    kept.extent.include(joined.extent);
    kept.run_count += joined.run_count;
    if (kept.run_count > max_runs_) {
        forget_runs(kept);
        forget_runs(joined);
    } else {
        if (kept.runs.size() < joined.runs.size()) kept.runs.swap(joined.runs);
        kept.runs.insert(kept.runs.end(), joined.runs.begin(), joined.runs.end());
    }
    for (const std::uint32_t group : joined.groups) mark(low, group);
    sets_.join(low, high);
    components_[high].reset();
}

void RunComponents::forget_runs(Component& component) {
    runs_kept_ -= component.runs.size();
    component.runs = {};
}

void RunComponents::mark(std::uint32_t number, std::uint32_t group) {
    auto& groups = components_[find(number)]->groups;
    const auto place = std::lower_bound(groups.begin(), groups.end(), group);
    if (place == groups.end() || *place != group) groups.insert(place, group);
}

std::vector<std::uint32_t> RunComponents::numbers() const {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < components_.size(); ++i) {
        if (components_[i]) numbers.push_back(i);
    }
    return numbers;
}

}  // namespace lamella
