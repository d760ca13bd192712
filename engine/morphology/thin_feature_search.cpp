// ThinFeatureSearch: finds ball centres run by run where none is known nearby, then all of them around the
// points that are still undecided.
#include "engine/morphology/thin_feature_search.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

/// If at least one in so many runs of a line is undecided, the runs are handled together, otherwise one by
/// one.
constexpr std::size_t few_share = 4;

/// Calls visit(number) for the runs of a line that meet an interval.
template <typename Visit>
void for_runs_meeting(const RunRows& rows, std::size_t line, const Run& stretch, Visit visit) {
    const std::span<const Run> runs = rows.line(line);
    const Run *run = first_ending_behind(runs, stretch.begin), *const end = runs.data() + runs.size();
    auto number = static_cast<std::size_t>(run - rows.runs().data());
    for (; run != end && run->begin < stretch.end; ++run) visit(number++);
}

}  // namespace

ThinFeatureSearch::ThinFeatureSearch(const LayerLattice& lattice, const Thinness& thinness, FeatureKind kind)
    : kind_(kind),
      lines_(lattice.lines),
      margin_(margin_of(thinness, lattice.row_pitch)),
      fitting_(lattice, thinness.radius),
      near_(lattice, thinness.radius + thinness.slack),
      footprint_(near_),
      beyond_(static_cast<std::size_t>(fitting_.layers() + near_.layers())),
      next_(beyond_) {
    push_beyond();
}

void ThinFeatureSearch::push(const RunRows& layer) {
    if (layer.lines() != lines_) throw FaultError("a layer has other lines than the lattice");
    ++to_come_;
    push_slab(widened(layer, margin_), true);
}

/// Pushes empty layers: the void extends beyond the given layers, and balls fit there.
void ThinFeatureSearch::push_beyond() {
    for (std::size_t i = 0; i < beyond_; ++i) push_slab(empty_rows(lines_ + 2 * margin_), false);
}

void ThinFeatureSearch::push_slab(RunRows solid, bool is_judged) {
    const std::size_t index = first_ + slabs_.size();
    RunRows of = complement(solid, -unbounded, unbounded), beside = std::move(solid);
    if (kind_ == FeatureKind::wall) std::swap(of, beside);
    UndecidedRuns open(of, static_cast<std::int32_t>(index), margin_, is_judged ? lines_ : 0);
    BallCentersByRun centers(of);
    std::vector<NumberedRun> left;
    if (is_judged) {
        for (std::size_t l = margin_; l < margin_ + lines_; ++l) {
            const std::size_t first = first_run(of, l);
            for (std::size_t k = 0; k < of.line(l).size(); ++k) left.push_back({l, first + k});
        }
    }
    slabs_.push_back(
        {std::move(of), std::move(beside), std::move(open), std::move(left), std::move(centers)});
    for (; found_ + static_cast<std::size_t>(fitting_.layers()) <= index; ++found_) find_centers(found_);
}

/// Applies the ball centres known to the runs of an adjacent line to `run`.
void ThinFeatureSearch::inherit_from(std::size_t index, const NumberedRun& run, std::size_t other,
                                     std::size_t other_line) {
    Slab& here = slab(index);
    if (!here.open.is_open(run.number) || other_line >= here.of.lines() || !is_kept(other)) return;
    const Slab& there = slab(other);
    if (!there.open.knows_any(other_line)) return;
    here.open.inherit_from(there.open, there.of, other_line, centers_, here.of.runs()[run.number], run,
                           footprint_);
}

/// Marks the points of a run within reach of the ball centre as decided, where they are at its undecided
/// ends.
void ThinFeatureSearch::decide_within(const BallCenter& center, std::size_t index, const NumberedRun& run) {
    UndecidedRuns& open = slab(index).open;
    if (open.may_close(center, run, footprint_))
        open.decide_within(centers_.add(center), centers_, run, footprint_);
}

/// Finds and stores the ball centres in a run. The result is valid until the next search.
std::span<const Run> ThinFeatureSearch::search(std::size_t index, const NumberedRun& run) {
    Slab& here = slab(index);
    const Run& whole = here.of.runs()[run.number];
    const RoundedExtent& reach = fitting_.lines().front().reach;
    if (whole.end - whole.begin <= reach.back + reach.ahead) {
        here.centers.put(run.number, run.line, {});
        return {};
    }
    beside_.clear();
    for (int k = -fitting_.layers(); k <= fitting_.layers(); ++k) {
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(index) + k - static_cast<std::ptrdiff_t>(first_);
        const bool is_there = i >= 0 && i < static_cast<std::ptrdiff_t>(slabs_.size());
        beside_.push_back(is_there ? &slabs_[static_cast<std::size_t>(i)].beside : nullptr);
    }
    const std::span<const Run> found = remainder_.difference(whole, run.line, beside_, fitting_);
    here.centers.put(run.number, run.line, found);
    return found;
}

