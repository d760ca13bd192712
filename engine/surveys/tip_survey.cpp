// Tips are nodes, numbered as they begin, after the pieces on the bed: the oldest of several has the lowest
// number.
#include "engine/surveys/tip_survey.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "engine/base/disjoint_sets.h"
#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/layers/survey_rows.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

using Node = std::uint32_t;

/// Returns the part of the rows that rectangles within them cover, of so many rows and so long, run units.
RunRows opened(const RunRows& rows, int height, std::int32_t length) {
    const auto lines = static_cast<int>(rows.lines());
    RunRows inner = rows, outer;
    for (int k = 1; k < height; ++k) {
        RunRows next;
        for (int l = 0; l < lines; ++l) {
            const bool has_next = l + k < lines;
            const auto line = has_next ? rows.line(static_cast<std::size_t>(l + k)) : std::span<const Run>();
            intersect_line(inner.line(static_cast<std::size_t>(l)), line, next);
        }
        inner = std::move(next);
    }
    for (int l = 0; l < lines; ++l) {
        std::vector<Run> line;
        for (int k = std::max(l - height + 1, 0); k <= l; ++k) {
            for (const Run& run : inner.line(static_cast<std::size_t>(k))) {
                if (run.end - run.begin >= length) line.push_back(run);
            }
        }
        std::ranges::sort(line, {}, &Run::begin);
        for (const Run& run : line) outer.push(run.begin, run.end);
        outer.end_line();
    }
    return outer;
}

/// The pieces of a layer that hold, and the slivers beside them, which touch some of these, or none.
struct LayerPieces {
    RunRows rows;
    LabelledLayer firm, slivers;
    std::vector<std::vector<std::uint32_t>> beside{};  ///< by sliver: the firm pieces that it touches
    std::vector<Node> firm_nodes{}, sliver_nodes{};    ///< that the components belong to

    int rows_count() const { return static_cast<int>(rows.lines()); }
};

struct PiecesProduct : LayerProduct {
    LayerPieces pieces;
};

/// A tip as far as the layers so far show it.
struct GrowingTip {
    HangingTip found;
    double volume = 0;
    bool is_high = false;
    std::vector<PlacedRun> runs{};  ///< grown; none once it is high
};

/// Calls visit(a, b) for the components of two layers whose runs overlap or touch, in the same row or the
/// next.
template <typename Visit>
void for_touching_pieces(const LabelledLayer& a, const LabelledLayer& b, const Visit& visit) {
    for (int r = a.first_row; r < a.first_row + a.rows(); ++r) {
        if (a.row(r).empty()) continue;
        for (const int aside : {-1, 0, 1}) {
            for_touching(a.row(r), b.row(r + aside), [&](const LabelledRun& run, const LabelledRun& other) {
                visit(run.component, other.component);
            });
        }
    }
}

template <typename T>
void sort_out(std::vector<T>& list) {
    std::ranges::sort(list);
    const auto rest = std::ranges::unique(list);
    list.erase(rest.begin(), rest.end());
}

/// Makes one line of the runs, which come in any order.
RunRows line_of(std::vector<Run> runs) {
    std::ranges::sort(runs, {}, &Run::begin);
    RunRows line;
    for (const Run& run : runs) line.push(run.begin, run.end);
    line.end_line();
    return line;
}

/// Calls visit(run) for the runs of a row that belong to a node, or for all others.
template <typename Visit>
void for_runs(const LayerPieces& layer, int row, Node node, bool own, const Visit& visit) {
    for (const LabelledRun& run : layer.firm.row(row)) {
        if ((layer.firm_nodes[run.component] == node) == own) visit(run);
    }
    for (const LabelledRun& run : layer.slivers.row(row)) {
        if ((layer.sliver_nodes[run.component] == node) == own) visit(run);
    }
}

/// Returns the part of row r that a node's runs cover once they are grown by a pixel and a row, kept off the
/// others of that row.
RunRows grown_row(const LayerPieces& layer, Node node, int r) {
    std::vector<Run> grown, others, own;
    const auto into = [](std::vector<Run>& list, std::int32_t by) {
        return [&list, by](const LabelledRun& run) { list.push_back({run.begin - by, run.end + by}); };
    };
    for (const int aside : {-1, 0, 1}) for_runs(layer, r + aside, node, true, into(grown, run_unit));
    for_runs(layer, r, node, false, into(others, run_unit / 2));
    for_runs(layer, r, node, true, into(own, 0));
    return united(without(line_of(std::move(grown)), line_of(std::move(others))), line_of(std::move(own)));
}

