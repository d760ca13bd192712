// KlipperSender: handling of what klippy says.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/text.h"
#include "printers/serial/gcode_line.h"
#include "printers/serial/klipper_sender.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_unknown = 64;  // texts on unknown commands that are remembered

std::string text_at(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void read_number(const Json& json, const char* name, double& value) {
    if (const auto found = json.find(name); found != json.end() && found->is_number())
        value = found->get<double>();
}

const Json& object_at(const Json& json, const char* name) {
    static const Json none = Json::object();
    const auto found = json.find(name);
    return found != json.end() && found->is_object() ? *found : none;
}

bool is_true(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_boolean() && found->get<bool>();
}

/// Returns the first lines of a message that Klipper pads with advice.
std::string short_text(std::string_view message) {
    constexpr std::size_t longest = 300;
    std::string text;
    while (!message.empty() && text.size() < longest) {
        const std::string_view line = trimmed(message.substr(0, message.find('\n')));
        message.remove_prefix(
            std::min(message.size(), message.find('\n') + 1 == 0 ? message.size() : message.find('\n') + 1));
        if (line.empty()) continue;
        (text += text.empty() ? "" : " / ") += line;
    }
    return without_controls(text.substr(0, longest));
}

bool is_extruder(const std::string& name) {
    return name.starts_with("extruder") &&
           std::ranges::all_of(name.substr(8), [](char c) { return '0' <= c && c <= '9'; });
}

bool is_move(const std::string& command) {
    const std::string word = command_word(command);
    return word == "G0" || word == "G1";
}

bool moves_axes(const std::string& command) {
    return is_move(command) && command.find_first_of("XYZ") != std::string::npos;
}

}  // namespace

void KlipperSender::read(std::string_view bytes, double now) {
    frames_.feed(bytes);
    while (const auto text = frames_.next()) {
        const auto message = parse_klipper_message(*text);
        if (!message) {
            log_received(without_controls(*text));
            continue;
        }
        // States come four times a second.
        if (message->topic != "status") log_received(without_controls(*text));
        if (stop_) continue;
        if (message->topic == "status") {
            on_status(object_at(message->content, "status"), now);
        } else if (message->topic == "output") {
            on_output(text_at(message->content, "response"));
        } else if (message->id) {
            const auto asked = asked_.find(*message->id);
            if (asked == asked_.end()) {
                ++statistics_.surplus;
                continue;
            }
            const Asked what = asked->second;
            asked_.erase(asked);
            on_answer(what, *message, now);
        }
    }
}

void KlipperSender::on_answer(Asked what, const KlipperMessage& message, double now) {
    if (what == Asked::script) return on_script(message, now);
    if (message.error && what != Asked::commands) {
        return stop(StopKind::refused, "Klipper refuses a request: " + short_text(*message.error) +
                                           "; accepted: the API socket of klippy, and a Klipper of 2020 or "
                                           "later");
    }
    switch (what) {
        case Asked::info:
            return on_info(message.content, now);
        case Asked::objects:
            return on_objects(message.content);
        case Asked::status:
            return on_subscribed(object_at(message.content, "status"), now);
        case Asked::commands:
            takes_height_ = message.content.contains("SET_KINEMATIC_POSITION");
            break;
        case Asked::cause:
            return on_cause(message.content);
        default:
            break;
    }
}

void KlipperSender::on_info(const Json& info, double now) {
    const std::string state = text_at(info, "state");
    const std::string words = short_text(text_at(info, "state_message"));
    if (state == "startup") {
        state_ = State::starting;
        state_until_ = now + startup_interval;
        remark_ = "it says \"" + words + "\"";
        return;
    }
    if (state != "ready") {
        return stop(StopKind::refused,
                    fmt::format("Klipper is not ready (its state is {}): {}; accepted: a Klipper that is, "
                                "after FIRMWARE_RESTART where that helps",
                                state.empty() ? "not told" : without_controls(state), words));
    }
    firmware_ = without_controls("Klipper " + text_at(info, "software_version"));
    state_ = State::subscribing;
    state_until_ = now + answer_patience;
    ask(Asked::output, "gcode/subscribe_output", {{"response_template", {{"topic", "output"}}}});
    ask(Asked::commands, "gcode/help", Json::object());
    ask(Asked::objects, "objects/list", Json::object());
}

