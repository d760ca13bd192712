// Ranges of layers, and products as bytes.
#include "engine/layers/backend.h"

#include "engine/base/error.h"

namespace lamella {

void check_range(const Job& job, const LayerRange& range, TakesStacks takes) {
    if (job.one_by_one() && takes == TakesStacks::no) {
        throw InputError(
            "plate.one_by_one / --one-by-one: this output, or check, takes layers of the whole plate; "
            "accepted: G-code of a filament printer, or --no-one-by-one");
    }
    if (range.first < 0 || range.last > job.layers.count() || range.first >= range.last) {
        throw InputError("layers " + std::to_string(range.first) + ":" + std::to_string(range.last) +
                         " do not exist: the part has layers 0:" + std::to_string(job.layers.count()));
    }
}

std::string pack(LayerProduct& product) {
    Archive parcel;
    parcel(product.area, product.support_area);
    product.serialize(parcel);
    return parcel.bytes();
}

void unpack(std::string bytes, LayerProduct& product) {
    Archive parcel(std::move(bytes));
    parcel(product.area, product.support_area);
    product.serialize(parcel);
    parcel.finish();
}

}  // namespace lamella