class TipSurveyor : public LayerPass {
  public:
    TipSurveyor(const Job& job, const TipSurveyOptions& options)
        : plan_(job.layers),
          options_(options),
          band_(rows_over(job.bounds.rect(), options.pitch)),
          least_rows_(1 + static_cast<int>(std::ceil(options.contact / options.pitch - 1e-9))),
          least_length_(round_run(options.contact / options.pitch * run_unit)) {}

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;

    TipSurvey result();

  private:
    /// Which piece of the new layer touches which node: first the firm pieces, then the slivers.
    using Contact = std::pair<std::uint32_t, Node>;

    std::vector<Contact> contacts_with_below(const LayerPieces& layer) const;
    std::vector<Contact> firm_contacts(const LayerPieces& layer) const;
    void own_pieces(LayerPieces& layer);
    void joint(Node a, Node b);
    void include(Node number, const LayerPieces& pieces, const Layer& layer);
    void keep_runs(GrowingTip& tip, Node number, const LayerPieces& pieces, int layer,
                   std::pair<int, int> rows);
    void forget_runs(GrowingTip& tip);
    bool is_tip(Node node) const { return node >= held_; }
    bool is_low(Node node) const { return is_tip(node) && !tips_.at(node).is_high; }
    std::vector<Node> tips_that_hold_together();

    const LayerPlan& plan_;
    const TipSurveyOptions& options_;
    RowBand band_;
    int least_rows_;             // of a contact that holds
    std::int32_t least_length_;  // of its runs
    LayerPieces below_;          // the last layer
    DisjointSets sets_;          // of nodes: those held are joined where they meet
    Node held_ = 0;              // nodes before it are held by the bed
    std::map<Node, GrowingTip> tips_;
    std::set<std::pair<Node, Node>> joints_;  // nodes that touch, not both held
    std::size_t runs_kept_ = 0;
};

std::unique_ptr<LayerProduct> TipSurveyor::render(const Layer& layer) const {
    auto product = std::make_unique<PiecesProduct>();
    LayerPieces& pieces = product->pieces;
    Scratch scratch;
    pieces.rows = all_rows(layer.part(), band_, scratch);
    const RunRows firm = opened(pieces.rows, least_rows_, least_length_);
    pieces.firm = label_layer(firm, layer.index(), Growth{});
    pieces.slivers = label_layer(without(pieces.rows, firm), layer.index(), Growth{});
    pieces.beside.resize(pieces.slivers.components.size());
    for_touching_pieces(pieces.slivers, pieces.firm, [&](std::uint32_t sliver, std::uint32_t piece) {
        pieces.beside[sliver].push_back(piece);
    });
    for (auto& list : pieces.beside) sort_out(list);
    product->area =
        static_cast<double>(pieces.rows.total_length()) / run_unit * options_.pitch * options_.pitch;
    return product;
}

/// Returns what touches what at all, each once. Contacts of a sliver are those of the first piece beside it.
std::vector<TipSurveyor::Contact> TipSurveyor::contacts_with_below(const LayerPieces& layer) const {
    const auto firm_count = static_cast<std::uint32_t>(layer.firm.components.size());
    const auto piece_of = [&](std::uint32_t sliver) {
        return layer.beside[sliver].empty() ? firm_count + sliver : layer.beside[sliver].front();
    };
    std::vector<Contact> contacts;
    for_touching_pieces(layer.firm, below_.firm, [&](std::uint32_t a, std::uint32_t b) {
        contacts.emplace_back(a, below_.firm_nodes[b]);
    });
    for_touching_pieces(layer.firm, below_.slivers, [&](std::uint32_t a, std::uint32_t b) {
        contacts.emplace_back(a, below_.sliver_nodes[b]);
    });
    for_touching_pieces(layer.slivers, below_.firm, [&](std::uint32_t a, std::uint32_t b) {
        contacts.emplace_back(piece_of(a), below_.firm_nodes[b]);
    });
    for_touching_pieces(layer.slivers, below_.slivers, [&](std::uint32_t a, std::uint32_t b) {
        contacts.emplace_back(piece_of(a), below_.sliver_nodes[b]);
    });
    sort_out(contacts);
    return contacts;
}

