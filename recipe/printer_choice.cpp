// Lists machines, and writes a profile as an editable file.
#include "recipe/printer_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "recipe/settings.h"
#include "recipe/toml_value.h"

namespace lamella {

namespace {

/// Describes the printable size of the machine.
std::string size_of(const PrinterProfile& p) {
    switch (find_backend(p.backend).content) {
        case LayerContent::pixels:
            return fmt::format("{} x {} px, {:.6g} x {:.6g} mm{}", p.image.width, p.image.height,
                               p.image.width * p.image.pixel_x, p.image.height * p.image.pixel_y,
                               p.image.portrait ? ", portrait" : "");
        case LayerContent::beads:
            if (p.gcode.flavour == Flavour::grbl)
                return fmt::format("{:.6g} x {:.6g} mm", p.filament.bed_x, p.filament.bed_y);
            return fmt::format("{:.6g} x {:.6g} x {:.6g} mm, nozzle {:.6g} mm", p.filament.bed_x,
                               p.filament.bed_y, p.filament.bed_z, p.filament.nozzle);
        case LayerContent::voxels:
            return fmt::format("pixels of {:.6g} x {:.6g} mm", p.image.pixel_x, p.image.pixel_y);
        case LayerContent::contours:
            return "contours in mm";
    }
    return "";
}

std::string pixel_of(const PrinterProfile& p) {
    if (find_backend(p.backend).content != LayerContent::pixels) return "";
    const auto um = [](double mm) { return fmt::format("{:.4g}", mm * 1000); };
    return p.image.pixel_x == p.image.pixel_y ? um(p.image.pixel_x) + " um"
                                              : um(p.image.pixel_x) + " x " + um(p.image.pixel_y) + " um";
}

std::string profile_line(const MachineProfiles& profiles, const std::string& name) {
    try {
        const auto found = profiles.find(name);
        const PrinterProfile& p = found->printer;
        std::string facts = size_of(p);
        if (const std::string pixel = pixel_of(p); !pixel.empty()) facts += ", pixel " + pixel;
        std::string line = fmt::format("  {:<25} {:<6}{}\n", name, p.backend, facts);
        return line + fmt::format("  {:<32}{}{}({})\n", "", found->description,
                                  found->description.empty() ? "" : " ", found->source);
    } catch (const InputError& error) {
        return fmt::format("  {:<25} cannot be used: {}\n", name, error.what());
    }
}

/// Returns false for keys that repeat others, and for keys that belong to recipes alone.
bool is_written(const Setting& setting) {
    return !belongs_in_recipe(setting) && setting.name() != "printer.pixel" &&
           setting.name() != "printer.dpi";
}

std::string setting_line(const Setting& setting, const Recipe& recipe) {
    const Value value = setting.load(recipe, 0);
    const std::string literal = toml_literal(setting, value);
    // An empty text or table is written as a comment, to be filled in.
    const bool is_empty = literal == "\"\"" || literal == "[]";
    const std::string assignment = fmt::format("{}{} = {}", is_empty ? "# " : "", setting.key, literal);
    return fmt::format("{:<31} # {}{}\n", assignment, setting.unit.empty() ? "" : setting.unit + ": ",
                       setting.help);
}

}  // namespace

std::vector<std::string> backend_words() {
    std::vector<std::string> words;
    for (const BackendInfo& backend : backends()) words.emplace_back(backend.name);
    return words;
}

std::vector<std::string> output_endings(const BackendInfo& backend) {
    std::vector<std::string> endings;
    std::istringstream words(backend.endings);
    for (std::string ending; words >> ending;) endings.push_back(ending);
    return endings;
}

std::string backend_of_ending(const std::string& path, const std::string& preferred) {
    const std::string name = lower_case(std::filesystem::path(path).filename().string());
    std::string found;
    for (const BackendInfo& backend : backends()) {
        for (const std::string& ending : output_endings(backend)) {
            if (name.size() <= ending.size() || !name.ends_with(ending)) continue;
            if (backend.name == preferred) return preferred;
            if (found.empty()) found = backend.name;
        }
    }
    return found;
}

std::string default_output(const PrinterProfile& printer, const std::string& part_name) {
    const OutputKind kind = find_backend(printer.backend).output;
    const bool folder =
        kind == OutputKind::folder ||
        (kind == OutputKind::file_or_folder && !(printer.vector.one_file && printer.cutting.sheet.empty()));
    if (folder) return part_name + default_folder_ending;
    const std::vector<std::string> endings = output_endings(find_backend(printer.backend));
    return part_name + (endings.empty() ? "" : endings.front());
}

std::string printers_listing(const MachineProfiles& profiles) {
    std::string text = "Back-ends (--printer-kind, printer.kind)\n";
    for (const BackendInfo& backend : backends())
        text += fmt::format("  {:<25} {}\n", backend.name, backend.description);
    text += "\nProfiles (--printer, printer.profile)\n";
    const std::vector<std::string> words = backend_words();
    for (const std::string& name : profiles.names()) {
        if (std::find(words.begin(), words.end(), name) == words.end()) text += profile_line(profiles, name);
    }
    return text + fmt::format("\n`lamella printers NAME` writes one as TOML, to be edited and kept in {}\n",
                              user_profile_folder());
}

std::string profile_as_toml(const MachineProfile& profile) {
    Recipe recipe;
    recipe.printer = profile.printer;
    std::string text;
    if (!profile.description.empty()) text = "description = " + toml_quoted(profile.description) + "\n";
    for (const char* section : profile_sections) {
        text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", section);
        for (const Setting& setting : settings()) {
            if (setting.section == section && is_written(setting)) text += setting_line(setting, recipe);
        }
    }
    return text;
}

}  // namespace lamella
