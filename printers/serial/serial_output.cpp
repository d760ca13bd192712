// SerialOutput: sends layers over a link and resumes an interrupted print.
#include "printers/serial/serial_output.h"

#include <fmt/format.h>

#include <fstream>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/archive/output_file.h"
#include "printers/serial/klipper_socket.h"

namespace lamella {
namespace {

class SerialOutput : public GcodeOutput {
  public:
    SerialOutput(std::shared_ptr<PrintLink> link, const LinkSettings& settings, SerialOutputOptions options)
        : link_(std::move(link)),
          settings_(settings),
          options_(std::move(options)),
          maker_(settings.dialect, settings.motion) {}

    int begin(const JobStamp& stamp, bool resume) override {
        link_->set_stamp(lamella::to_json(stamp));
        first_ = stamp.range.first;
        int next = first_;
        nlohmann::ordered_json record;
        if (resume && !is_present(settings_.journal)) {
            throw InputError(
                "--resume: there is no journal " + settings_.journal +
                ", so it is not known where the print stopped; accepted: --journal with the file of "
                "that print, or no --resume, which begins with the first line");
        }
        if (is_present(settings_.journal)) {
            if (resume) {
                record = read_journal(stamp);
            } else if (!options_.force) {
                throw InputError(
                    settings_.journal +
                    " is left from a print that was stopped; continue it with --resume, or discard it "
                    "with --force");
            }
        }
        outlook_.layers = stamp.range.last - first_;
        if (record.is_null()) {
            link_->expect(outlook_);
            link_->connect();
            return next;
        }
        try {
            const nlohmann::ordered_json& last = record.at("resume");
            next = whole_number<int>(last.at("next"));
            state_ = last.at("state");
            maker_.restore_machine(last.at("machine"));
            const double z = options_.z ? *options_.z : record.at("z").get<double>();
            if (next < stamp.range.first || next > stamp.range.last) throw damaged_state();
            // Only Klipper tells whether it still knows where it is.
            const bool asks = settings_.dialect == Dialect::klipper;
            std::vector<std::string> way;
            if (!asks) way = way_back(z);
            outlook_.layers_before = next - first_;
            link_->expect(outlook_);
            link_->connect();
            if (asks) way = klipper_way_back(z);
            PrintChunk chunk{"", 0, next, last};
            for (const std::string& line : way) {
                (chunk.lines += line) += '\n';
                ++chunk.count;
            }
            link_->submit(std::move(chunk));
        } catch (const nlohmann::json::exception&) {
            throw damaged_state();
        }
        return next;
    }
    nlohmann::ordered_json state() const override { return state_; }
    InputError damaged_state() const override {
        return InputError(settings_.journal + " is damaged; discard it with --force");
    }
    void skip(std::string_view text, double seconds) override {
        maker_.skip(text);
        outlook_.seconds_before = outlook_.seconds_before.value_or(0) + seconds;
    }
    void expect(double seconds) override {
        outlook_.seconds_ahead = seconds;
        outlook_.seconds_before = outlook_.seconds_before.value_or(0);
        outlook_.source_lines = true;
        link_->expect(outlook_);
    }
    void commit(std::string_view text, int next, const nlohmann::ordered_json& state) override {
        send(text, next, state);
    }
    void end(std::string_view text) override {
        send(text, -1, nullptr);
        if (maker_.lines() == 0) throw InputError("the job holds no line to send");
        link_->finish();
    }

