// Words for machines, looked up in the printers' registry.
#include "app/printer_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/error.h"
#include "printers/registry.h"

namespace lamella {

std::vector<std::string> backend_words() { return backends(); }

std::vector<std::string> profile_words() {
    std::vector<std::string> words;
    for (const PrinterProfile& profile : profiles()) words.push_back(profile.name);
    for (const std::string& backend : backend_words()) words.push_back(backend);
    return words;
}

PrinterProfile default_profile() { return PrinterProfile{}; }

PrinterProfile profile_named(const std::string& name) {
    for (const PrinterProfile& profile : profiles()) {
        if (profile.name == name) return profile;
    }
    const auto names = backend_words();
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        throw InputError("printer.profile: \"" + name + "\" is unknown; `lamella printers` lists what is accepted");
    }
    PrinterProfile profile;
    profile.name = name;
    profile.backend = name;
    return profile;
}

std::string default_output(const PrinterProfile& printer, const std::string& part_name) {
    if (printer.backend == "png") return part_name + ".layers";
    if (printer.backend == "svg" && !printer.vector.one_file) return part_name + ".layers";
    return part_name + "." + printer.backend;
}

std::string printers_listing() {
    std::string text = "Back-ends\n";
    for (const std::string& backend : backend_words()) text += "  " + backend + "\n";
    text += "Profiles\n";
    for (const PrinterProfile& p : profiles()) text += fmt::format("  {:<20}{}\n", p.name, p.backend);
    return text;
}

}  // namespace lamella
