// G-code goes from the back-end to the upload by a GcodeOutput that keeps nothing.
#include "app/jobs/send_job.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "app/jobs/temporary_folder.h"
#include "app/reports/empty_job.h"
#include "hosts/transfer/upload_source.h"
#include "printers/gcode/gcode.h"
#include "printers/registry.h"
#include "recipe/identity.h"

namespace lamella {

namespace {

/// Passes a job's text on.
class PassedGcode : public GcodeOutput {
  public:
    explicit PassedGcode(std::function<void(std::string_view)> write) : write_(std::move(write)) {}

    int begin(const JobStamp& stamp, bool /*resume*/) override { return stamp.range.first; }
    nlohmann::ordered_json state() const override { return nullptr; }
    InputError damaged_state() const override { return InputError("an upload has no state"); }
    void commit(std::string_view text, int /*next*/, const nlohmann::ordered_json& /*state*/) override {
        write_(text);
    }
    void end(std::string_view text) override { write_(text); }

  private:
    std::function<void(std::string_view)> write_;
};

/// Returns the first ending of the files that a printer's back-end makes.
std::string ending_of(const PrinterProfile& printer) {
    const BackendInfo& backend = find_backend(printer.backend);
    const std::string endings = backend.endings;
    if (backend.output == OutputKind::folder || endings.empty()) {
        throw InputError(
            fmt::format("the printer \"{}\" makes a folder, which no host takes; accepted: a printer of "
                        "files, such as --printer marlin",
                        printer.name));
    }
    return endings.substr(0, endings.find(' '));
}

/// Returns hexadecimal digits that other bytes of a job's output do not have.
std::string upload_hash(const Job& job, const LayerRange& range) {
    Fnv128 hash;
    hash.add(fmt::format("{} {} {}", job.identity, range.first, range.last));
    return hash.hex();
}

void require_layers(const Recipe& recipe, const Job& job, const StreamReport& report) {
    const std::string empty = empty_job_text(recipe, job, report);
    if (!empty.empty()) throw InputError(empty);
}

/// Makes the bytes of a job's G-code anew each time that they are opened.
std::unique_ptr<UploadSource> stream_upload(const Recipe& recipe, const Job& job,
                                            const StreamOptions& stream) {
    return make_computed_source([&recipe, &job, stream](const std::function<void(std::string_view)>& write,
                                                        const CancelToken& cancel) {
        const auto backend = make_gcode(recipe.printer, std::make_unique<PassedGcode>(write));
        StreamOptions options = stream;
        options.cancel = &cancel;
        require_layers(recipe, job, stream_layers(job, *backend, options));
    });
}

}  // namespace

JobSendReport send_job(NetworkHost& host, const Recipe& recipe, const Job& job, JobSending sending) {
    SendSettings& upload = sending.upload;
    const std::string ending = ending_of(recipe.printer);
    const bool streams = makes_beads(recipe.printer);
    if (sending.no_spool && !streams)
        throw InputError(
            "--no-spool: only G-code can be computed while it is sent; accepted: no --no-spool, which writes "
            "a "
            "file first");
    if (upload.name.empty())
        upload.name = upload_name(recipe.part.name, upload_hash(job, sending.stream.range), ending);
    sending.stream.resume = false;
    sending.stream.cancel = upload.cancel;
    if (streams && (host.needs() == UploadNeeds::nothing || sending.no_spool)) {
        const auto source = stream_upload(recipe, job, sending.stream);
        if (host.needs() != UploadNeeds::nothing) source->count(upload.cancel);
        return {upload.name, send_upload(host, *source, upload)};
    }
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / upload.name;
    const auto backend = make_backend(recipe.printer, file.string(), false);
    require_layers(recipe, job, stream_layers(job, *backend, sending.stream));
    if (upload.on_note) {
        for (const std::string& note : backend->notes()) upload.on_note("note: " + note);
    }
    const auto source = make_file_source(file);
    source->count(upload.cancel);
    return {upload.name, send_upload(host, *source, upload)};
}

}  // namespace lamella
