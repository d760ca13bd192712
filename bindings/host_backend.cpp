// Callbacks get each layer as a borrowed section, and own what they make of it.
#include "bindings/host_backend.h"

#include <fmt/format.h>

#include "bindings/handles.h"

namespace lamella {
namespace {

/// Owns the data that `render` made; calls `drop` when destroyed.
struct HostProduct : LayerProduct {
    explicit HostProduct(const lamella_backend& from) : callbacks(from) { made.struct_size = sizeof made; }
    ~HostProduct() override {
        if (callbacks.drop != nullptr && made.data != nullptr) callbacks.drop(callbacks.user, made.data);
    }
    HostProduct(const HostProduct&) = delete;
    HostProduct& operator=(const HostProduct&) = delete;

    const lamella_backend& callbacks;
    lamella_product made{};
};

}  // namespace

HostBackend::HostBackend(const lamella_backend& callbacks, std::uint32_t flags)
    : callbacks_(callbacks), flags_(flags & ~std::uint32_t{LAMELLA_RESUME}) {
    if (callbacks.render == nullptr) throw BadCall("backend: render is a null pointer");
    if (callbacks.write == nullptr) throw BadCall("backend: write is a null pointer");
}

void HostBackend::check(std::int32_t status, const char* callback) const {
    if (status == LAMELLA_OK) return;
    const char* told = callbacks_.error != nullptr ? callbacks_.error(callbacks_.user) : nullptr;
    if (told == nullptr || *told == '\0')
        return check_callback(status, fmt::format("the back-end's {}", callback));
    if (status == LAMELLA_STOPPED) throw Interrupted(told);
    if (status == LAMELLA_BAD_INPUT) throw InputError(told);
    throw FaultError(told);
}

int HostBackend::open(const Job& job, LayerRange range, bool resume) {
    if (callbacks_.begin == nullptr) {
        if (resume) throw InputError("the back-end cannot continue what was begun; accepted: a new run");
        return range.first;
    }
    lamella_job_info info = job_info(job);
    info.struct_size = sizeof info;
    std::int32_t missing = range.first;
    const std::uint32_t flags = flags_ | (resume ? std::uint32_t{LAMELLA_RESUME} : 0);
    check(callbacks_.begin(callbacks_.user, &info, range.first, range.last, flags, &missing), "begin");
    if (missing < range.first || missing > range.last)
        throw FaultError(
            fmt::format("the back-end says that layer {} is the first to be missing, of {} to {}", missing,
                        range.first, range.last));
    return missing;
}

std::unique_ptr<LayerProduct> HostBackend::render(const Layer& layer) const {
    auto product = std::make_unique<HostProduct>(callbacks_);
    lamella_context context;
    lamella_section section;
    lend_layer(layer, section);
    check(callbacks_.render(callbacks_.user, &context, &section, &product->made), "render");
    product->area = product->made.area;
    product->support_area = product->made.support_area;
    return product;
}

void HostBackend::write(const Layer& layer, LayerProduct& product) {
    lamella_section section;
    lend_layer(layer, section);
    section.info.struct_size = sizeof section.info;
    check(callbacks_.write(callbacks_.user, &section.info, &dynamic_cast<HostProduct&>(product).made),
          "write");
}

void HostBackend::finish() {
    if (callbacks_.end != nullptr) check(callbacks_.end(callbacks_.user), "end");
}

}  // namespace lamella
