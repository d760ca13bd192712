// `lamella pattern`: synthesises a sheet of a pattern by example that tiles the plane.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/commands/recipe_options.h"
#include "app/console/text_output.h"
#include "app/reports/section_writer.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/text.h"
#include "engine/field/slice_context.h"
#include "printers/masks/png_writer.h"
#include "procedural/pattern/flat_pattern.h"

namespace lamella {

namespace {

struct PatternOptions {
    std::string picture, output, reinforce = "shape";
    ExampleSettings example;
    double threshold = -1;
    std::vector<double> sheet;
    double pixel = 0;
    int threads = 0;
    bool json = false;
};

bool is_png(const std::string& path) { return path.ends_with(".png"); }

void check_output(const PatternOptions& options) {
    if (options.output.empty() || options.output.ends_with(".svg") || is_png(options.output)) return;
    throw InputError("-o: " + options.output +
                     " is neither .png nor .svg; accepted: a file with one of these endings");
}

dvec2 sheet_of(const PatternOptions& options) {
    constexpr double pictures = 2;
    if (options.sheet.empty()) return dvec2(pictures * options.example.size);
    return {options.sheet.at(0), options.sheet.at(1)};
}

/// Returns the runs of one row, whose pixels are grey by how much of them the pattern covers: solid is dark,
/// unless it is light in the example.
void append_row(const FlatPattern& pattern, const PngHeader& header, int row, bool invert,
                std::vector<GreyRun>& runs) {
    const std::size_t first = runs.size();
    for (int x = 0; x < header.width; ++x) {
        const dvec2 at((x + 0.5) * header.pixel_x, (row + 0.5) * header.pixel_y);
        const double covered = std::clamp(0.5 + pattern.distance(at) / header.pixel_x, 0.0, 1.0);
        const auto value = static_cast<std::uint16_t>(std::lround(255 * (invert ? covered : 1 - covered)));
        if (runs.size() > first && runs.back().value == value) {
            ++runs.back().length;
        } else {
            runs.push_back({1, value});
        }
    }
}

/// Returns the sheet as a picture like the example.
std::string png_of(const FlatPattern& pattern, double wanted_pixel, bool invert) {
    constexpr double most_along = 65535, most_pixels = 1 << 28;
    const double pixel = wanted_pixel > 0 ? wanted_pixel : pattern.spacing() / 2;
    const dvec2 size = pattern.size(), count = glm::max(glm::round(size / pixel), dvec2(1));
    if (std::max(count.x, count.y) > most_along || count.x * count.y > most_pixels)
        throw InputError(
            fmt::format("--pixel: {} mm makes a picture of {} x {} pixels; accepted: a larger pixel, for at "
                        "most {} along a side and {} in all",
                        pixel, count.x, count.y, most_along, most_pixels));
    const int width = static_cast<int>(count.x), height = static_cast<int>(count.y);
    const PngHeader header{
        .width = width, .height = height, .pixel_x = size.x / width, .pixel_y = size.y / height};
    std::vector<GreyRun> runs;
    for (int row = height - 1; row >= 0; --row) append_row(pattern, header, row, invert, runs);
    const std::vector<std::byte> bytes = encode_png(header, runs);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string svg_of(const FlatPattern& pattern) {
    const dvec2 size = pattern.size();
    SliceContext context;
    const PlaneCut cut{context.slice(pattern, 0), nullptr, 0, Rect{dvec2(0), size}};
    return section_svg(cut, 0.02 * pattern.spacing());
}

std::string report_of(const FlatPattern& pattern, const PatternOptions& options) {
    const SoundPattern& made = pattern.pattern();
    const dvec2 size = pattern.size();
    if (options.json) {
        const nlohmann::ordered_json report{{"sheet_mm", {size.x, size.y}},
                                            {"site_mm", pattern.spacing()},
                                            {"solid_share", made.printed.share},
                                            {"example_share", pattern.wanted_share()},
                                            {"pieces", made.pieces},
                                            {"dropped", made.printed.dropped},
                                            {"joins", made.joins},
                                            {"bridges", made.bridges},
                                            {"cut_struts", made.cut_struts},
                                            {"detours", made.detours}};
        return report.dump(2) + "\n";
    }
    std::string text =
        fmt::format("sheet     {:.4g} x {:.4g} mm, tiles in both directions; sites of {:.3g} mm\n", size.x,
                    size.y, pattern.spacing());
    text += fmt::format("solid     {:.3g} % (the example {:.3g} %)\n", 100 * made.printed.share,
                        100 * pattern.wanted_share());
    text += fmt::format("pieces    {}", made.pieces);
    if (made.joins > 0) text += ", joined by " + counted(made.joins, "bridge");
    if (made.printed.dropped > 0) text += fmt::format("; {} too small to keep", made.printed.dropped);
    text += "\n";
    if (made.bridges > 0) text += fmt::format("sounder   by {}\n", counted(made.bridges, "bridge"));
    if (made.cut_struts > 0)
        text += fmt::format("note      parts hang on one strut alone, at {}\n",
                            counted(made.cut_struts, "place"));
    if (made.detours > 0)
        text += fmt::format("note      a long way round {}\n", counted(made.detours, "gap"));
    constexpr double much = 0.05;
    if (std::abs(made.printed.share - pattern.wanted_share()) > much)
        text +=
            "note      least widths change the solid share: lines of the example are narrower than strut or "
            "gap at "
            "this size; a larger --size keeps them\n";
    return text;
}

void run(PatternOptions options) {
    check_output(options);
    if (options.reinforce == "none") options.example.reinforce = Reinforcement::none;
    if (options.threshold >= 0) options.example.threshold = options.threshold;
    const Volume picture = read_picture(options.picture);
    ThreadArena arena(options.threads);
    const auto pattern = arena.execute([&] {
        try {
            return std::make_shared<const FlatPattern>(picture, sheet_of(options), options.example);
        } catch (const InputError& error) {
            throw InputError(options.picture + ": " + error.what());
        }
    });
    if (!options.output.empty()) {
        TextOutput out(options.output);
        out.write(is_png(options.output) ? png_of(*pattern, options.pixel, options.example.invert)
                                         : svg_of(*pattern));
        out.close();
    }
    TextOutput report("");
    report.write(report_of(*pattern, options));
    report.close();
}

}  // namespace

void add_pattern_command(CLI::App& root) {
    auto options = std::make_shared<PatternOptions>();
    CLI::App& command =
        *root.add_subcommand("pattern", "Synthesise a flat sheet of a pattern like that of a picture");
    command.add_option("EXAMPLE", options->picture, "Picture (.png, .tif, ...) of solid and void")
        ->required();
    command
        .add_option("-o,--output", options->output, "File for the sheet, .png or .svg; it tiles the plane")
        ->type_name("FILE");
    const auto positive = CLI::Range(1e-3, 1e6);
    command.add_option("--size", options->example.size, "Width of the picture; default: 20")
        ->check(positive)
        ->type_name("MM");
    command
        .add_option("--sheet", options->sheet,
                    "Size of the sheet; default: twice the picture's width along each side")
        ->delimiter(',')
        ->expected(2)
        ->check(positive)
        ->type_name("MM,MM");
    command.add_option("--strut", options->example.strut, "Least width of struts; default: 0.8")
        ->check(positive)
        ->type_name("MM");
    command.add_option("--gap", options->example.gap, "Least width of gaps between struts; default: any")
        ->check(CLI::Range(0.0, 1e6))
        ->type_name("MM");
    command
        .add_option("--threshold", options->threshold,
                    "Grey level below which the picture is solid; default: the one that parts it best (Otsu)")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("X");
    command.add_flag("--invert", options->example.invert, "What is light in the picture is solid");
    command
        .add_option(
            "--reinforce", options->reinforce,
            "How bridges make the sheet sounder: none; shape: no strut alone holds a part, and no way "
            "round a gap is long; default: shape")
        ->check(CLI::IsMember({"none", "shape"}))
        ->type_name("KIND");
    command.add_option("--seed", options->example.synthesis.seed, "Seed of the random numbers; default: 1")
        ->type_name("N");
    command.add_option("--pixel", options->pixel, "Pixel of a .png; default: an eighth of a strut")
        ->check(positive)
        ->type_name("MM");
    command.add_option("--threads", options->threads, "Threads to use; 0: one per core")
        ->check(CLI::Range(0, 1024))
        ->type_name("INT");
    command.add_flag("--json", options->json, "Write the report as JSON");
    finish_command(
        command,
        "  lamella pattern bricks.png -o sheet.png\n"
        "  lamella pattern cells.png --invert --size 30 --strut 0.6 --gap 0.4 --sheet 100,60 -o sheet.svg\n"
        "Struts and gaps are at least as wide as asked, and the sheet is one piece.");
    command.callback([options] { run(*options); });
}

}  // namespace lamella
