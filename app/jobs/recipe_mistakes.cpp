// Takes the places out of messages: "PATH:7:3: text" or "PATH:7: text".
#include "app/jobs/recipe_mistakes.h"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace lamella {

namespace {

nlohmann::ordered_json mistake_of(std::string line, const std::string& path) {
    nlohmann::ordered_json mistake{{"line", nullptr}, {"text", line}};
    if (!line.starts_with(path + ":")) return mistake;
    const char* at = line.data() + path.size() + 1;
    const char* end = line.data() + line.size();
    int number = 0;
    const auto parsed = std::from_chars(at, end, number);
    if (parsed.ec != std::errc{}) return mistake;
    mistake["line"] = number;
    at = parsed.ptr;
    int column = 0;
    if (at < end && *at == ':') {
        const auto second = std::from_chars(at + 1, end, column);
        if (second.ec == std::errc{}) at = second.ptr;
    }
    while (at < end && (*at == ':' || *at == ' ')) ++at;
    mistake["text"] = std::string(at, end);
    return mistake;
}

std::string without_path(std::string message, const std::string& path) {
    for (std::size_t at = message.find(path + ":"); at != std::string::npos; at = message.find(path + ":"))
        message.replace(at, path.size() + 1, "line ");
    return message;
}

nlohmann::ordered_json mistakes_of(const std::string& message, const std::string& path) {
    auto mistakes = nlohmann::ordered_json::array();
    std::istringstream in(message);
    for (std::string line; std::getline(in, line);) mistakes.push_back(mistake_of(line, path));
    return {{"mistakes", std::move(mistakes)}};
}

}  // namespace

RecipeMistakes::RecipeMistakes(const std::string& message, const std::string& path)
    : HttpError(422, without_path(message, path), mistakes_of(message, path)) {}

}  // namespace lamella
