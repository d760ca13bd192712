// Words for machines, looked up in the printers' registry.
#include "app/printer_choice.h"

#include <fmt/format.h>

#include <algorithm>

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

std::string default_output(const PrinterProfile& printer, const std::string& part_name) {
    const OutputKind kind = find_backend(printer.backend).output;
    const bool folder =
        kind == OutputKind::folder ||
        (kind == OutputKind::file_or_folder && !(printer.vector.one_file && printer.cutting.sheet.empty()));
    if (folder) return part_name + ".layers";
    return part_name + "." + printer.backend;
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
