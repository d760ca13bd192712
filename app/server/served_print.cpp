// One thread computes layers for the link, another one tells how far the print is.
#include "app/server/served_print.h"

#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include "app/console/interrupt.h"
#include "app/console/print_texts.h"
#include "app/reports/empty_job.h"
#include "engine/base/error.h"
#include "engine/layers/layer_stream.h"
#include "printers/archive/output_file.h"
#include "printers/gcode/gcode.h"
#include "printers/serial/serial_output.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds event_interval{500};

/// Rounds to so many digits behind the point: nobody reads more.
double rounded(double value, int digits) {
    const double scale = std::pow(10, digits);
    return std::round(value * scale) / scale;
}

Json whole_seconds(std::optional<double> seconds) {
    return seconds ? Json(static_cast<std::int64_t>(std::lround(*seconds))) : Json();
}

Json temperatures_json(const LinkStatus& status) {
    if (status.dialect == Dialect::grbl) return nullptr;
    const Temperatures& t = status.temperatures;
    return {{"nozzle", rounded(t.nozzle, 1)},
            {"nozzle_target", t.nozzle_target},
            {"bed", rounded(t.bed, 1)},
            {"bed_target", t.bed_target}};
}

Json question_json(const LinkStatus& status) {
    if (!status.waits) return nullptr;
    return {{"text", status.waits->text}, {"buttons", status.waits->buttons}};
}

}  // namespace

void ServedPrint::Rates::measure(const LinkStatus& status) {
    constexpr double least_time = 0.1;  // s
    const double passed = status.seconds - at;
    if (passed < least_time) return;
    lines_a_second = static_cast<double>(status.statistics.lines - lines) / passed;
    bytes_a_second = static_cast<double>(status.statistics.bytes - bytes) / passed;
    at = status.seconds;
    lines = status.statistics.lines;
    bytes = status.statistics.bytes;
}

ServedPrint::ServedPrint(int number, std::shared_ptr<const ServedJob> job, PrintRequest request, int threads,
                         EventHub& events)
    : number_(number),
      job_(std::move(job)),
      request_(std::move(request)),
      threads_(threads),
      events_(events),
      messages_(number, [this](const Json& message) { events_.send("", "print_message", message); }) {
    request_.link.on_message = [this](const std::string& text) { messages_.add(text); };
    link_ = std::make_shared<PrintLink>(request_.link);
    printing_ = std::thread([this] { print(); });
    watching_ = std::thread([this] { watch(); });
}

ServedPrint::~ServedPrint() {
    stop();
    printing_.join();
    watching_.join();
}

bool ServedPrint::has_ended() const {
    const std::lock_guard lock(mutex_);
    return end_ != End::none;
}

void ServedPrint::wait() const {
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return end_ != End::none; });
}

void ServedPrint::stop() {
    stopping_ = true;
    link_->stop();
    cancel_.cancel();
}

void ServedPrint::halt() {
    stopping_ = true;
    link_->halt();
    cancel_.cancel();
}

void ServedPrint::produce() {
    const PrinterProfile& printer = job_->recipe.printer;
    const SerialOutputOptions output{request_.discard_journal, request_.z,
                                     [this](const std::string& text) { messages_.add(text); }};
    const auto backend = make_gcode(printer, make_serial_output(link_, request_.link, output));
    StreamOptions stream;
    stream.range = {0, job_->job().layers.count()};
    stream.threads = threads_;
    stream.resume = request_.resume;
    stream.cancel = &cancel_;
    const StreamReport report = stream_layers(job_->job(), *backend, stream);
    const std::string empty = empty_job_text(job_->recipe, job_->job(), report);
    if (!empty.empty()) throw InputError(empty);
    for (const std::string& note : backend->notes()) messages_.add(note);
}

void ServedPrint::print() {
    // Ctrl-Z must not stop the process: a hot nozzle would rest on the part.
    const TerminalGuard terminal(true);
    std::exception_ptr failure;
    try {
        produce();
    } catch (...) {
        failure = std::current_exception();
    }
    note_end(failure);
}

