// The recipe of the page: its file, changes of keys, values for a form, and files beside it.
#include <map>

#include "app/jobs/recipe_mistakes.h"
#include "app/server/server_state.h"
#include "engine/base/complete_file.h"
#include "engine/base/whole_file.h"
#include "recipe/recipe_edit.h"
#include "recipe/settings.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

template <typename T>
T member(const Json& json, const char* name) {
    try {
        return json.at(name).get<T>();
    } catch (const nlohmann::json::exception&) {
        throw HttpError(400, std::string(name) + ": missing, or of the wrong type");
    }
}

RecipeChange change_of(const Json& json) {
    RecipeChange change;
    change.section = member<std::string>(json, "section");
    change.key = json.contains("key") && !json["key"].is_null() ? member<std::string>(json, "key") : "";
    if (json.contains("index")) {
        const auto entry = member<std::int64_t>(json, "index");
        if (entry < 0 || entry > 1'000'000) throw HttpError(400, "index: out of range");
        change.entry = static_cast<std::size_t>(entry);
    }
    if (json.contains("value") && !json["value"].is_null()) change.value = member<std::string>(json, "value");
    return change;
}

/// Calls work(), and answers what is wrong with the recipe as its mistakes.
template <typename Work>
auto with_mistakes(const Work& work) {
    try {
        return work();
    } catch (const InputError& error) {
        throw RecipeMistakes(error.what(), "recipe");
    }
}

HttpReply edit(ServerState& state, const HttpRequest& request) {
    const Json json = request.json();
    std::vector<RecipeChange> changes;
    for (const Json& change : member<Json::array_t>(json, "changes")) changes.push_back(change_of(change));
    return with_mistakes([&] {
        const std::string text = edited_recipe(member<std::string>(json, "text"), changes);
        if (json.contains("layer")) {
            const auto session = json.contains("session") ? member<std::string>(json, "session") : "";
            state.ahead.begin({text, session, member<int>(json, "layer")});
        }
        return Json{{"text", text}};
    });
}

HttpReply values(const HttpRequest& request) {
    const Json json = request.json();
    const auto given = with_mistakes([&] { return given_keys(member<std::string>(json, "text")); });
    Json values = Json::object(), lists = Json::object(), names = Json::array(), lines = Json::object();
    for (const GivenKey& key : given) {
        const std::string name = key.section + "." + key.key;
        if (find_section(key.section)->is_list()) {
            Json& list = lists[key.section];
            while (list.size() <= key.entry) list.push_back(Json::object());
            list[key.entry][key.key] = key.value;
        } else {
            values[name] = key.value;
            names.push_back(name);
            lines[name] = key.line;
        }
    }
    return Json{{"values", values}, {"lists", lists}, {"given", names}, {"lines", lines}};
}

HttpReply read(const ServerState& state) {
    const std::string& name = state.options.recipe;
    if (name.empty()) return Json{{"text", ""}, {"path", nullptr}, {"saved", true}};
    return Json{
        {"text", whole_file(state.folder.file(name).string(), "a recipe")}, {"path", name}, {"saved", true}};
}

HttpReply save(ServerState& state, const HttpRequest& request) {
    const Json json = request.json();
    const std::string name = json.contains("path") && !json["path"].is_null()
                                 ? member<std::string>(json, "path")
                                 : state.options.recipe;
    if (!name.ends_with(".toml")) throw HttpError(400, "path: accepted: the name of a .toml file");
    const std::string text = member<std::string>(json, "text");
    const std::filesystem::path path = state.folder.file(name);
    const std::lock_guard lock(state.own_recipes_mutex);
    if (std::filesystem::exists(path) && !state.own_recipes.contains(path))
        throw HttpError(400, name + ": is another recipe; accepted: a name that no file has");
    write_complete_file(path, [&](std::ostream& out) { out << text; });
    state.own_recipes.insert(path);
    return Json{{"path", name}};
}

}  // namespace

void add_recipe_routes(ServerState& state) {
    HttpServer& http = state.http;
    http.route("GET", "/api/recipe", [&state](const HttpRequest&) { return read(state); });
    http.route("PUT", "/api/recipe", [&state](const HttpRequest& request) { return save(state, request); });
    http.route("POST", "/api/edit", [&state](const HttpRequest& request) { return edit(state, request); });
    http.route("POST", "/api/values", values);
    http.route("POST", "/api/files", [&state](const HttpRequest& request) -> HttpReply {
        return Json{{"path", state.folder.keep(request.text("name"), request.body)}};
    });
}

}  // namespace lamella
