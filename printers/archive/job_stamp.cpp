// Compares the stamp of an unfinished output with that of the run that resumes it.
#include "printers/archive/job_stamp.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace lamella {

nlohmann::ordered_json to_json(const JobStamp& stamp) {
    return {{"unfinished", "lamella"},          {"version", 1},
            {"identity", stamp.identity},       {"settings", stamp.settings},
            {"first_layer", stamp.range.first}, {"last_layer", stamp.range.last}};
}

void check_same_job(const nlohmann::ordered_json& found, const JobStamp& wanted,
                    const std::filesystem::path& where) {
    const nlohmann::ordered_json expected = to_json(wanted);
    const std::string advice = "; discard it with --force, or choose another output name";
    const auto same = [&](const char* key) { return found.contains(key) && found[key] == expected[key]; };
    if (!found.is_object() || !same("unfinished") || !same("version")) {
        throw InputError(where.string() + " is not an unfinished output that this version can continue" +
                         advice);
    }
    if (!same("identity")) {
        throw InputError(where.string() + " belongs to another job (its recipe or inputs differ from now)" +
                         advice);
    }
    if (!same("settings")) {
        throw InputError(fmt::format("{} was begun with other printer settings: {} instead of {}{}",
                                     where.string(), found.value("settings", nlohmann::ordered_json()).dump(),
                                     expected["settings"].dump(), advice));
    }
    if (!same("first_layer") || !same("last_layer")) {
        const auto number = [&](const char* key) {
            return found.value(key, nlohmann::ordered_json()).dump();
        };
        throw InputError(fmt::format("{} was begun for layers {}:{}, not {}:{}; ask for that range{}",
                                     where.string(), number("first_layer"), number("last_layer"),
                                     wanted.range.first, wanted.range.last, advice));
    }
}

}  // namespace lamella
