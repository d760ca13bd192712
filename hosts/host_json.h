// JSON that a host answers: read without trust, with its mistakes told.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "hosts/transfer/http_connection.h"

namespace lamella {

/// Returns an answer's JSON. Throws HostError (refused) for an answer that is none.
nlohmann::json read_json(const HttpConnection& connection, const HostResponse& response);

/// Returns the value at a JSON pointer, such as "/result/status"; null where there is none.
const nlohmann::json& json_at(const nlohmann::json& json, const char* pointer);

/// Return the value at a JSON pointer, if it is a finite number, or a text.
std::optional<double> number_at(const nlohmann::json& json, const char* pointer);
std::optional<std::uint64_t> size_at(const nlohmann::json& json, const char* pointer);
std::string text_at(const nlohmann::json& json, const char* pointer);

}  // namespace lamella
