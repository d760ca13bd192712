// Requests, scripts, motion.
#include "tests/printers/serial/simulated_klipper.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "printers/serial/gcode_line.h"

namespace lamella::test {

namespace {

constexpr char end_of_message = '\x03';
constexpr double report_interval = 0.25, motion_start = 0.25;  // s
constexpr double bed_size = 300, coldest_extrusion = 170, hottest = 300;

std::string name_of(const std::string& line) {
    const std::string first = line.substr(0, line.find(' '));
    const bool named = first.size() > 1 && (first[1] == '_' || ('A' <= first[1] && first[1] <= 'Z'));
    return named ? first : command_word(line);
}

/// What RESPOND TYPE=command MSG="..." is to say.
std::string told_text(const std::string& line) {
    const auto from = line.find("MSG=\"");
    if (from == std::string::npos) return {};
    return line.substr(from + 5, line.rfind('"') - from - 5);
}

}  // namespace

std::vector<std::string> SimulatedKlipper::lines_of(const std::string& script) {
    std::vector<std::string> lines(1);
    for (const char c : script) c == '\n' ? lines.emplace_back() : lines.back() += c, void();
    return lines;
}

void SimulatedKlipper::boot(double now) {
    state_ = "startup";
    message_ = "Printer is not ready\nThe klippy host software is attempting to connect.";
    ready_at_ = now + options_.startup;
    at_ = busy_until_ = print_time_ = now;
}

void SimulatedKlipper::disconnect() {
    bytes_.clear();
    said_.clear();
    hears_ = false;
    wanted_ = nullptr;
    told_.clear();
    for (Script& script : scripts_) script.id.reset();
}

void SimulatedKlipper::restart(double now) {
    disconnect();
    scripts_.clear();
    running_ = paused_ = streams_ = relative_ = relative_e_ = false;
    waiting_.clear();
    nozzle_.target = bed_.target = 0;
    std::fill(std::begin(homed_), std::end(homed_), false);
    boot(now);
}

void SimulatedKlipper::shut_down(const std::string& why, double now) {
    if (state_ == "shutdown") return;
    state_ = "shutdown";
    message_ = why + "\nOnce the underlying issue is corrected, use the\n\"FIRMWARE_RESTART\" command.";
    shut_down_at_ = now;
    nozzle_.target = bed_.target = 0;
    print_time_ = now;
    waiting_.clear();
    tell("// Klipper state: Shutdown");
}

void SimulatedKlipper::say(const Json& message) { (said_ += message.dump()) += end_of_message; }

void SimulatedKlipper::tell(const std::string& line) {
    if (hears_) say({{"topic", output_topic_}, {"params", {{"response", line}}}});
}

void SimulatedKlipper::reply(const std::optional<std::int64_t>& id, const Json& result) {
    if (id) say({{"id", *id}, {"result", result}});
}

void SimulatedKlipper::fail(const std::optional<std::int64_t>& id, const std::string& why) {
    if (id) say({{"id", *id}, {"error", {{"error", "WebRequestError"}, {"message", why}}}});
}

void SimulatedKlipper::receive(std::string_view bytes, double now) {
    said_ = run(now);
    bytes_ += bytes;
    for (std::size_t end = bytes_.find(end_of_message); end != std::string::npos;
         end = bytes_.find(end_of_message)) {
        take_request(bytes_.substr(0, end), now);
        bytes_.erase(0, end + 1);
    }
}

void SimulatedKlipper::take_request(std::string_view text, double now) {
    const Json request = Json::parse(text, nullptr, false);
    if (!request.is_object() || !request.contains("method")) {
        ++malformed_;
        return;
    }
    std::optional<std::int64_t> id;
    if (request.contains("id")) id = request["id"].get<std::int64_t>();
    const std::string method = request["method"];
    const Json params = request.value("params", Json::object());
    if (method == "gcode/script") {
        scripts_.push_back({id, lines_of(params.at("script"))});
        received_.push_back(scripts_.back().lines);
        most_scripts_ = std::max<std::size_t>(
            most_scripts_, static_cast<std::size_t>(std::count_if(scripts_.begin(), scripts_.end(),
                                                                  [](const Script& one) { return one.id; })));
        return;
    }
    if (method == "emergency_stop") {
        shut_down("Shutdown due to webhooks request", now);
        return reply(id, Json::object());
    }
    const Json result = answer_to(method, params, now);
    result.is_null() ? fail(id, "webhooks: No registered callback for path '" + method + "'")
                     : reply(id, result);
}

SimulatedKlipper::Json SimulatedKlipper::answer_to(const std::string& method, const Json& params,
                                                   double now) {
    if (method == "info")
        return {{"state", state_}, {"state_message", message_}, {"software_version", "v0.12.0-302-g8f510da"}};
    if (method == "gcode/subscribe_output") {
        hears_ = true;
        output_topic_ = params.at("response_template").value("topic", "");
        return Json::object();
    }
    if (method == "gcode/help") {
        Json help = {{"RESTORE_GCODE_STATE", "Restore a previously saved G-Code state"}};
        if (options_.force_move) help["SET_KINEMATIC_POSITION"] = "Force a low-level kinematic position";
        return help;
    }
    if (method == "objects/list") {
        Json list = {"webhooks", "toolhead", "heater_bed", "extruder", "extruder_stepper belt"};
        if (options_.pause_resume) list.push_back("pause_resume");
        if (!options_.own_file.empty()) list.push_back("print_stats");
        return {{"objects", list}};
    }
    if (method == "objects/subscribe") {
        wanted_ = params.at("objects");
        status_topic_ = params.at("response_template").value("topic", "");
        told_.clear();
        Json status = Json::object();
        for (const auto& [object, fields] : wanted_.items()) {
            const Json all = status_of(object, now);
            for (const auto& field : fields)
                status[object][field.get<std::string>()] = all.value(field.get<std::string>(), Json());
            told_[object] = status[object];
        }
        next_report_ = now + report_interval;
        return {{"eventtime", now}, {"status", status}};
    }
    return nullptr;
}

SimulatedKlipper::Json SimulatedKlipper::status_of(const std::string& object, double now) const {
    if (object == "webhooks") return {{"state", state_}, {"state_message", message_}};
    if (object == "extruder") return {{"temperature", nozzle_.degrees}, {"target", nozzle_.target}};
    if (object == "heater_bed") return {{"temperature", bed_.degrees}, {"target", bed_.target}};
    if (object == "pause_resume") return {{"is_paused", paused_}};
    if (object == "print_stats") return {{"state", "printing"}, {"filename", options_.own_file}};
    if (object != "toolhead") return Json::object();
    std::string homed;
    for (int axis = 0; axis < 3; ++axis)
        if (homed_[axis]) homed += "xyz"[axis];
    return {{"print_time", print_time_},
            {"estimated_print_time", now},
            {"extruder", "extruder"},
            {"homed_axes", homed}};
}

/// Tells what has changed of what was subscribed.
void SimulatedKlipper::report(double now) {
    if (!wanted_.is_object() || now < next_report_) return;
    next_report_ = now + report_interval;
    Json status = Json::object();
    for (const auto& [object, fields] : wanted_.items()) {
        const Json all = status_of(object, now);
        for (const auto& field : fields) {
            const std::string name = field;
            const Json value = all.value(name, Json());
            if (told_[object].value(name, Json()) == value) continue;
            status[object][name] = told_[object][name] = value;
        }
    }
    if (!status.empty())
        say({{"topic", status_topic_}, {"params", {{"eventtime", now}, {"status", status}}}});
}

void SimulatedKlipper::heat(double seconds) {
    for (Heater* heater : {&nozzle_, &bed_}) {
        const double to = heater->target > 0 ? heater->target : 25;
        const double step = options_.heating_rate * seconds;
        heater->degrees += std::clamp(to - heater->degrees, -step, step);
    }
}

std::string SimulatedKlipper::run(double now) {
    constexpr double tick = 0.002;
    while (at_ < now) {
        const double next = std::min(now, at_ + tick);
        heat(next - at_);
        at_ = next;
        if (state_ == "startup" && at_ >= ready_at_) {
            state_ = options_.trouble.empty() ? "ready" : "error";
            message_ = options_.trouble.empty() ? "Printer is ready" : options_.trouble;
        }
        while (step(at_)) {
        }
        report(at_);
    }
    return std::exchange(said_, {});
}

bool SimulatedKlipper::step(double now) {
    if (scripts_.empty() || now < busy_until_ || state_ == "startup") return false;
    if (state_ == "ready" && (waits(now) || print_time_ - now > options_.look_ahead)) return false;
    Script& script = scripts_.front();
    running_ = true;
    std::string trouble;
    if (script.next < script.lines.size()) {
        const std::string line = script.lines[script.next++];
        trouble = state_ == "ready" ? execute(line, now) : message_;
        busy_until_ = std::max(busy_until_, now - 0.002) + options_.line_time;
        if (trouble.empty()) return true;
    }
    if (!trouble.empty()) {
        tell("!! " + trouble.substr(0, trouble.find('\n')));
        fail(script.id, trouble);
    } else {
        reply(script.id, Json::object());
    }
    scripts_.pop_front();
    running_ = false;
    return true;
}

bool SimulatedKlipper::waits(double now) {
    if (waiting_.empty()) return false;
    const bool heat =
        (waiting_ == "M109" && std::abs(nozzle_.degrees - nozzle_.target) > 1 && nozzle_.target > 0) ||
        (waiting_ == "M190" && std::abs(bed_.degrees - bed_.target) > 1 && bed_.target > 0);
    if (heat || (waiting_ != "M109" && waiting_ != "M190" && print_time_ > now)) return true;
    waiting_.clear();
    return false;
}

std::string SimulatedKlipper::move(const std::string& line, double now) {
    double to[4], way = 0;
    constexpr char letters[] = {'X', 'Y', 'Z', 'E'};
    bool moves = false;
    for (int axis = 0; axis < 4; ++axis) {
        to[axis] = place_[axis];
        const auto value = command_value(line, letters[axis]);
        if (!value) continue;
        const bool relative = axis == 3 ? relative_e_ : relative_;
        to[axis] = relative ? place_[axis] + *value : *value;
        if (axis < 3 && to[axis] != place_[axis]) moves = true;
        if (axis < 3) way += (to[axis] - place_[axis]) * (to[axis] - place_[axis]);
    }
    if (const auto feed = command_value(line, 'F')) feed_ = *feed;
    const std::string place = " " + std::to_string(to[0]) + " " + std::to_string(to[1]) + " " +
                              std::to_string(to[2]) + " [" + std::to_string(to[3]) + "]";
    for (int axis = 0; axis < 3 && moves; ++axis) {
        if (to[axis] == place_[axis]) continue;
        if (!homed_[axis]) return "Must home axis first:" + place;
        if (to[axis] < 0 || to[axis] > bed_size) return "Move out of range:" + place;
    }
    if (to[3] != place_[3] && nozzle_.degrees < coldest_extrusion)
        return "Extrude below minimum temp\nSee the 'min_extrude_temp' config option for details";
    const double length = moves ? std::sqrt(way) : std::abs(to[3] - place_[3]);
    std::copy(std::begin(to), std::end(to), place_);
    if (length <= 0 || feed_ <= 0) return {};
    if (print_time_ < now) {
        if (streams_) dry_ += now - print_time_;
        print_time_ = now + motion_start;
    }
    print_time_ += length / (feed_ / 60);
    streams_ = true;
    return {};
}

std::string SimulatedKlipper::pause_command(const std::string& name) {
    if (name == "PAUSE" || name == "CANCEL_PRINT") {
        if (!paused_ || name == "CANCEL_PRINT")
            tell(options_.old_words ? "// action:pause" : "// action:paused");
        paused_ = name == "PAUSE";
        if (!paused_) tell("// action:cancel");
    } else if (name == "RESUME") {
        if (paused_) tell(options_.old_words ? "// action:resume" : "// action:resumed");
        paused_ = false;
    } else {
        paused_ = false;
    }
    return {};
}

std::string SimulatedKlipper::execute(const std::string& line, double now) {
    if (const auto refused = refused_.find(line); refused != refused_.end()) {
        const std::string why = refused->second;
        refused_.erase(refused);
        return why;
    }
    const std::string name = name_of(line);
    if (name == "G0" || name == "G1") {
        if (std::string why = move(line, now); !why.empty()) return why;
        executed_.push_back(line);
        return {};
    }
    Heater& heater = name == "M140" || name == "M190" ? bed_ : nozzle_;
    if (name == "M104" || name == "M109" || name == "M140" || name == "M190") {
        const double degrees = command_value(line, 'S').value_or(0);
        if (degrees > hottest)
            return "Requested temperature (" + std::to_string(degrees) + ") out of range (0.0:300.0)";
        heater.target = degrees;
    }
    executed_.push_back(line);
    if (name == "M109" || name == "M190" || name == "M400" || name == "G28") waiting_ = name;
    if (name == "M109" || name == "M190" || name == "G28" || name == "M400") streams_ = false;
    if (name == "G28") {
        const bool all = line.find_first_of("XYZ") == std::string::npos;
        for (int axis = 0; axis < 3; ++axis) {
            if (!all && line.find("XYZ"[axis]) == std::string::npos) continue;
            homed_[axis] = true;
            place_[axis] = 0;
        }
        print_time_ = std::max(print_time_, now) + 1;
    } else if (name == "G4") {
        print_time_ = std::max(print_time_, now) + command_value(line, 'P').value_or(0) / 1000;
    } else if (name == "G92") {
        if (const auto e = command_value(line, 'E')) place_[3] = *e;
    } else if (name == "G90" || name == "G91") {
        relative_ = name == "G91";
    } else if (name == "M82" || name == "M83") {
        relative_e_ = name == "M83";
    } else if (name == "M84") {
        std::fill(std::begin(homed_), std::end(homed_), false);
    } else if (name == "SET_KINEMATIC_POSITION" && options_.force_move) {
        std::fill(std::begin(homed_), std::end(homed_), true);
        const auto at = line.find("Z=");
        if (at != std::string::npos) place_[2] = std::stod(line.substr(at + 2));
    } else if (options_.pause_resume &&
               (name == "PAUSE" || name == "RESUME" || name == "CLEAR_PAUSE" || name == "CANCEL_PRINT")) {
        return pause_command(name);
    } else if (name == "RESPOND") {
        tell("// " + told_text(line));
    } else if (name != "G21" && name != "M104" && name != "M109" && name != "M140" && name != "M190" &&
               name != "M106" && name != "M107" && name != "M204" && name != "M400") {
        tell("// Unknown command:\"" + name + "\"");
    }
    return {};
}

}  // namespace lamella::test
