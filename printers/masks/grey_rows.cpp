// Tables that map coverage to grey.
#include "printers/masks/grey_rows.h"

#include <cmath>

#include "engine/base/deterministic_math.h"

namespace lamella {
namespace {

bool is_plain(const GreyTable& table) {
    for (std::size_t value = 0; value < table.size(); ++value) {
        if (table[value] != value) return false;
    }
    return true;
}

}  // namespace

int white_of(const ImageProfile& profile) { return profile.bits == 16 ? white_of_16_bits : white_of_8_bits; }

GreyTable grey_table(const ImageProfile& profile, double share) {
    const int white = white_of(profile);
    GreyTable table(static_cast<std::size_t>(white) + 1);
    for (std::size_t value = 1; value < table.size(); ++value) {
        const double coverage = static_cast<double>(value) / white;
        const double toned = profile.gamma == 1 ? coverage : power(coverage, profile.gamma);
        const double grey = profile.min_grey + (profile.full_grey - profile.min_grey) * toned;
        table[value] = static_cast<std::uint16_t>(std::floor(white * grey * share + 0.5));
    }
    return table;
}

void apply(const GreyTable& table, int width, std::vector<GreyRun>& runs, std::vector<GreyRun>& spare) {
    if (is_plain(table)) return;
    spare.clear();
    RowJoiner out(spare, width);
    for (const GreyRun& run : runs) out.push(run.length, table[run.value]);
    std::swap(runs, spare);
}

}  // namespace lamella
