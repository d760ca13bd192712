// Dry run: a print with the real sender and a simulated printer instead of a port.
#include <algorithm>
#include <chrono>

#include "engine/base/error.h"
#include "printers/serial/grbl_sender.h"
#include "printers/serial/klipper_message.h"
#include "printers/serial/klipper_sender.h"
#include "printers/serial/marlin_sender.h"
#include "printers/serial/serial_output.h"

namespace lamella {
namespace {

/// Drives the real sender. Every line it sends is answered before the next one is processed.
class DryRunOutput : public GcodeOutput {
  public:
    DryRunOutput(const LinkSettings& settings, DryRun& report)
        : is_klipper_(settings.dialect == Dialect::klipper),
          maker_(settings.dialect, settings.motion),
          report_(report) {
        SenderSettings sender = settings.sender;
        sender.greeting = 0;
        sender.byte_time = 0;
        SenderListener listener;
        if (!settings.log.empty()) {
            log_ = std::make_unique<LineLog>(settings.log);
            listener.on_line = [this](char direction, std::string_view line, std::size_t in_flight) {
                log_->add(now_, direction, in_flight, line);
            };
        }
        if (settings.dialect == Dialect::grbl) {
            sender_ = std::make_unique<GrblSender>(sender, std::move(listener));
        } else if (is_klipper_) {
            sender_ = std::make_unique<KlipperSender>(sender, std::move(listener));
        } else {
            sender_ = std::make_unique<MarlinSender>(sender, std::move(listener));
        }
    }

    int begin(const JobStamp& stamp, bool resume) override {
        if (resume) throw InputError("--dry-run leaves nothing behind that could be resumed");
        sender_->connect(0);
        return stamp.range.first;
    }
    nlohmann::ordered_json state() const override { return nullptr; }
    InputError damaged_state() const override { return InputError("a dry run keeps no state"); }
    void commit(std::string_view text, int, const nlohmann::ordered_json&) override {
        const CleanText clean = maker_.clean(text);
        const std::string& lines = clean.lines;
        for (const LineFacts& line : clean.facts) report_.model_seconds += static_cast<double>(line.seconds);
        for (std::size_t at = 0; at < lines.size();) {
            const std::size_t end = lines.find('\n', at);
            sender_->push(lines.substr(at, end - at));
            at = end + 1;
        }
        run([&] { return sender_->connected() && sender_->idle(); });
    }
    void end(std::string_view text) override {
        commit(text, 0, nullptr);
        sender_->finish();
        run([&] { return sender_->finished(); });
        report_.lines = maker_.lines();
        report_.bytes = sender_->statistics().bytes;
        report_.seconds = maker_.seconds();
        report_.need = maker_.need();
        if (report_.lines == 0) throw InputError("the job holds no line to send");
        if (log_) {
            log_->close();
            if (!log_->trouble().empty()) throw FaultError("the log cannot be written: " + log_->trouble());
        }
        if (sender_->answered() != report_.lines) throw FaultError("the dry run did not come to its end");
    }

  private:
    template <class Done>
    void run(Done done) {
        const auto start = std::chrono::steady_clock::now();
        while (!sender_->stopped() && !done()) {
            now_ += 0.001;
            sender_->tick(now_);
            is_klipper_ ? answer_as_klippy() : answer();
        }
        report_.sending_seconds +=
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (sender_->stopped()) throw FaultError(sender_->stopped()->why);
    }
    void answer() {
        while (!sender_->output().empty()) {
            const std::string out(sender_->output());
            sender_->wrote(out.size());
            std::string replies;
            for (std::size_t at = 0; at < out.size();) {
                const std::size_t end = std::min(out.find('\n', at), out.size());
                const std::string_view line = std::string_view(out).substr(at, end - at);
                if (line.find("M115") != std::string_view::npos) replies += "FIRMWARE_NAME:Marlin\n";
                if (end < out.size())
                    replies += line.find(" M105*") != std::string_view::npos ? "ok T:0 /0\n" : "ok\n";
                at = end + 1;
            }
            sender_->receive(replies, now_);
        }
    }

    /// Answers as a klippy that is ready, has no sensors, and does each script at once.
    void answer_as_klippy() {
        while (!sender_->output().empty()) {
            asked_.feed(sender_->output());
            sender_->wrote(sender_->output().size());
            std::string replies;
            while (const auto request = asked_.next()) {
                const auto message = parse_klipper_message(*request);
                if (!message || !message->id) throw FaultError("the dry run sends what is no request");
                const nlohmann::ordered_json reply = {
                    {"id", *message->id},
                    {"result", {{"state", "ready"}, {"objects", nlohmann::ordered_json::array()}}}};
                (replies += reply.dump()) += klipper_message_end;
            }
            sender_->receive(replies, now_);
        }
    }

    bool is_klipper_;
    KlipperFrames asked_;
    std::unique_ptr<LineLog> log_;
    ChunkMaker maker_;
    DryRun& report_;
    std::unique_ptr<LineSender> sender_;
    double now_ = 0;
};

}  // namespace

std::unique_ptr<GcodeOutput> make_dry_run(const LinkSettings& settings, DryRun& report) {
    return std::make_unique<DryRunOutput>(settings, report);
}

}  // namespace lamella