/// Waits until the machine is left alone, whatever has ended the print.
void ServedPrint::note_end(const std::exception_ptr& failure) {
    Ending ending{End::done, ""};
    if (failure) {
        ending = ending_of(failure);
        // The layers end before the machine does: it has the last word on how it was left.
        if (const std::exception_ptr reason = link_->end_reason()) {
            const Ending left = ending_of(reason);
            if (ending.end == End::stopped) ending = left;
            if (left.end == End::stopped && ending.end == End::failed) ending.message += "; " + left.message;
        }
    } else {
        ending.message = summary_text(link_->status());
    }
    const std::lock_guard lock(mutex_);
    printed_ = std::move(ending);
    ended_.notify_all();
}

ServedPrint::Ending ServedPrint::ending_of(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const Interrupted& error) {
        return {End::stopped, error.what()};
    } catch (const std::exception& error) {
        return {End::failed, error.what()};
    }
}

void ServedPrint::watch() {
    PrintRemarks remarks(messages_);
    bool has_printed = false;
    while (!has_printed) {
        const LinkStatus status = link_->status();
        remarks.look(status);
        if (TerminalGuard::take_stop()) messages_.add("Ctrl-Z does not stop a print");
        {
            const std::lock_guard lock(mutex_);
            rates_.measure(status);
        }
        events_.send("", "print", describe());
        std::unique_lock lock(mutex_);
        has_printed = ended_.wait_for(lock, event_interval, [this] { return printed_.end != End::none; });
    }
    // What became known between the last look and the end is told, too: before the print is seen to have
    // ended.
    remarks.look(link_->status());
    {
        const std::lock_guard lock(mutex_);
        messages_.add(printed_.message);
        end_ = printed_.end;
        message_ = printed_.message;
    }
    ended_.notify_all();
    events_.send("", "print", describe());
}

const char* ServedPrint::state_name(const LinkStatus& status, End end) const {
    constexpr std::array ends{"", "done", "stopped", "failed"};
    if (end != End::none) return ends[static_cast<std::size_t>(end)];
    if (stopping_ || status.stopping) return "stopping";
    if (!status.connected) return "connecting";
    return status.paused ? "paused" : "printing";
}

nlohmann::ordered_json ServedPrint::describe() const {
    const LinkStatus status = link_->status();
    const std::lock_guard lock(mutex_);
    const bool runs = end_ == End::none;
    const PrintProgress& progress = status.progress;
    const auto share = progress.share();
    const bool resumable = runs ? status.resumable : end_ != End::done && is_present(request_.link.journal);
    return {{"state", state_name(status, end_)},
            {"print", number_},
            {"job", job_->id},
            {"name", job_->job().name},
            {"machine", job_->recipe.printer.name},
            {"to", {{"serial", request_.link.port}, {"baud", request_.link.baud}}},
            {"firmware", status.firmware},
            {"halts_at_once", status.emergency_parser},
            {"doing", runs ? hindrance_text(status) : ""},
            {"question", runs ? question_json(status) : Json()},
            {"layers", job_->job().layers.count()},
            {"layer", status.layer >= 0 ? Json(status.layer) : Json()},
            {"layers_computed", progress.layers_before + progress.layers_known},
            {"share", share ? Json(rounded(*share, 4)) : Json()},
            {"seconds", whole_seconds(status.seconds)},
            {"seconds_left", runs ? whole_seconds(progress.left()) : Json()},
            {"z", rounded(status.z, 3)},
            {"lines", status.lines_answered},
            {"lines_a_second", runs ? rounded(rates_.lines_a_second, 1) : 0},
            {"bytes_a_second", runs ? std::round(rates_.bytes_a_second) : 0},
            {"temperatures", temperatures_json(status)},
            {"resumable", resumable},
            {"journal", std::filesystem::path(request_.link.journal).filename().string()},
            {"message", message_}};
}

}  // namespace lamella