/// Searches those runs of a layer that stay undecided by the ball centres that their neighbours know.
void ThinFeatureSearch::find_centers(std::size_t index) {
    Slab& here = slab(index);
    if (index > first_) {
        const Slab& below = slab(index - 1);
        here.open.inherit_from(below.open, below.of, centers_, here.of, footprint_);
    }
    const auto forget_closed = [](Slab& slab) {
        std::erase_if(slab.left, [&](const NumberedRun& run) { return !slab.open.is_open(run.number); });
        slab.left.shrink_to_fit();
    };
    forget_closed(here);
    const auto ask_ahead = [&] {
        std::for_each(here.left.rbegin(), here.left.rend(),
                      [&](const NumberedRun& run) { inherit_from(index, run, index, run.line + 1); });
    };
    for (const NumberedRun& run : here.left) inherit_from(index, run, index, run.line - 1);
    ask_ahead();
    for (const NumberedRun& run : here.left) {
        inherit_from(index, run, index, run.line - 1);
        if (!here.open.is_open(run.number)) continue;
        for (const Run& found : search(index, run))
            decide_within({static_cast<std::int32_t>(index), static_cast<std::int32_t>(run.line), found},
                          index, run);
    }
    ask_ahead();
    forget_closed(here);
    for (std::size_t k = index; k-- > first_;) {
        Slab& below = slab(k);
        for (const NumberedRun& run : below.left) inherit_from(k, run, k + 1, run.line);
        const std::size_t before = below.left.size();
        forget_closed(below);
        if (below.left.size() == before) break;
    }
}

/// Subtracts the reach of all ball centres from `left`, the undecided parts of `runs` on one line. Runs
/// nearby that were not searched yet are searched first.
void ThinFeatureSearch::look_near(std::size_t index, std::span<const NumberedRun> runs, RunDifference& left) {
    const std::size_t line = runs.front().line;
    const bool are_many = few_share * runs.size() > slab(index).of.line(line).size();
    for (const BallLines::Line& on : near_.lines()) {
        if (left.empty()) return;
        const std::size_t other = index + static_cast<std::size_t>(on.layer),
                          row = line + static_cast<std::size_t>(on.row);
        Slab& there = slab(other);
        if (row >= there.of.lines()) continue;
        if (!there.centers.all_searched(row)) {
            const auto search_in = [&](const Run& stretch) {
                for_runs_meeting(there.of, row, stretch, [&](std::size_t number) {
                    if (!there.centers.is_searched(number)) search(other, {row, number});
                });
            };
            if (are_many) {
                search_in({-unbounded - 1, unbounded + 1});
            } else {
                for (const Run& run : left.all())
                    search_in({run.begin - on.reach.ahead, run.end + on.reach.back});
            }
        }
        const std::span<const Run> centers = there.centers.in_line(row);
        if (centers.empty()) continue;
        left.subtract(centers, on.reach);
        if (are_many) continue;
        // Neighbouring runs will inherit these centres.
        for (const NumberedRun& run : runs) {
            const Run open = slab(index).open.part(run.number);
            const Run* center = first_ending_behind(centers, open.begin - on.reach.ahead);
            for (; center != centers.data() + centers.size() && center->begin < open.end + on.reach.back;
                 ++center)
                decide_within({static_cast<std::int32_t>(other), static_cast<std::int32_t>(row), *center},
                              index, run);
        }
    }
}

/// Appends the too thin points of a layer, without the margin's lines.
void ThinFeatureSearch::thin_of(std::size_t index, RunRows& out) {
    Slab& here = slab(index);
    RunDifference left;
    std::vector<NumberedRun> of_line;
    std::vector<Run> open;
    for (auto run = here.left.begin(); run != here.left.end();) {
        const std::size_t line = run->line;
        of_line.clear();
        open.clear();
        for (; run != here.left.end() && run->line == line; ++run) {
            for (const std::size_t row : {line - 1, line + 1}) inherit_from(index, *run, index, row);
            for (const std::size_t other : {index - 1, index + 1}) inherit_from(index, *run, other, line);
            if (!here.open.is_open(run->number)) continue;
            of_line.push_back(*run);
            open.push_back(here.open.part(run->number));
        }
        if (of_line.empty()) continue;
        left.assign(open);
        look_near(index, of_line, left);
        out.end_lines(line - margin_ - out.lines());
        for (const Run& thin : left.all()) out.push(thin.begin, thin.end);
    }
    out.end_lines(lines_ - out.lines());
}

bool ThinFeatureSearch::pop(RunRows& out) {
    if (to_come_ == 0 || next_ + beyond_ >= first_ + slabs_.size()) return false;
    out.clear();
    thin_of(next_, out);
    ++next_;
    --to_come_;
    for (; first_ + beyond_ < next_; ++first_) slabs_.pop_front();
    centers_.forget_below(static_cast<std::int32_t>(first_) - near_.layers());
    return true;
}

}  // namespace lamella
