// G-code goes from the back-end to the upload by a GcodeOutput that keeps nothing.
#include "app/jobs/job_upload.h"

#include <fmt/format.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX

#include <cerrno>
#include <functional>
#include <string_view>
#include <system_error>

#include "app/reports/empty_job.h"
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

}  // namespace

bool can_stream(const PrinterProfile& printer) { return makes_beads(printer); }

std::string upload_hash(const Job& job, const LayerRange& range) {
    Fnv128 hash;
    hash.add(fmt::format("{} {} {}", job.identity, range.first, range.last));
    return hash.hex();
}

std::unique_ptr<UploadSource> stream_upload(const Recipe& recipe, const Job& job,
                                            const StreamOptions& stream) {
    return make_computed_source([&recipe, &job, stream](const std::function<void(std::string_view)>& write,
                                                        const CancelToken& cancel) {
        const auto backend = make_gcode(recipe.printer, std::make_unique<PassedGcode>(write));
        StreamOptions options = stream;
        options.resume = false;
        options.cancel = &cancel;
        const std::string empty = empty_job_text(recipe, job, stream_layers(job, *backend, options));
        if (!empty.empty()) throw InputError(empty);
    });
}

SpooledUpload::SpooledUpload(const std::string& file_name) {
    std::error_code error;
    std::string pattern = (std::filesystem::temp_directory_path(error) / "lamella-XXXXXX").string();
    if (error || ::mkdtemp(pattern.data()) == nullptr) {
        throw FaultError(fmt::format("{}: no folder for temporary files can be made there: {}", pattern,
                                     error ? error.message() : std::generic_category().message(errno)));
    }
    folder_ = pattern;
    path_ = folder_ / file_name;
}

SpooledUpload::~SpooledUpload() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

}  // namespace lamella
