// The simulated Marlin's ring, slots and planner.
#include "tests/printers/serial/simulated_firmware.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace lamella::test {
namespace {

constexpr std::size_t ring_size = 128;
constexpr std::size_t longest = 95;
constexpr std::size_t slot_count = 4;
constexpr std::size_t planner_size = 16;

bool is(const std::string& text, const char* word) {
    const std::string front(word);
    return text.compare(0, front.size(), front) == 0 &&
           (text.size() == front.size() || text[front.size()] == ' ');
}

double value(const std::string& text, char letter, double otherwise) {
    const auto at = text.find(letter, 1);
    return at == std::string::npos ? otherwise : std::strtod(text.c_str() + at + 1, nullptr);
}

}  // namespace

void SimulatedMarlin::boot(double now) {
    ring_.clear();
    line_.clear();
    early_.clear();
    slots_.clear();
    planner_.clear();
    running_ = reports_ = killed_ = wait_for_heat_ = wait_for_user_ = false;
    last_number_ = 0;
    nozzle_target_ = bed_target_ = 0;
    ready_at_ = now + 0.3;
    said_ += options_.old ? "start\necho:PowerUp\nMarlin 1.1.9.1\n\necho: Last Updated: 2018\n"
                          : "start\nPowerUp\nMarlin 2.1.2.1\necho: Last Updated: 2022\n";
}

void SimulatedMarlin::emergency(char c, double now) {
    if (!options_.emergency_parser) return;
    if (c != '\n') {
        early_ += c;
        return;
    }
    if (early_ == "M112") kill(now);
    if (early_ == "M108") end_wait();
    if (early_.starts_with("M876 S")) wait_for_user_ = false;
    early_.clear();
}

void SimulatedMarlin::end_wait() { wait_for_heat_ = wait_for_user_ = false; }

void SimulatedMarlin::receive(std::string_view bytes, double now) {
    for (const char c : bytes) {
        if (killed_) return;
        emergency(c, now);
        if (ring_.size() < ring_size) {
            ring_ += c;
        } else {
            ++lost_bytes_;
        }
        fullest_ = std::max(fullest_, ring_.size());
    }
}

void SimulatedMarlin::kill(double now) {
    if (killed_) return;
    killed_ = true;
    killed_at_ = now;
    nozzle_target_ = bed_target_ = 0;
    said_ += "echo:M112 Shutdown\nError:Printer halted. kill() called!\n";
}

void SimulatedMarlin::line_error(const std::string& what) {
    ++errors_;
    ring_.clear();
    said_ += "Error:" + what + ", Last Line: " + std::to_string(last_number_) + "\n";
    said_ += "Resend: " + std::to_string(last_number_ + 1) + "\n";
    if (options_.resend_has_ok) said_ += "ok\n";
}

/// get_serial_commands of Marlin: the number is looked at before the sum.
void SimulatedMarlin::read_line(double now) {
    std::string text = std::exchange(line_, {});
    text.erase(0, text.find_first_not_of(' '));
    if (text.empty() || text[0] == ';') return;
    Command command{text, -1};
    if (text[0] == 'N') {
        std::size_t at = 0;
        const bool m110 = text.find("M110") != std::string::npos;
        if (m110) {
            if (const auto second = text.find('N', 4); second != std::string::npos) at = second;
        }
        const long number = std::strtol(text.c_str() + at + 1, nullptr, 10);
        if (number != last_number_ + 1 && !m110) {
            if (!options_.old && (number == last_number_ || number == last_number_ - 1)) return;
            return line_error("Line Number is not Last Line Number+1");
        }
        const auto star = text.rfind('*');
        if (star == std::string::npos) return line_error("No Checksum with line number");
        unsigned sum = 0;
        for (std::size_t i = 0; i < star; ++i) sum ^= static_cast<unsigned char>(text[i]);
        if (std::strtol(text.c_str() + star + 1, nullptr, 10) != static_cast<long>(sum))
            return line_error("checksum mismatch");
        if (!m110 && std::uniform_real_distribution<>(0, 1)(random_) < options_.spurious)
            return line_error("checksum mismatch");
        last_number_ = number;
        command.number = number;
        std::size_t begin = 1;
        while (begin < text.size() && std::isdigit(static_cast<unsigned char>(text[begin])) != 0) ++begin;
        text.erase(0, begin);
        text.erase(0, text.find_first_not_of(' '));
        command.text = text;
    }
    command.text = command.text.substr(0, command.text.find('*'));
    if (command.number < 0 && is(command.text, "M112")) return kill(now);
    if (command.number < 0 && is(command.text, "M108")) end_wait();
    slots_.push_back(command);
}

