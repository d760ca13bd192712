// A job's output as an upload: written to a file first, or computed while it is sent.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/layers/layer_stream.h"
#include "hosts/transfer/upload_source.h"
#include "printers/common/profile.h"
#include "recipe/recipe.h"

namespace lamella {

/// Returns whether a machine's output can be computed while it is sent: whether it is G-code.
bool can_stream(const PrinterProfile& printer);

/// Returns hexadecimal digits that other bytes of a job's output do not have.
std::string upload_hash(const Job& job, const LayerRange& range);

/// Makes the bytes of a job's G-code anew each time that they are opened. `stream` gives layers, threads and
/// what is called on progress, by the thread that computes; its cancel token is not used. The bytes end with
/// an InputError when nothing is printed. Recipe and job must outlive the source.
std::unique_ptr<UploadSource> stream_upload(const Recipe& recipe, const Job& job,
                                            const StreamOptions& stream);

/// A job's output in a folder of its own among the temporary files, which goes with this object.
class SpooledUpload {
  public:
    /// Makes the folder. Throws FaultError.
    explicit SpooledUpload(const std::string& file_name);
    ~SpooledUpload();
    SpooledUpload(const SpooledUpload&) = delete;
    SpooledUpload& operator=(const SpooledUpload&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path folder_, path_;
};

}  // namespace lamella
