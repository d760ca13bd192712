// Shells by the body's own closed form.
#include "engine/shell.h"

#include "engine/csg.h"
#include "engine/error.h"

namespace lamella {

FieldPtr Field::shell(double thickness) const {
    FieldPtr core = offset(-thickness);
    return core ? make_difference(shared_from_this(), std::move(core)) : nullptr;
}

FieldPtr make_shell(const FieldPtr& body, double thickness) {
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError("a skin needs a positive, finite thickness");
    if (FieldPtr shell = body->shell(thickness)) return shell;
    if (body->metric() != Metric::exact) {
        throw InputError(
            "this shape has no exact 3D offset, so it cannot be given a skin of a stated thickness");
    }
    return make_difference(body, make_offset(body, -thickness));
}

}  // namespace lamella