/// Returns which firm piece lies on which node by enough to be held.
std::vector<TipSurveyor::Contact> TipSurveyor::firm_contacts(const LayerPieces& layer) const {
    std::vector<Contact> contacts;
    if (below_.rows.lines() == 0) return contacts;
    const RunRows overlap = opened(common(layer.rows, below_.rows), least_rows_, least_length_);
    for (std::size_t l = overlap.line_with_runs(0); l < overlap.lines(); l = overlap.line_with_runs(l + 1)) {
        const int r = static_cast<int>(l);
        const auto runs = overlap.line(l);
        std::vector<std::uint32_t> pieces(runs.size());
        const auto number = [&](const Run& run) { return static_cast<std::size_t>(&run - runs.data()); };
        for_touching(runs, layer.firm.row(r), [&](const Run& run, const LabelledRun& piece) {
            pieces[number(run)] = piece.component;
        });
        for_touching(runs, below_.firm.row(r), [&](const Run& run, const LabelledRun& piece) {
            contacts.emplace_back(pieces[number(run)], below_.firm_nodes[piece.component]);
        });
    }
    sort_out(contacts);
    return contacts;
}

/// Notes that two nodes touch.
void TipSurveyor::joint(Node a, Node b) {
    if (a == b) return;
    if (is_tip(a) || is_tip(b)) {
        joints_.emplace(std::min(a, b), std::max(a, b));
    } else {
        sets_.join(a, b);
    }
}

/// Gives each component of a layer to its node.
void TipSurveyor::own_pieces(LayerPieces& layer) {
    const bool is_lowest = sets_.size() == 0;
    const std::vector<Contact> touching = contacts_with_below(layer);
    const std::vector<Contact> holding = options_.contact > 0 ? firm_contacts(layer) : touching;
    const auto of = [](const std::vector<Contact>& contacts, std::uint32_t piece) {
        return std::ranges::equal_range(contacts, piece, {}, &Contact::first);
    };
    const auto own = [&](std::uint32_t piece, const std::vector<Contact>& holds) {
        const auto held_by = of(holds, piece);
        const Node node = held_by.empty() ? sets_.add() : held_by.front().second;
        if (is_lowest) held_ = node + 1;
        return node;
    };
    const auto firm_count = static_cast<std::uint32_t>(layer.firm.components.size());
    for (std::uint32_t i = 0; i < firm_count; ++i) layer.firm_nodes.push_back(own(i, holding));
    for (std::uint32_t i = 0; i < layer.beside.size(); ++i) {
        Node node = 0;
        for (const std::uint32_t piece : layer.beside[i]) node = std::max(node, layer.firm_nodes[piece]);
        layer.sliver_nodes.push_back(layer.beside[i].empty() ? own(firm_count + i, touching) : node);
    }
    const auto node_of = [&](std::uint32_t piece) {
        return piece < firm_count ? layer.firm_nodes[piece] : layer.sliver_nodes[piece - firm_count];
    };
    for (const auto& [piece, node] : touching) joint(node_of(piece), node);
    for (std::uint32_t i = 0; i < layer.beside.size(); ++i) {
        for (const std::uint32_t piece : layer.beside[i])
            joint(layer.sliver_nodes[i], layer.firm_nodes[piece]);
    }
}

void TipSurveyor::write(const Layer& layer, LayerProduct& product) {
    LayerPieces pieces = std::move(static_cast<PiecesProduct&>(product).pieces);
    own_pieces(pieces);
    std::vector<Node> tips;
    for (const auto* nodes : {&pieces.firm_nodes, &pieces.sliver_nodes})
        std::ranges::copy_if(*nodes, std::back_inserter(tips), [&](Node node) { return is_tip(node); });
    sort_out(tips);
    for (const Node tip : tips) include(tip, pieces, layer);
    below_ = std::move(pieces);
}

/// Adds what a layer has of a tip.
void TipSurveyor::include(Node number, const LayerPieces& pieces, const Layer& layer) {
    const int index = layer.index();
    const auto [at, is_new] = tips_.try_emplace(number);
    GrowingTip& tip = at->second;
    HangingTip& found = tip.found;
    if (is_new) found.first_layer = index;
    found.end_layer = index + 1;
    found.height = plan_.height(found.first_layer, found.end_layer);
    std::int64_t length = 0;
    Run longest{0, 0};
    int row = 0, first = pieces.rows_count(), last = -1;
    for (int r = 0; r < pieces.rows_count(); ++r) {
        for_runs(pieces, r, number, true, [&](const LabelledRun& run) {
            length += run.end - run.begin;
            first = std::min(first, r);
            last = r;
            if (run.end - run.begin <= longest.end - longest.begin) return;
            longest = {run.begin, run.end};
            row = r;
        });
    }
    const double area = static_cast<double>(length) / run_unit * options_.pitch * options_.pitch;
    tip.volume += area * layer.thickness();
    if (area > found.area) {
        found.area = area;
        found.at = dvec3(on_band(band_, 0.5 * (longest.begin + longest.end), row + 0.5), layer.z());
    }
    constexpr double rounding = 1e-9;
    if (index > found.first_layer && found.height > options_.height + rounding) {
        tip.is_high = true;
        forget_runs(tip);
    } else {
        keep_runs(tip, number, pieces, index, {first - 1, last + 1});
    }
}