std::string SimulatedMarlin::temperatures() const {
    const auto text = [](double t) { return std::to_string(static_cast<int>(t)) + ".00"; };
    return "T:" + text(nozzle_) + " /" + text(nozzle_target_) + " B:25.00 /" + text(bed_target_) +
           " @:0 B@:0";
}

void SimulatedMarlin::start_command(double now) {
    const std::string& text = slots_.front().text;
    const auto digits = text.find_first_not_of("0123456789", 1);
    const bool known = text.size() > 1 && std::string("GMT").find(text[0]) != std::string::npos &&
                       digits != 1 && (digits == std::string::npos || text[digits] == ' ');
    running_ = true;
    run_until_ = now + options_.line_time;
    next_busy_ = now + 2;
    if (!known) {
        said_ += "echo:Unknown command: \"" + text + "\"\n";
        return;
    }
    executed_.push_back(text);
    if (is(text, "G0") || is(text, "G1")) {
        const double to_x = value(text, 'X', x_), to_y = value(text, 'Y', y_);
        feed_ = value(text, 'F', feed_);
        const double way = std::hypot(to_x - x_, to_y - y_);
        x_ = to_x, y_ = to_y;
        const double from = planner_.empty() ? now : std::max(now, planner_.back());
        // A full planner keeps the command waiting until its first move is done.
        if (planner_.size() >= planner_size) run_until_ = std::max(run_until_, planner_.front());
        if (way > 0) planner_.push_back(from + way / feed_ * 60);
    } else if (is(text, "G28")) {
        run_until_ = now + 3;
        x_ = y_ = 0;
    } else if (is(text, "G4")) {
        run_until_ = now + value(text, 'S', value(text, 'P', 0) / 1000);
    } else if (is(text, "M0")) {
        wait_for_user_ = true;
        if (options_.host_prompts) {
            said_ += "//action:prompt_end\n//action:prompt_begin M0 Stop\n//action:prompt_button Continue\n";
            said_ += "//action:prompt_show\n";
        }
    } else if (is(text, "M600")) {
        // Its dialogs follow one another, and none is ever ended.
        wait_for_user_ = true;
        said_ +=
            "//action:prompt_begin Nozzle Parked\n//action:prompt_button Continue\n//action:prompt_show\n";
    } else if (is(text, "M400") && !planner_.empty()) {
        run_until_ = std::max(run_until_, planner_.back());
    } else if (is(text, "M104") || is(text, "M109")) {
        nozzle_target_ = value(text, 'S', 0);
        wait_for_heat_ = is(text, "M109") && nozzle_target_ > nozzle_;
        next_report_ = now + 1;
        if (!wait_for_heat_) nozzle_ = nozzle_target_ > 0 ? nozzle_target_ : 25;
        if (wait_for_heat_) run_until_ = now + (nozzle_target_ - nozzle_) / options_.heating_rate;
    } else if (is(text, "M140") || is(text, "M190")) {
        bed_target_ = value(text, 'S', 0);
    } else if (is(text, "M155")) {
        reports_ = value(text, 'S', 0) > 0;
        next_report_ = now + 1;
    } else if (is(text, "M115")) {
        said_ += "FIRMWARE_NAME:" + options_.name + " " + (options_.old ? "1.1.9.1" : "2.1.2.1") +
                 " (Github) SOURCE_CODE_URL:github.com/" + options_.name + " PROTOCOL_VERSION:1.0\n";
        said_ += "Cap:SERIAL_XON_XOFF:0\nCap:EEPROM:0\nCap:AUTOREPORT_TEMP:1\n";
        said_ += std::string("Cap:EMERGENCY_PARSER:") + (options_.emergency_parser ? "1\n" : "0\n");
    }
}

