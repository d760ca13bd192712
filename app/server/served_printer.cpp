// Checks what a print needs before it starts.
#include "app/server/served_printer.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "app/http/http_server.h"
#include "engine/base/json_depth.h"
#include "printers/archive/output_file.h"
#include "printers/registry.h"

namespace lamella {

namespace {

using Json = nlohmann::ordered_json;

/// Returns why the machine of a job cannot be printed to from here; empty if it can.
std::string obstacle_of(const PrinterProfile& printer) {
    if (makes_beads(printer)) return {};
    return fmt::format(
        "{} does not use G-code (its kind is {}); accepted: a machine that does, such as marlin",
        printer.name, printer.backend);
}

/// Returns what is known of a stopped print: its file, the first layer that it has not printed, and whether
/// it is of this job.
Json left_print(const std::filesystem::path& journal, const Job& job) {
    if (!is_present(journal)) return nullptr;
    std::ifstream in(journal);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    const Json record = Json::parse(shallow_json(text), nullptr, false);
    const Json none;
    const auto member = [&](const char* part, const char* name) {
        const bool has = record.is_object() && record.contains(part) && record[part].is_object();
        return has ? record[part].value(name, none) : none;
    };
    const Json next = member("resume", "next");
    return {{"journal", journal.filename().string()},
            {"next_layer", next.is_number_integer() ? next : none},
            {"is_of_job", member("stamp", "identity") == Json(job.identity)}};
}

}  // namespace

std::filesystem::path ServedPrinter::journal_of(const ServedJob& job) const {
    return folder_.file(job.recipe.part.name + ".print.journal");
}

nlohmann::ordered_json ServedPrinter::outlook(const ServedJob& job) const {
    const std::string obstacle = obstacle_of(job.recipe.printer);
    return {{"accepted", obstacle.empty()},
            {"message", obstacle},
            {"left", obstacle.empty() ? left_print(journal_of(job), job.job()) : Json()}};
}

nlohmann::ordered_json ServedPrinter::start(std::shared_ptr<const ServedJob> job, const Json& request) {
    const std::lock_guard lock(mutex_);
    if (const std::string obstacle = obstacle_of(job->recipe.printer); !obstacle.empty())
        throw HttpError(400, obstacle);
    if (ended_) throw HttpError(503, "the server is ending");
    if (runs()) throw HttpError(409, "a print runs already; accepted: another one when it has ended");
    PrintRequest print = read_print_request(request, job->recipe.printer);
    const std::filesystem::path journal = journal_of(*job);
    const std::string name = journal.filename().string();
    if (print.resume && !is_present(journal))
        throw HttpError(
            400, fmt::format("resume: there is no journal {}; accepted: a print from the start", name));
    if (is_present(journal) && !print.resume && !print.discard_journal) {
        throw HttpError(409, fmt::format("{} is left from a print that was stopped; accepted: \"resume\": "
                                         "true, which goes on with it, or \"discard_journal\": true",
                                         name));
    }
    print.link.journal = journal.string();
    print_ = nullptr;  // the threads of the last one end first
    print_ = std::make_shared<ServedPrint>(next_++, std::move(job), std::move(print), threads_, events_);
    return print_->describe();
}

nlohmann::ordered_json ServedPrinter::describe() const {
    const std::lock_guard lock(mutex_);
    return print_ ? print_->describe() : Json{{"state", "none"}};
}

nlohmann::ordered_json ServedPrinter::messages() const {
    const std::lock_guard lock(mutex_);
    return print_ ? print_->messages() : Json::array();
}

nlohmann::ordered_json ServedPrinter::tell(const std::function<void(ServedPrint&)>& order) {
    const std::lock_guard lock(mutex_);
    if (!runs()) throw HttpError(409, "no print runs");
    order(*print_);
    return print_->describe();
}

bool ServedPrinter::is_printing() const {
    const std::lock_guard lock(mutex_);
    return runs();
}

void ServedPrinter::end() {
    std::shared_ptr<ServedPrint> print;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        print = print_;
    }
    if (!print) return;
    print->stop();
    print->wait();
}

}  // namespace lamella
