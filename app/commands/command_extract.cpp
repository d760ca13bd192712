// `lamella extract`: writes the masks of a print job as a folder of PNG files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/interrupt.h"
#include "app/console/progress.h"
#include "engine/base/error.h"
#include "printers/archive/unfinished_folder.h"
#include "printers/masks/png_writer.h"
#include "printers/readers/read_job.h"
#include "recipe/identity.h"
#include "recipe/layer_range.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

struct ExtractOptions {
    std::string job;
    std::string output;
    std::string layers;
    bool resume = false;
    bool force = false;
    bool quiet = false;
};

std::vector<std::byte> encode(const MaskImage& mask, const JobFacts& facts) {
    std::vector<GreyRun> runs;
    const auto width = static_cast<std::size_t>(mask.width);
    for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
        if (i % width == 0 || runs.back().value != mask.pixels[i]) runs.push_back({0, mask.pixels[i]});
        ++runs.back().length;
    }
    return encode_png({mask.width, mask.height, facts.pixel_x.value_or(0), facts.pixel_y.value_or(0)}, runs);
}

/// Returns the area by grey values, mm^2; 0 when the pixel size is unknown.
double covered_area(const MaskImage& mask, const JobFacts& facts) {
    const double pixels = std::accumulate(mask.pixels.begin(), mask.pixels.end(), 0.0) / 255;
    return pixels * facts.pixel_x.value_or(0) * facts.pixel_y.value_or(0);
}

/// Makes a job.json like that of a PNG stack, with the facts of the file.
Json describe(const ExtractOptions& options, const JobFacts& facts, LayerRange range) {
    Json json{{"format", "lamella-layers"},
              {"version", 1},
              {"name", facts.name},
              {"unit", "mm"},
              {"extracted_from", std::filesystem::path(options.job).filename().string()},
              {"extracted_format", facts.format}};
    const auto add = [&](const char* key, const auto& value) {
        if (value) json[key] = *value;
    };
    add("layer_height", facts.layer_height);
    json["layer_count"] = facts.layers;
    json["first_layer"] = range.first;
    json["last_layer"] = range.last;
    json["files"] = "%05d.png";
    json["width"] = facts.width;
    json["height"] = facts.height;
    add("pixel_x", facts.pixel_x);
    add("pixel_y", facts.pixel_y);
    json["printer"] = facts.machine;
    json["material"] = facts.material;
    json["program"] = facts.program;
    add("exposure", facts.exposure);
    add("first_exposure", facts.first_exposure);
    add("first_layers", facts.first_layers);
    add("fade_layers", facts.fade_layers);
    add("print_time", facts.print_time);
    add("volume", facts.volume);
    return json;
}

void run(const ExtractOptions& options) {
    CancelToken cancel;
    const InterruptGuard guard(cancel);
    const std::unique_ptr<JobFile> job = open_job(options.job);
    const LayerRange range = parse_layers(options.layers, job->layers());
    UnfinishedFolder output(options.output, ".png", options.force);
    int next = output.begin({hash_input(options.job), "extract", range}, options.resume);
    ProgressDisplay display(options.quiet);
    const int missing = range.last - next;
    for (const int first = next; next < range.last; ++next) {
        if (cancel.cancelled()) {
            display.finish();
            throw Interrupted(
                "interrupted; the layers so far are kept. The same command with --resume goes on");
        }
        const MaskImage mask = job->layer(next);
        LayerProduct areas;
        areas.area = covered_area(mask, job->facts());
        output.write(next, encode(mask, job->facts()), areas);
        display.show({next - first + 1, missing, next});
    }
    display.finish();
    output.end(describe(options, job->facts(), range));
    if (!options.quiet) {
        std::fputs(fmt::format("{}: {} layers of {}\n", options.output, range.count(), options.job).c_str(),
                   stderr);
    }
}

}  // namespace

void add_extract_command(CLI::App& root) {
    auto options = std::make_shared<ExtractOptions>();
    CLI::App& command =
        *root.add_subcommand("extract", "Write the masks of a print job as PNG files with a job.json");
    command
        .add_option("JOB", options->job,
                    fmt::format("Finished job: {}, or a folder of masks with a job.json",
                                fmt::join(job_endings(), ", ")))
        ->type_name("")
        ->required();
    command.add_option("-o,--output", options->output, "Folder to write")->type_name("DIR")->required();
    command
        .add_option("--layers", options->layers,
                    "Layers A up to, not including, B, counted from 0; default: all")
        ->type_name("A:B");
    command.add_flag("--resume", options->resume, "Continue an interrupted folder");
    command.add_flag("--force", options->force, "Replace an existing folder of layers");
    command.add_flag("-q,--quiet", options->quiet, "No progress on standard error");
    finish_command(command,
                   "  lamella extract insole.goo -o insole/\n"
                   "  lamella extract insole.sl1 --layers 100:110 -o some/");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