void SimulatedMarlin::answer(const Command& command) {
    if (is(command.text, "M105")) {
        said_ += "ok " + temperatures() + "\n";
        return;
    }
    said_ += "ok";
    if (options_.advanced_ok) {
        if (command.number >= 0) said_ += " N" + std::to_string(command.number);
        said_ += " P" + std::to_string(planner_size - 1 - std::min(planner_.size(), planner_size - 1));
        said_ += " B" + std::to_string(slot_count - slots_.size());
    }
    said_ += "\n";
}

std::string SimulatedMarlin::run(double now) {
    const auto take_lines = [&] {
        while (!killed_ && !ring_.empty() && slots_.size() < slot_count) {
            const char c = ring_.front();
            ring_.erase(0, 1);
            if (c == '\n' || c == '\r') {
                read_line(now);
            } else if (line_.size() < longest) {
                line_ += c;
            }
        }
    };
    // Its time is its own: several commands may end between two calls.
    double at = running_ ? run_until_ : now;
    while (!killed_ && now >= ready_at_) {
        take_lines();
        while (!planner_.empty() && planner_.front() <= now) planner_.pop_front();
        if (running_ && wait_for_heat_) {
            if (now >= next_report_) said_ += " " + temperatures() + " W:?\n", next_report_ += 1;
        } else if (running_ && options_.keepalive && now >= next_busy_) {
            said_ += wait_for_user_ ? "echo:busy: paused for user\n" : "echo:busy: processing\n";
            next_busy_ += 2;
        }
        if (running_ && !wait_for_user_ &&
            (now >= run_until_ || (is(slots_.front().text, "M109") && !wait_for_heat_))) {
            at = is(slots_.front().text, "M0") || is(slots_.front().text, "M600") ? now
                                                                                  : std::min(now, run_until_);
            if (is(slots_.front().text, "M109") && wait_for_heat_) nozzle_ = nozzle_target_;
            wait_for_heat_ = running_ = false;
            const Command done = slots_.front();
            slots_.pop_front();
            answer(done);
        }
        if (running_ || slots_.empty()) break;
        start_command(std::max(at, now - 0.01));
    }
    if (reports_ && !killed_ && now >= next_report_ && !running_) {
        said_ += " " + temperatures() + "\n";
        next_report_ = now + 1;
    }
    return std::exchange(said_, {});
}

std::vector<std::string> job_lines(const std::vector<std::string>& executed) {
    std::vector<std::string> lines;
    for (const std::string& line : executed) {
        const bool own = is(line, "M105") || is(line, "M110") || is(line, "M115") || is(line, "M155") ||
                         is(line, "M400") || is(line, "M108") || is(line, "M876");
        if (!own) lines.push_back(line);
    }
    return lines;
}

std::string first_difference(const std::vector<std::string>& executed,
                             const std::vector<std::string>& wanted) {
    const auto at = [](const std::vector<std::string>& lines, std::size_t i) {
        return i < lines.size() ? "\"" + lines[i] + "\"" : std::string("nothing");
    };
    for (std::size_t i = 0; i < std::max(executed.size(), wanted.size()); ++i) {
        if (at(executed, i) == at(wanted, i)) continue;
        return "line " + std::to_string(i) + " of " + std::to_string(wanted.size()) + ": " + at(executed, i) +
               " instead of " + at(wanted, i) + "; " + std::to_string(executed.size()) + " were executed";
    }
    return {};
}

}  // namespace lamella::test
