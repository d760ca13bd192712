// Framing and parsing.
#include "printers/serial/klipper_message.h"

#include <algorithm>

#include "engine/base/json_depth.h"

namespace lamella {
namespace {

constexpr std::size_t longest_message = 4u << 20;  // bytes

}  // namespace

std::string klipper_request(std::int64_t id, std::string_view method, const nlohmann::ordered_json& params) {
    const nlohmann::ordered_json request = {{"id", id}, {"method", method}, {"params", params}};
    return request.dump() + klipper_message_end;
}

std::optional<KlipperMessage> parse_klipper_message(std::string_view text) {
    auto json = nlohmann::ordered_json::parse(shallow_json(text), nullptr, false);
    if (!json.is_object()) return std::nullopt;
    KlipperMessage message;
    if (const auto id = json.find("id"); id != json.end() && id->is_number_integer())
        message.id = id->get<std::int64_t>();
    if (const auto topic = json.find("topic"); topic != json.end() && topic->is_string())
        message.topic = topic->get<std::string>();
    if (const auto error = json.find("error"); error != json.end()) {
        const bool told = error->is_object() && error->contains("message") && (*error)["message"].is_string();
        message.error = told ? (*error)["message"].get<std::string>() : error->dump();
    }
    for (const char* name : {"result", "params"}) {
        if (const auto content = json.find(name); content != json.end() && content->is_object())
            message.content = std::move(*content);
    }
    if (!message.content.is_object()) message.content = nlohmann::ordered_json::object();
    return message;
}

std::string without_controls(std::string_view text) {
    std::string plain(text);
    const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
    std::replace_if(plain.begin(), plain.end(), is_control, ' ');
    while (!plain.empty() && plain.back() == ' ') plain.pop_back();
    return plain;
}

std::optional<std::string> KlipperFrames::next() {
    for (;;) {
        const std::size_t end = waiting_.find(klipper_message_end, at_);
        if (end == std::string::npos) {
            at_ = waiting_.size();
            skips_ = skips_ || at_ > longest_message;
            if (skips_) waiting_.clear(), at_ = 0;
            return std::nullopt;
        }
        std::string message = waiting_.substr(0, end);
        waiting_.erase(0, end + 1);
        at_ = 0;
        if (!std::exchange(skips_, false)) return message;
    }
}

}  // namespace lamella
