// The C interface from C++17: objects that release themselves, and a field of the program's own that is
// streamed to a file.
#include <lamella.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace {

template <auto destroy>
struct Destroy {
    template <typename T>
    void operator()(T* object) const {
        destroy(object);
    }
};
using Context = std::unique_ptr<lamella_context, Destroy<lamella_context_destroy>>;
using Recipe = std::unique_ptr<lamella_recipe, Destroy<lamella_recipe_destroy>>;
using Job = std::unique_ptr<lamella_job, Destroy<lamella_job_destroy>>;

void check(const Context& context, int32_t status) {
    if (status == LAMELLA_OK) return;
    lamella_error error{};
    error.struct_size = sizeof error;
    lamella_last_error(context.get(), &error);
    throw std::runtime_error(error.message);
}

// A ball with a rippled surface; its value changes by less than 1 per mm.
int32_t rippled_ball(void*, const double* points, size_t count, double* values) {
    for (size_t i = 0; i < count; ++i) {
        const double x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
        const double ripple = 0.2 * std::sin(2 * x) * std::sin(2 * y) * std::sin(2 * z);
        values[i] = 0.6 * (std::sqrt(x * x + y * y + z * z) - 8 + ripple);
    }
    return LAMELLA_OK;
}

}  // namespace

int main(int argc, char** argv) {
    const char* output = argc > 1 ? argv[1] : "rippled_ball.svg";
    try {
        lamella_context* opened = nullptr;
        if (lamella_context_create(LAMELLA_ABI_VERSION, &opened) != LAMELLA_OK)
            throw std::runtime_error("the library has another version than the header");
        const Context context(opened);
        lamella_recipe* empty = nullptr;
        check(context, lamella_recipe_create(context.get(), &empty));
        const Recipe recipe(empty);
        lamella_field field{};
        field.struct_size = sizeof field;
        field.metric = LAMELLA_BOUND;
        for (int axis = 0; axis < 3; ++axis) {
            field.lower[axis] = -8.5;
            field.upper[axis] = 8.5;
        }
        field.values = rippled_ball;
        field.identity = "rippled ball of 8 mm";
        check(context, lamella_recipe_add_field(context.get(), recipe.get(), "rippled_ball", &field));
        check(context, lamella_recipe_set(context.get(), recipe.get(), "printer.profile", "svg"));
        check(context, lamella_recipe_set(context.get(), recipe.get(), "layers.height", "0.5"));
        lamella_job* built = nullptr;
        check(context, lamella_job_build(context.get(), recipe.get(), nullptr, &built));
        const Job job(built);
        lamella_run_options options{};
        options.struct_size = sizeof options;
        options.flags = LAMELLA_FORCE;
        lamella_run_report report{};
        report.struct_size = sizeof report;
        check(context, lamella_run(context.get(), job.get(), output, &options, &report));
        std::printf("%s: %d layers, %.1f mm3\n", output, static_cast<int>(report.layers_written),
                    report.volume);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