void KlipperSender::on_objects(const Json& content) {
    Json wanted = {{"webhooks", {"state", "state_message"}},
                   {"toolhead", {"print_time", "estimated_print_time", "extruder", "homed_axes"}}};
    const auto list = content.find("objects");
    if (list == content.end() || !list->is_array())
        return stop(StopKind::refused, "Klipper does not tell what it has");
    for (const Json& item : *list) {
        const std::string name = item.is_string() ? item.get<std::string>() : std::string();
        if (is_extruder(name) || name == "heater_bed") wanted[name] = {"temperature", "target"};
        if (name == "pause_resume") wanted[name] = {"is_paused"};
        if (name == "print_stats") wanted[name] = {"state", "filename"};
        if (name == "virtual_sdcard") wanted[name] = {"is_active"};
        pauses_ = pauses_ || name == "pause_resume";
    }
    ask(Asked::status, "objects/subscribe",
        {{"objects", std::move(wanted)}, {"response_template", {{"topic", "status"}}}});
}

void KlipperSender::on_subscribed(const Json& status, double now) {
    on_status(status, now);
    if (stop_) return;
    const Json& print = object_at(status, "print_stats");
    const std::string state = text_at(print, "state");
    if (is_true(object_at(status, "virtual_sdcard"), "is_active") || state == "printing" ||
        state == "paused") {
        return stop(StopKind::refused,
                    fmt::format("Klipper has a print of its own ({}); accepted: a Klipper without one, after "
                                "CANCEL_PRINT if that is paused",
                                without_controls(text_at(print, "filename"))));
    }
    forget_pause();  // left by somebody else; Klipper would not pause once more
    state_ = State::running;
    rests_since_ = now;
    remark_.clear();
}

void KlipperSender::on_status(const Json& status, double now) {
    const Json& hooks = object_at(status, "webhooks");
    if (const std::string state = text_at(hooks, "state"); !state.empty() && state != "ready")
        return stop(StopKind::fatal, "Klipper has shut down, which switches heaters and motors off: " +
                                         short_text(text_at(hooks, "state_message")));
    const Json& toolhead = object_at(status, "toolhead");
    read_number(toolhead, "print_time", print_time_);
    read_number(toolhead, "estimated_print_time", machine_time_);
    dry_at_ = now + (print_time_ - machine_time_);
    if (toolhead.contains("homed_axes")) homed_axes_ = text_at(toolhead, "homed_axes");
    if (const std::string name = text_at(toolhead, "extruder"); !name.empty()) extruder_ = name;
    on_heaters(status);
    const Json& pause = object_at(status, "pause_resume");
    if (pause.contains("is_paused")) note_pause(is_true(pause, "is_paused"));
}

void KlipperSender::on_heaters(const Json& status) {
    for (const auto& [name, values] : status.items()) {
        if (!values.is_object() || (name != "heater_bed" && !is_extruder(name))) continue;
        read_number(values, "temperature", heaters_[name].degrees);
        read_number(values, "target", heaters_[name].target);
    }
    const auto heater = [&](const std::string& name) {
        const auto found = heaters_.find(name);
        return found == heaters_.end() ? Heater{} : found->second;
    };
    const Heater nozzle = heater(extruder_), bed = heater("heater_bed");
    temperatures_ = {nozzle.degrees, nozzle.target, bed.degrees, bed.target};
}

/// Klipper may pause without a word. That it does not any more may be the beginning of a cancellation, and is
/// told by a word where it is not.
void KlipperSender::note_pause(bool paused) {
    if (std::exchange(paused_, paused) || !paused || state_ != State::running) return;
    if (listener_.on_action) listener_.on_action("paused");
}

void KlipperSender::on_output(std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string line = without_controls(trimmed(text.substr(0, end)));
        text.remove_prefix(std::min(text.size(), end + 1));
        const auto behind = [&](std::string_view front) {
            return std::string(trimmed(std::string_view(line).substr(front.size())));
        };
        if (line.starts_with("// action:")) {
            on_action(behind("// action:"));
            continue;
        }
        std::string said;
        if (line.starts_with("//")) said = behind("//");
        if (line.starts_with("!!")) said = behind("!!");
        if (line.starts_with("echo:")) said = behind("echo:");
        if (said.empty() || said.starts_with("Klipper state:")) continue;
        // Each layer may repeat a command that this machine does not know.
        const bool unknown = said.starts_with("Unknown command");
        if (unknown && (unknown_.size() >= most_unknown || !unknown_.insert(said).second)) continue;
        if (listener_.on_message) listener_.on_message(said);
    }
}

