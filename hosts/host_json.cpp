// A host's answers are foreign input: every member may be missing or of another kind.
#include "hosts/host_json.h"

#include <cmath>

namespace lamella {

nlohmann::json read_json(const HttpConnection& connection, const HostResponse& response) {
    nlohmann::json json = nlohmann::json::parse(response.body, nullptr, false);
    if (json.is_discarded()) {
        throw HostError(
            HostFailure::refused,
            connection.access().name + ": its answer is no JSON; is the address that of another program?",
            response.status);
    }
    return json;
}

const nlohmann::json& json_at(const nlohmann::json& json, const char* pointer) {
    static const nlohmann::json none;
    const nlohmann::json::json_pointer place(pointer);
    return json.contains(place) ? json.at(place) : none;
}

std::optional<double> number_at(const nlohmann::json& json, const char* pointer) {
    const nlohmann::json& value = json_at(json, pointer);
    if (!value.is_number()) return std::nullopt;
    const auto number = value.get<double>();
    return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<std::uint64_t> size_at(const nlohmann::json& json, const char* pointer) {
    const std::optional<double> number = number_at(json, pointer);
    constexpr double most = 9e15;  // doubles count in steps of one up to here
    if (!number || *number < 0 || *number > most) return std::nullopt;
    return static_cast<std::uint64_t>(*number);
}

std::string text_at(const nlohmann::json& json, const char* pointer) {
    const nlohmann::json& value = json_at(json, pointer);
    return value.is_string() ? value.get<std::string>() : "";
}

}  // namespace lamella