  private:
    nlohmann::ordered_json read_journal(const JobStamp& stamp) const {
        std::ifstream in(settings_.journal);
        const std::string text(std::istreambuf_iterator<char>(in), {});
        auto record = nlohmann::ordered_json::parse(shallow_json(text), nullptr, false);
        if (!record.is_object() || !record.contains("stamp")) throw damaged_state();
        check_same_job(record["stamp"], stamp, settings_.journal);
        return record;
    }
    /// Returns the lines that bring the machine to the start of the first missing layer.
    std::vector<std::string> way_back(double z) const {
        if (settings_.dialect != Dialect::grbl) return filament_way_back(z, "G92 Z" + format_number(z, 3));
        const GrblModes& modes = maker_.grbl_modes();
        if (!modes.obstacle().empty())
            throw InputError("this job cannot be taken up: " + modes.obstacle() +
                             "; discard it with --force");
        if (options_.warn) {
            options_.warn(
                "the machine goes on from the origin it has now: it has to be where it was when the job "
                "began "
                "(GRBL forgets G92 in a reset, and where it is when it is switched off)");
        }
        return modes.take_up();
    }
    std::vector<std::string> klipper_way_back(double z) const {
        const LinkStatus status = link_->status();
        if (status.knows_height) return filament_way_back(z, "");
        if (status.takes_height)
            return filament_way_back(z, "SET_KINEMATIC_POSITION Z=" + format_number(z, 3));
        throw InputError(
            "--resume: Klipper has forgotten the height of its nozzle and takes none; accepted: [force_move] "
            "with enable_force_move: True in printer.cfg, then RESTART, or Z homed beside the part");
    }
    std::vector<std::string> filament_way_back(double z, const std::string& height_line) const {
        return maker_.machine().take_up(z, settings_.park_x, settings_.park_y, settings_.highest,
                                        height_line);
    }
    void send(std::string_view text, int next, const nlohmann::ordered_json& state) {
        const std::int64_t before = maker_.lines();
        PrintChunk chunk;
        CleanText clean = maker_.clean(text);
        chunk.lines = std::move(clean.lines);
        chunk.facts = std::move(clean.facts);
        chunk.count = maker_.lines() - before;
        // What comes before the first layer and behind the last one is none.
        chunk.layer = next > first_ ? next - 1 : -1;
        if (next >= 0)
            chunk.resume = {{"next", next}, {"state", state}, {"machine", maker_.machine_to_json()}};
        if (!warned_ && options_.warn && settings_.dialect != Dialect::klipper) {
            const std::string warning = link_warning(maker_.need(), settings_.baud);
            warned_ = !warning.empty();
            if (warned_) options_.warn(warning);
        }
        link_->submit(std::move(chunk));
    }

    std::shared_ptr<PrintLink> link_;
    LinkSettings settings_;
    SerialOutputOptions options_;
    ChunkMaker maker_;
    JobOutlook outlook_;
    int first_ = 0;
    nlohmann::ordered_json state_;
    bool warned_ = false;
};

}  // namespace

void suit_printer(LinkSettings& settings, const PrinterProfile& printer) {
    const GcodeProfile& gcode = printer.gcode;
    if (gcode.flavour == Flavour::grbl) settings.dialect = Dialect::grbl;
    settings.park_y = printer.filament.bed_y;
    settings.highest = printer.filament.bed_z;
    settings.motion.acceleration = settings.motion.travel_acceleration = gcode.acceleration;
    settings.motion.junction_deviation = gcode.junction_deviation;
}

void choose_dialect(LinkSettings& settings, const std::string& firmware, const PrinterProfile* printer) {
    const bool socket = is_socket(settings.port);
    if (socket && !firmware.empty() && firmware != "klipper") {
        throw InputError("--firmware " + firmware + " conflicts with --port " + settings.port +
                         ", a socket, which is Klipper's; accepted: --firmware klipper, or a serial port");
    }
    if (firmware == "klipper" && !socket && !settings.port.empty()) {
        throw InputError(
            "--firmware klipper prints over Klipper's API socket, and " + settings.port +
            " is none; accepted: --port with a socket, such as ~/printer_data/comms/klippy.sock; "
            "`lamella ports` lists them");
    }
    const bool klipper = socket || firmware == "klipper";
    const Flavour flavour = printer != nullptr   ? printer->gcode.flavour
                            : klipper            ? Flavour::klipper
                            : firmware == "grbl" ? Flavour::grbl
                                                 : Flavour::marlin;
    const bool grbl = flavour == Flavour::grbl;
    if (klipper && flavour != Flavour::klipper) {
        throw InputError(
            (socket ? settings.port + ", a socket of Klipper," : "--firmware klipper") +
            std::string(" conflicts with the printer's flavour; accepted: a printer with Klipper, "
                        "such as --printer klipper, or --printer-flavour klipper"));
    }
    if (!firmware.empty() && grbl != (firmware == "grbl")) {
        throw InputError("--firmware " + firmware + " conflicts with the printer's flavour; " +
                         (grbl ? "a laser under grbl does not accept Marlin G-code; accepted: --firmware grbl"
                               : "accepted: --printer-flavour grbl, to cut layers with a laser"));
    }
    settings.dialect = klipper ? Dialect::klipper : grbl ? Dialect::grbl : Dialect::marlin;
}

std::unique_ptr<GcodeOutput> make_serial_output(std::shared_ptr<PrintLink> link, const LinkSettings& settings,
                                                SerialOutputOptions options) {
    return std::make_unique<SerialOutput>(std::move(link), settings, std::move(options));
}

std::string link_warning(const LinkNeed& need, int baud) {
    const double link = baud / 10.0;
    if (need.bytes <= link) return {};
    return fmt::format(
        "the job needs up to {:.0f} lines/s ({:.0f} bytes/s) but {} baud carry {:.0f} bytes/s: the printer "
        "will "
        "slow down there; a larger tolerance makes longer lines",
        need.lines, need.bytes, baud, link);
}

}  // namespace lamella
