// Whether a value has the form that the description of the interface gives it.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

namespace lamella {

inline const nlohmann::ordered_json& resolved(const nlohmann::ordered_json& document,
                                              const nlohmann::ordered_json& schema) {
    if (!schema.contains("$ref")) return schema;
    const std::string name = schema["$ref"].get<std::string>();
    return document["components"]["schemas"].at(name.substr(name.rfind('/') + 1));
}

inline bool is_of_type(const nlohmann::ordered_json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    if (type == "number") return value.is_number();
    return type == "null" && value.is_null();
}

/// Returns where a value does not fit its schema; empty where it does.
inline std::string misfit(const nlohmann::ordered_json& document, const nlohmann::ordered_json& given,
                          const nlohmann::ordered_json& value, const std::string& place) {
    const nlohmann::ordered_json& schema = resolved(document, given);
    const nlohmann::ordered_json types =
        schema["type"].is_array() ? schema["type"] : nlohmann::ordered_json::array({schema["type"]});
    if (std::ranges::none_of(types, [&](const nlohmann::ordered_json& type) {
            return is_of_type(value, type.get<std::string>());
        }))
        return place + ": " + value.dump().substr(0, 60) + " is no " + types.dump();
    if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end())
        return place + ": " + value.dump() + " is none of " + schema["enum"].dump();
    if (value.is_object() && schema.contains("required")) {
        for (const nlohmann::ordered_json& name : schema["required"])
            if (!value.contains(name.get<std::string>())) return place + ": has no " + name.dump();
        for (const auto& [name, member] : value.items()) {
            if (!schema["properties"].contains(name)) continue;
            const std::string wrong =
                misfit(document, schema["properties"][name], member, place + "." + name);
            if (!wrong.empty()) return wrong;
        }
    }
    if (value.is_array() && schema.contains("items")) {
        for (const nlohmann::ordered_json& item : value) {
            const std::string wrong = misfit(document, schema["items"], item, place + "[]");
            if (!wrong.empty()) return wrong;
        }
    }
    return "";
}

}  // namespace lamella
