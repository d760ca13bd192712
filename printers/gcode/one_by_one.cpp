// Heights of stacks against the room below the gantry.
#include "printers/gcode/one_by_one.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace lamella {

void check_gantry(const Job& job, const PrinterProfile& profile) {
    const LayerPlan& layers = job.layers;
    const double room = profile.gcode.gantry_height;
    for (int stack = 0; stack + 1 < layers.stacks(); ++stack) {
        const double top = layers.top(layers.first_of_stack(stack + 1) - 1);
        if (top <= room) continue;
        throw InputError(fmt::format(
            "plate.one_by_one / --one-by-one: {} is {:.2f} mm high, and the gantry passes {:.2f} mm above "
            "the bed (printer.gantry_height) while the next part is printed; accepted: all parts but one "
            "lower than that, or --no-one-by-one",
            job.objects[static_cast<std::size_t>(stack)].name, top, room));
    }
}

}  // namespace lamella
