// What there is: version, keys, machines, examples.
#include <algorithm>

#include "app/server/embedded_files.h"
#include "app/server/server_state.h"
#include "engine/base/parallel.h"
#include "printers/process_limits.h"
#include "recipe/keys/check_words.h"
#include "recipe/printer_choice.h"
#include "recipe/read_recipe.h"
#include "recipe/recipe_kinds.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

const char* type_name(ValueType type) {
    constexpr std::array names{"boolean", "integer", "number", "text",          "lines",   "path",
                               "choice",  "triple",  "graded", "graded_triple", "formula", "rows"};
    return names[static_cast<std::size_t>(type)];
}

Json limit(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json settings_json() {
    Json list = Json::array();
    for (const Setting& setting : settings()) {
        list.push_back({{"section", setting.section},
                        {"key", setting.key},
                        {"flag", setting.flag},
                        {"type", type_name(setting.type)},
                        {"unit", setting.unit},
                        {"lo", limit(setting.limits.lo)},
                        {"hi", limit(setting.limits.hi)},
                        {"choices", setting.choices},
                        {"form", setting.shape.form},
                        {"default", setting.fallback},
                        {"help", setting.help}});
    }
    return list;
}

Json sections_json() {
    Json list = Json::array();
    for (const Section& section : sections()) {
        list.push_back({{"name", section.name},
                        {"title", section.title()},
                        {"help", section.help},
                        {"list", section.is_list()}});
    }
    return list;
}

Json kinds_json() {
    Json list = Json::array();
    for (const KindSection& section : kind_sections()) {
        Json words = Json::object();
        for (const Kind& kind : section.kinds)
            words[kind.word] = {{"needs", kind.needs}, {"takes", kind.takes}};
        list.push_back({{"section", section.section},
                        {"key", section.key},
                        {"default", section.fallback},
                        {"words", std::move(words)}});
    }
    return list;
}

Json machines_json() {
    const MachineProfiles profiles = machine_profiles("");
    Json list = Json::array();
    for (const std::string& name : profiles.names()) {
        try {
            const auto found = profiles.find(name);
            const PrinterProfile& printer = found->printer;
            const auto endings = output_endings(find_backend(printer.backend));
            list.push_back({{"name", name},
                            {"description", found->description},
                            {"backend", printer.backend},
                            {"process", process_name(process_of(printer))},
                            {"extension", endings.empty() ? "" : endings.front()}});
        } catch (const InputError&) {  // a user's file with mistakes: `lamella printers` tells them
        }
    }
    return list;
}

/// Returns the first comment of a recipe.
std::string title_of(std::string_view text) {
    if (!text.starts_with("# ")) return "";
    return std::string(text.substr(2, text.find('\n') - 2));
}

Json examples_json() {
    Json list = Json::array();
    for (const EmbeddedFile& file : example_recipes()) {
        list.push_back({{"name", file.name.substr(0, file.name.rfind('.'))},
                        {"title", title_of(file.text)},
                        {"text", file.text}});
    }
    return list;
}

}  // namespace

void add_setting_routes(ServerState& state) {
    HttpServer& http = state.http;
    http.route("GET", "/api/version", [&state](const HttpRequest&) -> HttpReply {
        return Json{{"name", "lamella"},
                    {"version", LAMELLA_VERSION},
                    {"studio", state.options.has_page},
                    {"recipe", state.options.recipe.empty() ? Json() : Json(state.options.recipe)},
                    {"threads", thread_count(state.options.threads)}};
    });
    http.route("GET", "/api/openapi.json", [](const HttpRequest&) {
        return HttpReply(json_type, std::string(interface_files().front().text));
    });
    http.route("GET", "/api/settings", [](const HttpRequest&) -> HttpReply {
        return Json{{"sections", sections_json()}, {"settings", settings_json()}, {"kinds", kinds_json()}};
    });
    http.route("GET", "/api/machines", [](const HttpRequest&) -> HttpReply { return machines_json(); });
    http.route("GET", "/api/examples", [](const HttpRequest&) -> HttpReply { return examples_json(); });
}

}  // namespace lamella
