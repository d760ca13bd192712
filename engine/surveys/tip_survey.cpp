// Tips are nodes, numbered as they begin, after the pieces on the bed: the oldest of several has the lowest
// number.
#include "engine/surveys/tip_survey.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "engine/base/disjoint_sets.h"
#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "engine/layers/survey_rows.h"
#include "engine/runs/row_sets.h"
#include "engine/surveys/tip_pieces.h"

namespace lamella {
namespace {

using Node = TipNode;

struct PiecesProduct : LayerProduct {
    LayerPieces pieces;
};

/// A tip as far as the layers so far show it.
struct GrowingTip {
    HangingTip found;
    double volume = 0;
    bool is_high = false, stays = false, hangs_by_hair = false;
    std::vector<Node> lies_on{}, beside{};  ///< what it touches where it begins, by too little to be held
    std::vector<PlacedRun> runs{};          ///< grown; none once it is high
};

/// The runs of a node in a layer.
struct NodeRuns {
    std::int64_t length = 0;  ///< of them together, run units
    Run longest{0, 0};
    int row = 0;               ///< of the longest
    int first = 0, last = -1;  ///< rows
};

NodeRuns runs_of(const LayerPieces& pieces, Node node) {
    NodeRuns found;
    found.first = pieces.rows_count();
    for (int r = 0; r < pieces.rows_count(); ++r) {
        for_runs(pieces, r, node, true, [&](const LabelledRun& run) {
            found.length += run.end - run.begin;
            found.first = std::min(found.first, r);
            found.last = r;
            if (run.end - run.begin <= found.longest.end - found.longest.begin) return;
            found.longest = {run.begin, run.end};
            found.row = r;
        });
    }
    return found;
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
    void add_firm_contacts(const LayerPieces& layer, const RunRows& overlap,
                           std::vector<Contact>& contacts) const;
    void add_sliver_contacts(const LayerPieces& layer, const RunRows& overlap,
                             std::vector<Contact>& contacts) const;
    std::vector<Contact> holding_contacts(const LayerPieces& layer) const;
    void own_pieces(LayerPieces& layer);
    void joint(Node a, Node b);
    dvec3 middle(const NodeRuns& runs, const Layer& layer) const;
    void include(Node number, const LayerPieces& pieces, const Layer& layer);
    void keep_runs(GrowingTip& tip, Node number, const LayerPieces& pieces, int layer,
                   std::pair<int, int> rows);
    void forget_runs(GrowingTip& tip);
    bool is_tip(Node node) const { return node >= held_; }
    /// 0 for what is held, 1 for tips that begin on a hair, 2 for those that begin in the air.
    int rank(Node node) const { return !is_tip(node) ? 0 : tips_.at(node).lies_on.empty() ? 2 : 1; }
    bool may_go(Node node) const { return is_tip(node) && !tips_.at(node).stays; }
    void keep_what_others_lie_on();
    void keep_what_holds_together();
    void find_held_by_hairs();

    const LayerPlan& plan_;
    const TipSurveyOptions& options_;
    RowBand band_;
    int least_rows_;             // of a contact that holds
    std::int32_t least_length_;  // of its runs
    LayerPieces below_;          // the last layer
    DisjointSets sets_;          // of nodes: those held are joined where they meet
    Node held_ = 0;              // nodes before it are held by the bed
    std::vector<dvec3> on_bed_;  // a point of each of these, mm
    std::map<Node, GrowingTip> tips_;
    std::set<std::pair<Node, Node>> joints_;  // nodes that touch, not both held
    std::size_t runs_kept_ = 0;
};

std::unique_ptr<LayerProduct> TipSurveyor::render(const Layer& layer) const {
    auto product = std::make_unique<PiecesProduct>();
    LayerPieces& pieces = product->pieces;
    Scratch scratch;
    pieces = tip_pieces(all_rows(layer.part(), band_, scratch), layer.index(), least_rows_, least_length_);
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
    sort_unique(contacts);
    return contacts;
}

/// Adds which firm piece shares something firm with which node.
void TipSurveyor::add_firm_contacts(const LayerPieces& layer, const RunRows& overlap,
                                    std::vector<Contact>& contacts) const {
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
}

/// Adds which sliver without a firm piece lies on which node with half of its area.
void TipSurveyor::add_sliver_contacts(const LayerPieces& layer, const RunRows& overlap,
                                      std::vector<Contact>& contacts) const {
    const auto firm_count = static_cast<std::uint32_t>(layer.firm.components.size());
    std::map<Contact, std::int64_t> lengths;
    for (std::size_t l = overlap.line_with_runs(0); l < overlap.lines(); l = overlap.line_with_runs(l + 1)) {
        const int r = static_cast<int>(l);
        for (const LabelledRun& sliver : layer.slivers.row(r)) {
            if (!layer.beside[sliver.component].empty()) continue;
            std::vector<Run> shared;
            for (const Run& run : overlap.line(l)) {
                const Run part{std::max(run.begin, sliver.begin), std::min(run.end, sliver.end)};
                if (part.begin < part.end) shared.push_back(part);
            }
            for_nodes(below_, r, shared, [&](const Run& run, Node node) {
                lengths[{firm_count + sliver.component, node}] += run.end - run.begin;
            });
        }
    }
    for (const auto& [contact, length] : lengths) {
        if (2 * length >= layer.slivers.components[contact.first - firm_count].length)
            contacts.push_back(contact);
    }
}

/// Returns which piece lies on which node by enough to be held, each once.
std::vector<TipSurveyor::Contact> TipSurveyor::holding_contacts(const LayerPieces& layer) const {
    std::vector<Contact> contacts;
    if (below_.rows.lines() == 0) return contacts;
    const RunRows overlap = common(layer.rows, below_.rows);
    add_firm_contacts(layer, opened(overlap, least_rows_, least_length_), contacts);
    add_sliver_contacts(layer, overlap, contacts);
    sort_unique(contacts);
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
    const auto first_new = static_cast<Node>(sets_.size());
    const std::vector<Contact> touching = contacts_with_below(layer);
    const std::vector<Contact> holding = options_.contact > 0 ? holding_contacts(layer) : touching;
    const auto of = [](const std::vector<Contact>& contacts,
                       std::uint32_t piece) -> std::span<const Contact> {
        const auto begin = std::ranges::lower_bound(contacts, piece, {}, &Contact::first);
        return {begin, std::ranges::upper_bound(begin, contacts.end(), piece, {}, &Contact::first)};
    };
    const auto own = [&](std::uint32_t piece) {
        const auto held_by = of(holding, piece);
        if (!held_by.empty()) {
            const auto age = [&](const Contact& contact) {
                return std::pair(rank(contact.second), contact.second);
            };
            return std::ranges::min_element(held_by, {}, age)->second;
        }
        const Node node = sets_.add();
        if (is_lowest) {
            held_ = node + 1;
        } else {
            for (const auto& [same, below] : of(touching, piece)) tips_[node].lies_on.push_back(below);
        }
        return node;
    };
    const auto firm_count = static_cast<std::uint32_t>(layer.firm.components.size());
    for (std::uint32_t i = 0; i < firm_count; ++i) layer.firm_nodes.push_back(own(i));
    for (std::uint32_t i = 0; i < layer.beside.size(); ++i) {
        Node node = std::numeric_limits<Node>::max();
        for (const std::uint32_t piece : layer.beside[i]) node = std::min(node, layer.firm_nodes[piece]);
        layer.sliver_nodes.push_back(layer.beside[i].empty() ? own(firm_count + i) : node);
    }
    const auto node_of = [&](std::uint32_t piece) {
        return piece < firm_count ? layer.firm_nodes[piece] : layer.sliver_nodes[piece - firm_count];
    };
    for (const auto& [piece, node] : touching) joint(node_of(piece), node);
    for (std::uint32_t i = 0; i < layer.beside.size(); ++i) {
        for (const std::uint32_t piece : layer.beside[i]) {
            const Node node = layer.firm_nodes[piece];
            joint(layer.sliver_nodes[i], node);
            if (is_lowest || node < first_new) continue;
            for (const std::uint32_t other : layer.beside[i]) {
                if (layer.firm_nodes[other] != node) tips_[node].beside.push_back(layer.firm_nodes[other]);
            }
        }
    }
}

void TipSurveyor::write(const Layer& layer, LayerProduct& product) {
    LayerPieces pieces = std::move(static_cast<PiecesProduct&>(product).pieces);
    own_pieces(pieces);
    if (on_bed_.empty()) {
        for (Node node = 0; node < held_; ++node) on_bed_.push_back(middle(runs_of(pieces, node), layer));
    }
    std::vector<Node> tips;
    for (const auto* nodes : {&pieces.firm_nodes, &pieces.sliver_nodes})
        std::ranges::copy_if(*nodes, std::back_inserter(tips), [&](Node node) { return is_tip(node); });
    sort_unique(tips);
    for (const Node tip : tips) include(tip, pieces, layer);
    below_ = std::move(pieces);
}

/// Returns the middle of a node's longest run, mm.
dvec3 TipSurveyor::middle(const NodeRuns& runs, const Layer& layer) const {
    return {on_band(band_, 0.5 * (runs.longest.begin + runs.longest.end), runs.row + 0.5), layer.z()};
}

/// Adds what a layer has of a tip.
void TipSurveyor::include(Node number, const LayerPieces& pieces, const Layer& layer) {
    const int index = layer.index();
    GrowingTip& tip = tips_[number];
    HangingTip& found = tip.found;
    if (found.end_layer == 0) found.first_layer = index;
    found.end_layer = index + 1;
    found.height = plan_.height(found.first_layer, found.end_layer);
    const NodeRuns runs = runs_of(pieces, number);
    const double area = static_cast<double>(runs.length) / run_unit * options_.pitch * options_.pitch;
    tip.volume += area * layer.thickness();
    const dvec3 within = middle(runs, layer);
    if (index == found.first_layer) found.begin = within;
    if (area > found.area) {
        found.area = area;
        found.at = within;
    }
    constexpr double rounding = 1e-9;
    const bool is_trimmed_anyway = index == found.first_layer && options_.height >= 0;
    if (!is_trimmed_anyway && found.height > options_.height + rounding) {
        tip.is_high = tip.stays = true;
        forget_runs(tip);
    } else {
        keep_runs(tip, number, pieces, index, {runs.first - tip_growth, runs.last + tip_growth});
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

/// Tips that stay keep those by which they hang together with what is held, however little that is.
void TipSurveyor::keep_what_others_lie_on() {
    std::vector<Node> open;
    for (const auto& [node, tip] : tips_) {
        if (tip.stays) open.push_back(node);
    }
    while (!open.empty()) {
        const GrowingTip& tip = tips_.at(open.back());
        open.pop_back();
        for (const auto* list : {&tip.lies_on, &tip.beside}) {
            for (const Node node : *list) {
                if (!may_go(node)) continue;
                tips_.at(node).stays = true;
                open.push_back(node);
            }
        }
    }
}

/// Finds the tips that hang together with what is held where they begin, by too little to be held by it.
void TipSurveyor::find_held_by_hairs() {
    const auto is_held = [&](Node node) { return !is_tip(node) || tips_.at(node).hangs_by_hair; };
    for (bool changed = true; changed;) {
        changed = false;
        for (auto& [node, tip] : tips_) {
            if (tip.hangs_by_hair ||
                (std::ranges::none_of(tip.lies_on, is_held) && std::ranges::none_of(tip.beside, is_held)))
                continue;
            tip.hangs_by_hair = changed = true;
        }
    }
}

/// Keeps the tips that connect what would be apart without them.
void TipSurveyor::keep_what_holds_together() {
    DisjointSets groups(sets_.size());  // of tips that may go and touch
    for (const auto& [a, b] : joints_) {
        if (may_go(a) && may_go(b)) groups.join(a, b);
        if (!may_go(a) && !may_go(b)) sets_.join(a, b);
    }
    std::map<Node, std::vector<Node>> touched;  // what stays beside each group
    for (const auto& [a, b] : joints_) {
        if (may_go(a) == may_go(b)) continue;
        const auto [goes, stays] = may_go(a) ? std::pair(a, b) : std::pair(b, a);
        touched[groups.find(goes)].push_back(stays);
    }
    std::set<Node> holding;
    for (const auto& [group, stays] : touched) {
        bool joins = false;
        for (const Node node : stays) joins |= sets_.join(stays.front(), node);
        if (joins) holding.insert(group);
    }
    for (auto& [node, tip] : tips_) tip.stays |= holding.contains(groups.find(node));
}

TipSurvey TipSurveyor::result() {
    TipSurvey survey;
    find_held_by_hairs();
    keep_what_others_lie_on();
    keep_what_holds_together();
    keep_what_others_lie_on();
    std::vector<PlacedRun> runs;
    for (auto& [node, tip] : tips_) {
        if (tip.stays) survey.begins.push_back(tip.found.begin);
        if (tip.is_high && tip.hangs_by_hair) continue;
        if (tip.stays) {
            ++(tip.is_high ? survey.higher : survey.holding);
            survey.kept.push_back(tip.found);
        } else {
            ++survey.trimmed;
            survey.volume += tip.volume;
            runs.insert(runs.end(), tip.runs.begin(), tip.runs.end());
        }
    }
    std::ranges::stable_sort(survey.kept, std::greater<>(), &HangingTip::height);
    if (survey.kept.size() > options_.report_kept) survey.kept.resize(options_.report_kept);
    survey.on_bed = std::move(on_bed_);
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
