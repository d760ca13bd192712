// Counts peculiarities and describes them.
#include "printers/vector/cut_notes.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {

void CutNotes::Tally::count(int layer, int times) {
    if (times <= 0) return;
    if (layers++ == 0) first = layer;
    sum += times;
}

std::string CutNotes::Tally::where() const {
    return layers == 1 ? fmt::format("in layer {}", first)
                       : fmt::format("in {} layers, first in layer {}", layers, first);
}

void CutNotes::count(int layer, const CutPlan& plan, const CuttingProfile& profile) {
    if (plan.pieces > 1 && profile.ties == Ties::refuse) {
        throw ConstraintError(fmt::format(
            "layer {} falls into {} loose pieces, and printer.ties = \"refuse\"; accepted: \"join\", "
            "\"none\", or a part whose layers hold together",
            layer, plan.pieces));
    }
    if (loose_.layers == 0) first_loose_ = plan.pieces;
    loose_.count(layer, plan.pieces - 1);
    holes_.count(layer, plan.closed_holes);
    merged_.count(layer, plan.merged_pieces);
    unnumbered_.count(layer, plan.unnumbered ? 1 : 0);
}

std::vector<std::string> CutNotes::texts(const CuttingProfile& profile) const {
    std::vector<std::string> notes;
    const auto kerf = format_number(profile.kerf, 4);
    if (loose_.layers > 0 && profile.ties == Ties::none) {
        notes.push_back(
            fmt::format("loose pieces {}, which falls into {}; printer.ties = \"join\" holds them together",
                        loose_.where(), first_loose_));
    }
    if (holes_.layers > 0) {
        notes.push_back(fmt::format("{} {} closed by the kerf of {} mm and not cut, {}", holes_.sum,
                                    holes_.sum == 1 ? "hole is" : "holes are", kerf, holes_.where()));
    }
    if (merged_.layers > 0) {
        notes.push_back(fmt::format("pieces nearer to each other than the kerf of {} mm are not cut apart {}",
                                    kerf, merged_.where()));
    }
    if (unnumbered_.layers > 0) notes.push_back("no room for the layer's number " + unnumbered_.where());
    return notes;
}

}  // namespace lamella