void KlipperSender::on_action(std::string_view text) {
    if (text.starts_with("prompt_")) return on_prompt(text);
    if (text.starts_with("notification ")) {
        if (listener_.on_message) listener_.on_message(std::string(trimmed(text.substr(13))));
        return;
    }
    std::string action(text);
    // What Klipper says in its own PAUSE and RESUME is done already; older ones leave out the ending.
    if (pauses_ && action == "pause") action = "paused";
    if (pauses_ && action == "resume") action = "resumed";
    if (pauses_ && action == "paused") paused_ = true;
    if (action == "resumed" || action == "cancel") paused_ = false;
    if (listener_.on_action) listener_.on_action(action);
}

/// Handles a prompt, which arrives line by line: prompt_begin TITLE, prompt_text TEXT, prompt_button
/// LABEL|COMMAND|COLOUR for each button, prompt_show. A label without a command is one itself.
void KlipperSender::on_prompt(std::string_view text) {
    const std::string_view word = text.substr(0, text.find(' '));
    const std::string_view rest = trimmed(text.substr(std::min(text.size(), word.size() + 1)));
    if (word == "prompt_begin") {
        dialog_ = Dialog{UserWait{std::string(rest)}};
    } else if (word == "prompt_end") {
        dialog_.reset();
    } else if (!dialog_) {
        return;
    } else if (word == "prompt_text") {
        (dialog_->wait.text += dialog_->wait.text.empty() ? "" : ": ") += rest;
    } else if (word == "prompt_button" || word == "prompt_footer_button") {
        const std::string_view label = trimmed(rest.substr(0, rest.find('|')));
        const std::string_view behind = rest.substr(std::min(
            rest.size(), rest.find('|') == std::string_view::npos ? rest.size() : rest.find('|') + 1));
        const std::string_view command = trimmed(behind.substr(0, behind.find('|')));
        dialog_->wait.buttons.emplace_back(label);
        dialog_->commands.emplace_back(command.empty() ? label : command);
    } else if (word == "prompt_show") {
        dialog_->shown = true;
    }
}

void KlipperSender::on_script(const KlipperMessage& message, double now) {
    if (!script_) return;
    const Script script = *std::exchange(script_, std::nullopt);
    rests_since_ = now;
    if (!message.error) {
        if (script.of_job) answered_job_ += script.lines;
        return;
    }
    // The same answer comes where Klipper has shut down.
    failing_ = Failure{script, *message.error};
    ask(Asked::cause, "info", Json::object());
}

void KlipperSender::on_cause(const Json& info) {
    const auto failure = std::exchange(failing_, std::nullopt);
    if (!failure) return;
    if (text_at(info, "state") == "ready") return refuse(*failure);
    stop(StopKind::fatal, "Klipper has shut down, which switches heaters and motors off: " +
                              short_text(text_at(info, "state_message")));
}

void KlipperSender::refuse(const Failure& failure) {
    const Script& script = failure.script;
    const std::string why = short_text(failure.why);
    // A cold nozzle is not drawn back; its lines need not be told from others.
    if (!script.of_job && is_move(script.first) && !moves_axes(script.first)) return;
    // Behind a move that was not made, another one may cross the part.
    if (script.of_job || moves_axes(script.first)) std::erase_if(urgent_, is_move);
    if (refused_) return;
    if (!script.of_job) {
        refused_ = fmt::format("Klipper refuses \"{}\": {}", script.first, why);
    } else if (script.lines == 1) {
        refused_ = fmt::format("Klipper refuses line {} of the job (\"{}\"): {}", answered_job_ + 1,
                               script.first, why);
    } else {
        refused_ =
            fmt::format("Klipper refuses one of the lines {} to {} of the job (\"{}\" to \"{}\"): {}",
                        answered_job_ + 1, answered_job_ + script.lines, script.first, script.last, why);
    }
}

}  // namespace lamella
