// Measures masks in blocks of layers, and formats the report.
#include "app/reports/job_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "app/console/progress.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "printers/common/layer_heights.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

constexpr double mm3_per_ml = 1000;

double lit_pixels(const MaskImage& mask) {
    std::uint64_t sum = 0;
    for (const std::uint8_t grey : mask.pixels) sum += grey;
    return static_cast<double>(sum) / 255;
}

std::string time_text(double seconds) {
    const auto s = static_cast<std::int64_t>(std::ceil(seconds));
    if (s >= 3600) return fmt::format("{} h {:02} min {:02} s", s / 3600, s / 60 % 60, s % 60);
    return s >= 60 ? fmt::format("{} min {:02} s", s / 60, s % 60) : fmt::format("{} s", s);
}

std::string exposure_text(const JobFacts& facts) {
    std::string text = fmt::format("exposure  {:.4g} s", *facts.exposure);
    if (facts.first_exposure) {
        text += facts.first_layers ? fmt::format("; the first {} layers {:.4g} s", *facts.first_layers,
                                                 *facts.first_exposure)
                                   : fmt::format("; first layers {:.4g} s", *facts.first_exposure);
        if (facts.fade_layers && *facts.fade_layers > 0)
            text += fmt::format(", fading over {} layers", *facts.fade_layers);
    }
    return text + "\n";
}

}  // namespace

AreaSummary measure_areas(const JobFile& job, int threads, bool quiet) {
    constexpr int block = 32;  // layers between two drawings of the progress
    std::vector<double> areas(static_cast<std::size_t>(job.layers()));
    ProgressDisplay display(quiet, "areas: ");
    ThreadArena arena(threads);
    for (int first = 0; first < job.layers(); first += block) {
        const int last = std::min(first + block, job.layers());
        try {
            arena.execute([&] {
                parallel_for(last - first, [&](int i) {
                    const int layer = first + i;
                    areas[static_cast<std::size_t>(layer)] = lit_pixels(job.layer(layer));
                });
            });
        } catch (const InputError&) {
            // Of several damaged layers the first is reported, whichever thread was faster.
            for (int layer = first; layer < last; ++layer) job.layer(layer);
            throw;
        }
        if (job.layers() > block) display.show({last, job.layers(), last - 1});
    }
    display.finish();
    const JobFacts& facts = job.facts();
    AreaSummary summary;
    summary.in_pixels = !facts.pixel_x || !facts.pixel_y;
    const double pixel = summary.in_pixels ? 1 : *facts.pixel_x * *facts.pixel_y;
    const auto lowest = std::ranges::min_element(areas), highest = std::ranges::max_element(areas);
    summary.lowest = *lowest * pixel;
    summary.highest = *highest * pixel;
    summary.lowest_layer = static_cast<int>(lowest - areas.begin());
    summary.highest_layer = static_cast<int>(highest - areas.begin());
    summary.mean = std::accumulate(areas.begin(), areas.end(), 0.0) / job.layers() * pixel;
    for (int i = 0; i < std::min(job.layers(), facts.heights.count()); ++i)
        summary.volume += areas[static_cast<std::size_t>(i)] * pixel * facts.heights.height(i);
    summary.empty_layers = static_cast<int>(std::ranges::count(areas, 0.0));
    return summary;
}

double mask_volume(const JobFacts& facts, const AreaSummary& areas) {
    if (!areas.in_pixels && facts.heights.count() > 0) return areas.volume;
    if (areas.in_pixels || !facts.layer_height) return -1;
    return areas.mean * facts.layers * *facts.layer_height;
}

Json job_json(const std::string& path, const JobFacts& facts, const AreaSummary& areas) {
    Json json{{"job", path}, {"format", facts.format}};
    const auto add = [&](const char* key, const auto& value) {
        if (value) json[key] = *value;
    };
    const auto add_text = [&](const char* key, const std::string& text) {
        if (!text.empty()) json[key] = text;
    };
    add_text("name", facts.name);
    add_text("machine", facts.machine);
    add_text("material", facts.material);
    add_text("program", facts.program);
    json["layers"] = facts.layers;
    add("layer_height_mm", facts.layer_height);
    if (facts.heights.count() > 0) json["layer_height_mm"] = layer_heights_json(facts.heights);
    json["width_px"] = facts.width;
    json["height_px"] = facts.height;
    add("pixel_x_mm", facts.pixel_x);
    add("pixel_y_mm", facts.pixel_y);
    add("exposure_s", facts.exposure);
    add("first_exposure_s", facts.first_exposure);
    add("first_layers", facts.first_layers);
    add("fade_layers", facts.fade_layers);
    add("print_time_s", facts.print_time);
    add("volume_mm3", facts.volume);
    if (const double volume = mask_volume(facts, areas); volume >= 0) json["mask_volume_mm3"] = volume;
    json[areas.in_pixels ? "area_px" : "area_mm2"] = {{"lowest", areas.lowest},
                                                      {"lowest_layer", areas.lowest_layer},
                                                      {"highest", areas.highest},
                                                      {"highest_layer", areas.highest_layer},
                                                      {"mean", areas.mean}};
    json["empty_layers"] = areas.empty_layers;
    if (!facts.notes.empty()) json["notes"] = facts.notes;
    return json;
}

std::string job_text(const JobFacts& facts, const AreaSummary& areas) {
    std::string text =
        fmt::format("job       {}{}\n", facts.format, facts.name.empty() ? "" : ", " + facts.name);
    if (!facts.program.empty()) text += "made by   " + facts.program + "\n";
    if (!facts.machine.empty() || !facts.material.empty()) {
        const bool both = !facts.machine.empty() && !facts.material.empty();
        text += "printer   " + facts.machine + (both ? ", " : "") + facts.material + "\n";
    }
    text += fmt::format("layers    {}", facts.layers);
    if (facts.heights.count() > 0)
        text += fmt::format(" of {}, {:.7g} mm high", facts.heights.heights_text(), facts.heights.total());
    if (facts.layer_height)
        text += fmt::format(" of {:.7g} mm, {:.7g} mm high", *facts.layer_height,
                            *facts.layer_height * facts.layers);
    text += fmt::format("\nmasks     {} x {} px", facts.width, facts.height);
    if (facts.pixel_x && facts.pixel_y) {
        text += fmt::format(" of {:.7g} x {:.7g} mm, {:.7g} x {:.7g} mm in all", *facts.pixel_x,
                            *facts.pixel_y, *facts.pixel_x * facts.width, *facts.pixel_y * facts.height);
    }
    text += "\n";
    if (facts.exposure) text += exposure_text(facts);
    if (facts.print_time) text += "time      " + time_text(*facts.print_time) + "\n";
    const double made = mask_volume(facts, areas);
    if (facts.volume || made >= 0) {
        text += "volume    ";
        if (made >= 0) text += fmt::format("{:.3f} ml by its masks", made / mm3_per_ml);
        if (made >= 0 && facts.volume) text += ", ";
        if (facts.volume) text += fmt::format("{:.3f} ml as it says", *facts.volume / mm3_per_ml);
        text += "\n";
    }
    text += fmt::format("area      {:.3f} (layer {}) to {:.3f} (layer {}), mean {:.3f} {} a layer\n",
                        areas.lowest, areas.lowest_layer, areas.highest, areas.highest_layer, areas.mean,
                        areas.in_pixels ? "px" : "mm2");
    if (areas.empty_layers > 0) text += fmt::format("          {} layers are empty\n", areas.empty_layers);
    for (const std::string& note : facts.notes) text += "note      " + note + "\n";
    return text;
}

}  // namespace lamella
