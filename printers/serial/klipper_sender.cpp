// KlipperSender: scripts, waits for heat, and the watch over a silent socket.
#include "printers/serial/klipper_sender.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "printers/serial/gcode_line.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t most_lines = 64;    // of a script
constexpr std::size_t most_bytes = 4096;   // of a script
constexpr double longest_script = 0.5;     // s of motion at the programmed speeds; a pause waits for it
constexpr double startup_patience = 120;   // s
constexpr double sign_of_life_after = 10;  // s of silence
constexpr double silence_patience = 60;    // s
constexpr double longest_rest = 60;        // s; Klipper switches its heaters off when it rests for long
constexpr double nearly_warm = 2;          // degrees; Klipper itself waits for the rest, until it is steady
constexpr double target_patience = 2;      // s until a temperature that was set is reported

/// Commands that neither wait nor ask nor call a macro, unless somebody has replaced them by one.
bool is_plain(const std::string& command) {
    constexpr std::array<std::string_view, 21> traditional{
        "G0",  "G1",  "G2",   "G3",   "G4",   "G17",  "G21",  "G90",  "G91",  "G92", "M73",
        "M82", "M83", "M104", "M106", "M107", "M117", "M140", "M204", "M220", "M221"};
    constexpr std::array<std::string_view, 7> named{
        "SET_PRINT_STATS_INFO",  "SET_VELOCITY_LIMIT",   "SET_PRESSURE_ADVANCE", "SET_GCODE_OFFSET",
        "EXCLUDE_OBJECT_DEFINE", "EXCLUDE_OBJECT_START", "EXCLUDE_OBJECT_END"};
    const auto is = [](std::string_view word) {
        return [word](std::string_view one) { return one == word; };
    };
    return std::ranges::any_of(traditional, is(command_word(command))) ||
           std::ranges::any_of(named, is(std::string_view(command).substr(0, command.find(' '))));
}

bool is_one_of(const std::string& command, std::initializer_list<std::string_view> words) {
    const std::string word = command_word(command);
    return std::ranges::any_of(words, [&](std::string_view one) { return one == word; });
}

}  // namespace

KlipperSender::KlipperSender(SenderSettings settings, SenderListener listener)
    : LineSender(settings, std::move(listener), "info") {
    end_of_line_ = klipper_message_end;
    settings_.ping_pong = true;
}

void KlipperSender::ask(Asked what, const char* method, const Json& params) {
    asked_[next_id_] = what;
    put(klipper_request(next_id_++, method, params));
}

void KlipperSender::connect(double now) {
    state_ = State::asking;
    state_until_ = now + answer_patience;
    give_up_at_ = now + startup_patience;
    ask(Asked::info, "info", {{"client_info", {{"program", "lamella"}}}});
}

void KlipperSender::take_up_dialogue(double now) {
    asked_.clear();
    frames_.clear();
    connect(now);
}

void KlipperSender::drop_dialogue() {
    frames_.clear();
    if (state_ != State::running) return;
    stop(StopKind::reset,
         "the socket was lost: klippy has ended or was restarted, and has forgotten where the axes are. "
         "Unless it still runs, its boards switch the heaters off by themselves");
}

void KlipperSender::check_time(double now) {
    if (state_ == State::running) {
        if (now - heard_ >= silence_patience)
            return stop(StopKind::unanswered, "klippy is silent, and its heaters may be on");
        if (now - heard_ >= sign_of_life_after && !awaits(Asked::sign_of_life))
            ask(Asked::sign_of_life, "info", Json::object());
        return;
    }
    if (state_ == State::idle || now < state_until_) return;
    if (state_ == State::starting && now < give_up_at_) {
        state_ = State::asking;
        state_until_ = now + answer_patience;
        return ask(Asked::info, "info", Json::object());
    }
    if (state_ == State::starting) return stop(StopKind::refused, "Klipper does not get ready: " + remark_);
    stop(StopKind::unanswered,
         "the socket is silent; accepted: the API socket of a running klippy (its option -a), such as "
         "~/printer_data/comms/klippy.sock");
}

double KlipperSender::next_wake() const {
    if (state_ == State::idle) return never;
    if (state_ != State::running) return state_until_;
    const double life = heard_ + (awaits(Asked::sign_of_life) ? silence_patience : sign_of_life_after);
    return rests() ? std::min(life, rests_since_ + longest_rest) : life;
}

bool KlipperSender::awaits(Asked what) const {
    return std::ranges::any_of(asked_, [what](const auto& request) { return request.second == what; });
}

