// PeelCheck: least contacts of branches and pieces, layer by layer.
#include "engine/checks/peel_check.h"

#include <algorithm>

#include "engine/base/disjoint_sets.h"

namespace lamella {

namespace {

/// Calls visit(row, above, below, overlap) for the runs of a layer that lie above runs of the layer below.
template <typename Visit>
void for_overlaps(const LabelledLayer& layer, const LabelledLayer& below, Visit visit) {
    for (int r = layer.first_row; r < layer.first_row + layer.rows(); ++r) {
        for_touching(layer.row(r), below.row(r), [&](const LabelledRun& a, const LabelledRun& b) {
            const Run overlap{std::max(a.begin, b.begin), std::min(a.end, b.end)};
            if (overlap.begin < overlap.end) visit(r, a.component, b.component, overlap);
        });
    }
}

}  // namespace

/// `section`: the smallest below this contact; null if that is the contact itself.
void PeelCheck::Carrier::add(std::int64_t area, const SectionPtr& section) {
    contact += area;
    below += section ? section->length : area;
    if (section && (!largest || section->length > largest->length)) largest = section;
}

void PeelCheck::add(LayerSample& layer, PreparedRows /*prepared*/) {
    const LabelledLayer& printed = layer.printed();
    if (layer.index == 0) {
        stand_on_bed(printed);
    } else {
        hang_on_last(printed, layer.index);
    }
    judge(printed, layer.index);
    report_ended();
    last_ = printed;
}

void PeelCheck::finish() {
    branches_.clear();
    pieces_.clear();
    report_ended();
}

void PeelCheck::stand_on_bed(const LabelledLayer& layer) {
    for (std::size_t c = 0; c < layer.components.size(); ++c) {
        pieces_.push_back(std::make_shared<Section>());
        branches_.push_back({static_cast<std::uint32_t>(c), pieces_.back()});
    }
    std::vector<std::int64_t> longest(pieces_.size(), 0);
    for (int r = layer.first_row; r < layer.first_row + layer.rows(); ++r) {
        for (const LabelledRun& run : layer.row(r)) {
            pieces_[run.component]->patch.include(PlacedRun{0, r, run.begin, run.end});
            longest[run.component] = std::max<std::int64_t>(longest[run.component], run.end - run.begin);
        }
    }
    for (std::size_t c = 0; c < pieces_.size(); ++c)
        pieces_[c]->length = layer.components[c].length + longest[c];
}

/// Returns the contacts of each component, by the one above.
std::vector<PeelCheck::Contact> PeelCheck::contacts_with_last(const LabelledLayer& layer) const {
    constexpr std::size_t none = SIZE_MAX;
    std::vector<Contact> found;
    // Most components lie above one alone, so that their runs are joined here and few are left to sort.
    std::vector<std::size_t> latest(layer.components.size(), none);
    for_overlaps(layer, last_,
                 [&](int /*row*/, std::uint32_t above, std::uint32_t below, const Run& overlap) {
                     const std::int64_t length = overlap.end - overlap.begin;
                     const std::size_t at = latest[above];
                     if (at != none && found[at].below == below) {
                         found[at].include({above, below, length, length});
                     } else {
                         latest[above] = found.size();
                         found.push_back({above, below, length, length});
                     }
                 });
    std::ranges::sort(found, {}, [](const Contact& c) { return std::pair(c.above, c.below); });
    std::vector<Contact> contacts;
    for (const Contact& contact : found) {
        const bool is_known = !contacts.empty() && contacts.back().above == contact.above &&
                              contacts.back().below == contact.below;
        if (is_known) {
            contacts.back().include(contact);
        } else {
            contacts.push_back(contact);
        }
    }
    for (Contact& contact : contacts) contact.length += contact.longest;  // the row that may be missed
    return contacts;
}

/// Returns what carries each component of the next layer.
std::vector<PeelCheck::Carrier> PeelCheck::branch_carriers(std::span<const Contact> contacts,
                                                           std::size_t branches) const {
    std::vector<std::uint32_t> branches_above(branches_.size(), 0);
    for (const Contact& contact : contacts) ++branches_above[contact.below];
    std::vector<Carrier> carriers(branches);
    for (const Contact& contact : contacts) {
        const bool forks = branches_above[contact.below] > 1;
        carriers[contact.above].add(contact.length, forks ? nullptr : branches_[contact.below].section);
    }
    return carriers;
}

/// Numbers the pieces of the next layer's branches. Returns for each piece of the last layer its new number;
/// those that end have one of their own, which no branch has.
std::vector<std::uint32_t> PeelCheck::join_pieces(std::span<const Contact> contacts,
                                                  std::vector<Branch>& branches) const {
    const auto olds = static_cast<std::uint32_t>(pieces_.size());
    DisjointSets sets(olds + branches.size());
    for (const Contact& contact : contacts) sets.join(olds + contact.above, branches_[contact.below].piece);
    constexpr std::uint32_t none = UINT32_MAX;
    std::vector<std::uint32_t> numbers(sets.size(), none);  // by root
    std::uint32_t next = 0;
    const auto number_of = [&](std::uint32_t element) {
        std::uint32_t& number = numbers[sets.find(element)];
        if (number == none) number = next++;
        return number;
    };
    for (std::uint32_t c = 0; c < branches.size(); ++c) branches[c].piece = number_of(olds + c);
    std::vector<std::uint32_t> renumbered;
    renumbered.reserve(olds);
    for (std::uint32_t p = 0; p < olds; ++p) renumbered.push_back(number_of(p));
    return renumbered;
}

void PeelCheck::hang_on_last(const LabelledLayer& layer, int index) {
    const std::vector<Contact> contacts = contacts_with_last(layer);
    std::vector<Branch> branches(layer.components.size());
    const std::vector<Carrier> carriers = branch_carriers(contacts, branches.size());
    const std::vector<std::uint32_t> renumbered = join_pieces(contacts, branches);
    std::uint32_t piece_count = 0;
    for (const Branch& branch : branches) piece_count = std::max(piece_count, branch.piece + 1);
    std::vector<Carrier> piece_carriers(piece_count);
    for (std::size_t p = 0; p < pieces_.size(); ++p)
        if (renumbered[p] < piece_count) piece_carriers[renumbered[p]].add(0, pieces_[p]);
    for (std::size_t c = 0; c < branches.size(); ++c) {
        branches[c].section = least_section(carriers[c], index);
        piece_carriers[branches[c].piece].contact += carriers[c].contact;
    }
    pieces_.clear();
    for (const Carrier& carrier : piece_carriers) pieces_.push_back(least_section(carrier, index));
    branches_ = std::move(branches);
    share_sections();
    draw_new_sections(layer, index);
}

/// Where a branch is the only one of its piece, and both sections are new and alike, they become one.
void PeelCheck::share_sections() {
    std::vector<std::uint32_t> branch_counts(pieces_.size(), 0);
    for (const Branch& branch : branches_) ++branch_counts[branch.piece];
    for (Branch& branch : branches_) {
        const SectionPtr& section = pieces_[branch.piece];
        const bool are_new = branch.section->worst == 0 && section->worst == 0;
        if (branch_counts[branch.piece] == 1 && are_new && branch.section->length == section->length)
            branch.section = section;
    }
}

PeelCheck::SectionPtr PeelCheck::least_section(const Carrier& carrier, int index) {
    if (carrier.largest && carrier.largest->length == carrier.below && carrier.below <= carrier.contact)
        return carrier.largest;
    auto section = std::make_shared<Section>();
    section->length = std::min(carrier.contact, carrier.below);
    section->patch.layer = index;
    if (carrier.largest && carrier.below <= carrier.contact) section->patch = carrier.largest->patch;
    return section;
}

/// Fills the patches of the sections that lie between the last layer and this one.
void PeelCheck::draw_new_sections(const LabelledLayer& layer, int index) {
    const auto is_new = [&](const SectionPtr& section) {
        return section->patch.layer == index && section->patch.runs.empty();
    };
    std::vector<LayerPatch*> patches(branches_.size(), nullptr), piece_patches(pieces_.size(), nullptr);
    for (std::size_t p = 0; p < pieces_.size(); ++p)
        if (is_new(pieces_[p])) piece_patches[p] = &pieces_[p]->patch;
    for (std::size_t c = 0; c < branches_.size(); ++c) {
        const Branch& branch = branches_[c];
        if (is_new(branch.section) && branch.section != pieces_[branch.piece])
            patches[c] = &branch.section->patch;
    }
    for_overlaps(layer, last_, [&](int row, std::uint32_t above, std::uint32_t /*below*/, const Run& run) {
        const PlacedRun placed{index, row, run.begin, run.end};
        if (LayerPatch* patch = patches[above]) patch->include(placed);
        if (LayerPatch* patch = piece_patches[branches_[above].piece]) patch->include(placed);
    });
}

/// Holds what the layer pulls at against the sections below it.
void PeelCheck::judge(const LabelledLayer& layer, int index) {
    std::vector<std::int64_t> pulls(pieces_.size(), 0);
    std::int64_t length = 0;
    double greatest = 0;
    for (std::size_t c = 0; c < branches_.size(); ++c) {
        const std::int64_t pull = layer.components[c].length;
        length += pull;
        const Branch& branch = branches_[c];
        pulls[branch.piece] += pull;
        if (pieces_[branch.piece]->length > 0)
            greatest = std::max(greatest, load(branch.section, pull, index));
    }
    for (std::size_t p = 0; p < pieces_.size(); ++p)
        greatest = std::max(greatest, load(pieces_[p], pulls[p], index));
    curve_.area.add(grid_.area(length));
    curve_.load.add(greatest);
}

/// Returns by which factor a section is stressed more than the film; 0 if it floats.
double PeelCheck::load(const SectionPtr& section, std::int64_t pulled, int index) {
    if (section->length == 0) return 0;
    const double factor = static_cast<double>(pulled) / static_cast<double>(section->length);
    if (factor > limit_) {
        if (section->worst <= limit_) faulty_.push_back(section);
        section->last_layer = index;
    }
    section->worst = std::max(section->worst, factor);
    return factor;
}

/// Reports the faulty sections that carry nothing any more.
void PeelCheck::report_ended() {
    const auto carries = [](const SectionPtr& section) { return section.use_count() > 1; };
    const auto ended = std::stable_partition(faulty_.begin(), faulty_.end(), carries);
    for (auto it = ended; it != faulty_.end(); ++it) {
        const SectionPtr& section = *it;
        Fault fault = grid_.fault(section->patch);
        fault.end_layer = section->last_layer + 1;
        fault.size = section->worst;
        faults_.add(std::move(fault));
    }
    faulty_.erase(ended, faulty_.end());
}

}  // namespace lamella
