// Words for machines, looked up in the printers' registry.
#include "app/printer_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/error.h"
#include "printers/registry.h"

namespace lamella {

std::vector<std::string> backend_words() {
    std::vector<std::string> words;
    for (const BackendInfo& backend : backends()) words.emplace_back(backend.name);
    return words;
}

std::vector<std::string> profile_words() {
    std::vector<std::string> words;
    for (const PrinterProfile& profile : profiles()) words.push_back(profile.name);
    for (const std::string& backend : backend_words()) {
        if (std::find(words.begin(), words.end(), backend) == words.end()) words.push_back(backend);
    }
    return words;
}

PrinterProfile default_profile() { return profiles().front(); }

PrinterProfile profile_named(const std::string& name) {
    const auto machines = profiles();
    const auto is_backend = backend_words();
    const bool known =
        std::any_of(machines.begin(), machines.end(), [&](const auto& p) { return p.name == name; });
    if (known || std::find(is_backend.begin(), is_backend.end(), name) == is_backend.end())
        return find_profile(name);
    PrinterProfile profile;
    profile.name = name;
    profile.backend = name;
    profile.support = usual_supports(name);
    return profile;
}

dvec2 plate_size(const PrinterProfile& printer) {
    if (printer.backend == "gcode") return {printer.filament.bed_x, printer.filament.bed_y};
    if (printer.backend == "svg") return {infinity, infinity};
    const ImageProfile& image = printer.image;
    return dvec2(image.width * image.pixel_x, image.height * image.pixel_y) - 2 * image.margin;
}

std::string backend_of_ending(const std::string& path) {
    const std::string ending = std::filesystem::path(path).extension().string();
    for (const BackendInfo& backend : backends()) {
        const std::string_view endings = backend.endings;
        for (std::size_t at = 0; at < endings.size();) {
            const std::size_t end = std::min(endings.find(' ', at), endings.size());
            if (endings.substr(at, end - at) == ending) return backend.name;
            at = end + 1;
        }
    }
    return "";
}

std::string default_output(const PrinterProfile& printer, const std::string& part_name) {
    const OutputKind kind = find_backend(printer.backend).output;
    const bool folder =
        kind == OutputKind::folder || (kind == OutputKind::file_or_folder && !printer.vector.one_file);
    if (folder) return part_name + ".layers";
    const std::string_view endings = find_backend(printer.backend).endings;
    return part_name + std::string(endings.substr(0, endings.find(' ')));
}

std::string printers_listing() {
    std::string text = "Back-ends (--printer-kind, printer.kind)\n";
    for (const BackendInfo& backend : backends())
        text += fmt::format("  {:<14}{}\n", backend.name, backend.description);
    text += "\nProfiles (--printer, printer.profile)\n";
    for (const PrinterProfile& p : profiles()) {
        std::string facts = p.backend;
        if (p.backend == "png" || p.backend == "sl1") {
            facts += fmt::format(", {} x {} px of {} x {} mm{}", p.image.width, p.image.height,
                                 p.image.pixel_x, p.image.pixel_y, p.image.portrait ? ", portrait" : "");
        }
        text += fmt::format("  {:<14}{}\n", p.name, facts);
    }
    return text;
}

}  // namespace lamella