/// Keeps the grown runs of a layer of a tip, from the first of the rows to the last.
void TipSurveyor::keep_runs(GrowingTip& tip, Node number, const LayerPieces& pieces, int layer,
                            std::pair<int, int> rows) {
    for (int r = rows.first; r <= rows.second; ++r) {
        const RunRows row = grown_row(pieces, number, r);
        for (const Run& run : row.runs()) tip.runs.push_back({layer, r, run.begin, run.end});
        runs_kept_ += row.runs().size();
    }
    if (runs_kept_ <= options_.max_kept) return;
    throw InputError(
        "too much of the part begins in the air to remember all of it; accepted: lower tips than " +
        format_number(options_.height, 6) + " mm, or a coarser pitch than " +
        format_number(options_.pitch, 6) + " mm");
}

void TipSurveyor::forget_runs(GrowingTip& tip) {
    runs_kept_ -= tip.runs.size();
    tip.runs = {};
}

/// Returns the low tips that connect what would be apart without them, ascending.
std::vector<Node> TipSurveyor::tips_that_hold_together() {
    DisjointSets groups(sets_.size());  // of low tips that touch
    for (const auto& [a, b] : joints_) {
        if (is_low(a) && is_low(b)) groups.join(a, b);
        if (!is_low(a) && !is_low(b)) sets_.join(a, b);
    }
    std::map<Node, std::vector<Node>> touched;  // what stays beside each group
    for (const auto& [a, b] : joints_) {
        if (is_low(a) == is_low(b)) continue;
        const auto [low, stays] = is_low(a) ? std::pair(a, b) : std::pair(b, a);
        touched[groups.find(low)].push_back(stays);
    }
    std::vector<Node> holding;
    for (const auto& [group, stays] : touched) {
        bool joins = false;
        for (const Node node : stays) joins |= sets_.join(stays.front(), node);
        if (joins) holding.push_back(group);
    }
    std::vector<Node> tips;
    for (const auto& [node, tip] : tips_) {
        if (!tip.is_high && std::ranges::binary_search(holding, groups.find(node))) tips.push_back(node);
    }
    return tips;
}

TipSurvey TipSurveyor::result() {
    TipSurvey survey;
    const std::vector<Node> holding = tips_that_hold_together();
    std::vector<PlacedRun> runs;
    for (auto& [node, tip] : tips_) {
        const bool holds = std::ranges::binary_search(holding, node);
        if (tip.is_high || holds) {
            ++(holds ? survey.holding : survey.higher);
            survey.kept.push_back(tip.found);
        } else {
            ++survey.trimmed;
            survey.volume += tip.volume;
            runs.insert(runs.end(), tip.runs.begin(), tip.runs.end());
        }
    }
    std::ranges::stable_sort(survey.kept, std::greater<>(), &HangingTip::height);
    if (survey.kept.size() > options_.report_kept) survey.kept.resize(options_.report_kept);
    const SurveyGrid grid{{band_.along_origin, band_.across_origin}, options_.pitch, 0, 1};
    survey.removed = std::make_shared<RunBoxes>(grid, std::move(runs));
    return survey;
}

}  // namespace

TipSurvey survey_tips(const Job& job, const TipSurveyOptions& options) {
    const Interval suited = survey_pitch_range(job);
    if (!(options.pitch > 0) || !suited.contains(options.pitch))
        throw InputError("tip survey: the pitch does not suit the part; accepted: " +
                         format_number(suited.lo, 9) + " to " + format_number(suited.hi, 9) + " mm");
    if (job.one_by_one())
        throw InputError("tip survey: parts that are printed one by one; accepted: one part");
    TipSurveyor surveyor(job, options);
    survey_layers(job, surveyor, options);
    return surveyor.result();
}

}  // namespace lamella