void KlipperSender::send_script(std::deque<std::string>& lines, bool of_job, double now) {
    Script script;
    script.of_job = of_job;
    std::string text;
    double seconds = 0;
    std::vector<std::string> taken;
    while (!lines.empty() && script.lines < most_lines && text.size() < most_bytes &&
           seconds < longest_script) {
        // A failed line of the host must not keep the ones behind it from being executed.
        const bool alone = !of_job || !is_plain(lines.front());
        if (alone && script.lines > 0) break;
        std::string line = std::move(lines.front());
        lines.pop_front();
        seconds += machine_.apply(line);
        (text += text.empty() ? "" : "\n") += line;
        ++script.lines;
        taken.push_back(std::move(line));
        // If the next script fails, the part before it is known to be done.
        const bool ends = of_job && !part_ends_.empty() && sent_job_ + script.lines == part_ends_.front();
        if (ends) part_ends_.pop_front();
        if (alone || ends) break;
    }
    script.first = taken.front();
    script.last = taken.back();
    const std::string request = klipper_request(next_id_, "gcode/script", {{"script", text}});
    script.bytes = request.size();
    asked_[next_id_++] = Asked::script;
    script_ = script;
    if (of_job) sent_job_ += script.lines;
    put(request);
    for (const std::string& line : taken) log_sent(line, now);
}

/// Returns the heater that a command waits for, if its temperature is reported.
std::optional<KlipperSender::HeatWait> KlipperSender::heat_wait(const std::string& command) const {
    if (!is_one_of(command, {"M109", "M190"})) return std::nullopt;
    const bool bed = is_one_of(command, {"M190"});
    const auto degrees = command_value(command, 'S');
    if (!degrees) return std::nullopt;
    HeatWait wait{command, bed ? "heater_bed" : extruder_, *degrees,
                  (bed ? "M140" : "M104") + command.substr(4)};
    if (const auto tool = command_value(command, 'T'); tool && !bed)
        wait.heater = *tool == 0 ? "extruder" : "extruder" + std::to_string(static_cast<int>(*tool));
    if (!heaters_.contains(wait.heater)) return std::nullopt;
    return wait;
}

/// Returns true while a command that waits for heat is to be held back.
bool KlipperSender::waits_for_heat(const std::string& command, double now) {
    auto wait = heat_wait(command);
    if (!wait) return false;
    const Heater& heater = heaters_.at(wait->heater);
    const bool begun = warming_ && warming_->command == command;
    // Somebody else may have changed the temperature meanwhile: the command itself sets it again.
    const bool given_up =
        begun && now - warming_->since > target_patience && std::abs(heater.target - wait->degrees) > 0.5;
    if (heater.degrees >= wait->degrees - nearly_warm || given_up) {
        warming_.reset();
        return false;
    }
    if (begun) return true;
    wait->since = now;
    std::deque<std::string> heat{wait->heat};
    const bool is_set = heater.target == wait->degrees;
    warming_ = std::move(wait);
    if (!is_set) send_script(heat, false, now);
    return true;
}

void KlipperSender::feed(double now) {
    if (stop_ || state_ != State::running || script_ || failing_) return;
    const bool has_job = !held_ && !refused_ && !pending_.empty();
    if (!urgent_.empty() || has_job) {
        std::deque<std::string>& lines = urgent_.empty() ? pending_ : urgent_;
        if (!waits_for_heat(lines.front(), now)) {
            send_script(lines, &lines == &pending_, now);
            return;
        }
        if (script_) return;
    } else if (finishing_ && !held_ && !refused_ && !finish_sent_) {
        // Is answered when all motion is done.
        std::deque<std::string> last{"M400"};
        send_script(last, false, now);
        finish_sent_ = true;
        return;
    }
    if (!rests() || now - rests_since_ < longest_rest) return;
    // A dwell of a moment keeps Klipper from taking a pause, or a layer that takes long, for the end.
    std::deque<std::string> dwell{"G4 P1"};
    send_script(dwell, false, now);
}

void KlipperSender::halt(double) {
    stop(StopKind::halted, "halted");
    transmit_raw(klipper_request(next_id_++, "emergency_stop", Json::object()), true);
}

void KlipperSender::hold_motion(bool held) {
    if (!held && paused_) urgent_.emplace_front("RESUME");
    paused_ = paused_ && held;
}

void KlipperSender::forget_pause() {
    if (std::exchange(paused_, false)) urgent_.emplace_back("CLEAR_PAUSE");
}

void KlipperSender::end_waiting() {
    warming_.reset();
    dialog_.reset();
}

std::optional<UserWait> KlipperSender::user_wait() const {
    if (!dialog_ || !dialog_->shown) return std::nullopt;
    return dialog_->wait;
}

void KlipperSender::choose(std::size_t button) {
    if (!dialog_ || button >= dialog_->commands.size()) return;
    urgent_.push_front(dialog_->commands[button]);
    dialog_.reset();
}

LineWait KlipperSender::line_wait() const {
    if (!script_) return warming_ ? LineWait::heat : LineWait::none;
    if (is_one_of(script_->first, {"M109", "M190"})) return LineWait::heat;
    const bool plain = is_plain(script_->first) || is_one_of(script_->first, {"M400", "M84", "M18"});
    return plain ? LineWait::none : LineWait::other;
}

}  // namespace lamella
