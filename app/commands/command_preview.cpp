// `lamella preview`: renders a picture of the part, whole or cut open.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/commands/prepare_job.h"
#include "app/commands/recipe_options.h"
#include "app/console/picture_output.h"
#include "app/console/text_output.h"
#include "app/reports/modulus_paint.h"
#include "engine/base/error.h"
#include "recipe/build/build_process.h"
#include "recipe/build/finish_job.h"
#include "recipe/output/job_picture.h"

namespace lamella {

namespace {

struct PreviewCommand {
    RecipeOptions recipe;
    PreviewOptions picture;
    std::string output;
    std::string cut = "x";
    std::string paint = "none";
    int size = 1024;
    int frames = 0;  ///< of the growing part; 0: a picture of the whole
    bool quiet = false;
};

void paint_modulus(const BuiltJob& built, PreviewCommand& options) {
    options.picture.paint = modulus_paint(built, "--paint modulus");
    if (!options.quiet) std::fputs((modulus_legend(*built.modulus) + "\n").c_str(), stderr);
}

/// Writes pictures of the part as it grows into a folder: 0001.png and so on, after about equally many
/// layers.
void draw_frames(const Recipe& recipe, const BuiltJob& built, const std::optional<BuiltSupports>& supports,
                 const PreviewCommand& options, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FaultError(folder + ": cannot be made (" + error.message() + ")");
    const auto scene = make_scene(recipe, built, supports, {options.size, options.picture.threads, {}});
    const std::int64_t layers = built.job.layers.count();
    PreviewOptions view = options.picture;
    for (int frame = 1; frame <= options.frames; ++frame) {
        const auto printed = static_cast<int>((frame * layers + options.frames - 1) / options.frames);
        view.printed_to = built.job.z0() + built.job.layers.top(printed - 1);
        const std::filesystem::path file = std::filesystem::path(folder) / fmt::format("{:04}.png", frame);
        write_picture(file.string(), scene->render(view));
    }
}

void check_frames(const PreviewCommand& options, const BuiltJob& built) {
    const int layers = built.job.layers.count();
    if (options.frames > layers)
        throw InputError(fmt::format("--layers: {} pictures; accepted: at most {}, one after each layer",
                                     options.frames, layers));
    if (built.job.layers.stacks() > 1)
        throw InputError("--layers: the parts are printed one by one; accepted: parts that grow together");
}

void run(PreviewCommand& options) {
    const auto start = std::chrono::steady_clock::now();
    const Recipe recipe = options.recipe.read();
    if (!options.quiet) note_unused(options.recipe, recipe);
    BuiltJob built = build_job(recipe, with_kept_plans(options.quiet));
    const char* const ending = options.frames > 0 ? "_layers" : ".png";
    const std::string path = options.output.empty() ? recipe.part.name + ending : options.output;
    options.picture.width = options.picture.height = options.size;
    options.picture.cut = options.cut == "none" ? '-' : options.cut.front();
    if (options.paint == "modulus") paint_modulus(built, options);
    const SupportStructures around = finish_job(recipe, built, {});
    if (options.frames > 0) {
        check_frames(options, built);
        draw_frames(recipe, built, around.supports, options, path);
    } else {
        check_is_picture("--output", path);
        write_picture(path, render_job(recipe, built, around.supports, options.picture));
    }
    if (options.quiet) return;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const std::string count = options.frames > 0 ? fmt::format("{} pictures of ", options.frames) : "";
    std::fputs(fmt::format("{}: {}{} x {} pixels in {:.1f} s\n", path, count, options.size, options.size,
                           seconds.count())
                   .c_str(),
               stderr);
}

}  // namespace

void add_preview_command(CLI::App& root) {
    auto options = std::make_shared<PreviewCommand>();
    CLI::App& command =
        *root.add_subcommand("preview", "Render a shaded picture of the part, whole or cut open");
    options->recipe.add_to(command);
    command
        .add_option("-o,--output", options->output,
                    "Picture file, or a folder for --layers; default: by the part's name")
        ->type_name("FILE");
    command.add_option("--size", options->size, "Edge of the picture, px")
        ->check(CLI::Range(16, 8192))
        ->type_name("N");
    auto* const frames =
        command
            .add_option("--layers", options->frames,
                        "Draw so many pictures of the part as it grows, into a folder: 0001.png and so on")
            ->check(CLI::Range(1, 9999))
            ->type_name("N");
    command
        .add_option("--cut", options->cut,
                    "Axis along which the side towards the eye is cut away: x, y, z, or none")
        ->check(CLI::IsMember({"x", "y", "z", "none"}))
        ->excludes(frames)
        ->type_name("WORD");
    command
        .add_option("--paint", options->paint,
                    "modulus: colours for the foam's modulus and its deviation from the requested one")
        ->check(CLI::IsMember({"none", "modulus"}))
        ->type_name("WORD");
    command
        .add_option("--cut-at", options->picture.cut_at,
                    "Position of the cut, as a share of the part's size along the axis")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("X");
    command
        .add_option("--azimuth", options->picture.azimuth, "Direction of the eye around the part, degrees")
        ->check(CLI::Range(-360.0, 360.0))
        ->type_name("DEG");
    command
        .add_option("--elevation", options->picture.elevation, "Height of the eye above the horizon, degrees")
        ->check(CLI::Range(-89.0, 89.0))
        ->type_name("DEG");
    command.add_option("--threads", options->picture.threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024));
    command.add_flag("-q,--quiet", options->quiet, "Nothing on standard error");
    finish_command(
        command,
        "  lamella preview insole.toml -o insole.png\n"
        "  lamella preview model.stl --cell 3 --beam 0.5 --cut z --cut-at 0.7 --size 2048 -o open.png\n"
        "  lamella preview insole.toml --layers 48 -o growing");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
