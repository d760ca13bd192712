// UploadSource: where the bytes of an upload come from: a file, or a job that is computed as it is sent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "engine/base/cancel_token.h"
#include "hosts/transfer/upload_digest.h"

namespace lamella {

/// Bytes on their way to a host, taken by one thread.
class UploadBytes {
  public:
    UploadBytes() = default;
    virtual ~UploadBytes() = default;
    UploadBytes(const UploadBytes&) = delete;
    UploadBytes& operator=(const UploadBytes&) = delete;

    /// Takes up to out.size() bytes without waiting and returns their number, 0 when none are there yet;
    /// nothing at the end. Throws what kept the bytes from being made.
    virtual std::optional<std::size_t> take(std::span<char> out) = 0;
    /// Sets what is called, from any thread, once bytes or the end have come after take returned 0.
    // Overriders keep it. NOLINTNEXTLINE(performance-unnecessary-value-param)
    virtual void on_ready(std::function<void()> /*wake*/) {}
};

/// Opens the same bytes as often as asked.
class UploadSource {
  public:
    UploadSource() = default;
    virtual ~UploadSource() = default;
    UploadSource(const UploadSource&) = delete;
    UploadSource& operator=(const UploadSource&) = delete;

    virtual std::unique_ptr<UploadBytes> open() = 0;
    /// What is known before the first byte is sent; nothing before `count`.
    const std::optional<UploadFacts>& facts() const { return facts_; }
    /// Passes all bytes once, to count and hash them. Throws Interrupted.
    void count(const CancelToken* cancel);

  private:
    std::optional<UploadFacts> facts_;
};

/// A file as an upload. Throws FaultError when it cannot be read.
std::unique_ptr<UploadSource> make_file_source(const std::filesystem::path& path);

/// Writes the bytes of a job, front to end, to `write`, and returns. Called once for each time that the
/// bytes are opened, by a thread of its own; stops when `cancel` is set or `write` throws.
using ComputeUpload =
    std::function<void(const std::function<void(std::string_view)>& write, const CancelToken& cancel)>;

/// A job that is computed anew each time it is opened, while it is sent.
std::unique_ptr<UploadSource> make_computed_source(ComputeUpload compute);

}  // namespace lamella
