// Files are read in blocks; jobs are computed by a thread behind a pipe.
#include "hosts/transfer/upload_source.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "hosts/transfer/byte_pipe.h"

namespace lamella {

namespace {

class FileBytes : public UploadBytes {
  public:
    explicit FileBytes(std::filesystem::path path)
        : path_(std::move(path)), file_(std::fopen(path_.c_str(), "rb")) {
        if (!file_) throw trouble();
    }

    std::optional<std::size_t> take(std::span<char> out) override {
        const std::size_t count = std::fread(out.data(), 1, out.size(), file_.get());
        if (count > 0) return count;
        if (std::ferror(file_.get()) != 0) throw trouble();
        return std::nullopt;
    }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    FaultError trouble() const {
        return FaultError(
            fmt::format("{}: cannot be read: {}", path_.string(), std::generic_category().message(errno)));
    }

    std::filesystem::path path_;
    std::unique_ptr<std::FILE, Close> file_;
};

class FileSource : public UploadSource {
  public:
    explicit FileSource(std::filesystem::path path) : path_(std::move(path)) {}
    std::unique_ptr<UploadBytes> open() override { return std::make_unique<FileBytes>(path_); }

  private:
    std::filesystem::path path_;
};

class ComputedBytes : public UploadBytes {
  public:
    explicit ComputedBytes(const ComputeUpload& compute)
        : thread_([this, compute] {
              try {
                  compute([this](std::string_view bytes) { pipe_.write(bytes); }, cancel_);
                  pipe_.end();
              } catch (...) {
                  pipe_.end(std::current_exception());
              }
          }) {}
    ~ComputedBytes() override {
        cancel_.cancel();
        pipe_.close();
        thread_.join();
    }

    std::optional<std::size_t> take(std::span<char> out) override { return pipe_.take(out); }
    void on_ready(std::function<void()> wake) override { pipe_.on_ready(std::move(wake)); }

  private:
    BytePipe pipe_;
    CancelToken cancel_;
    std::thread thread_;
};

class ComputedSource : public UploadSource {
  public:
    explicit ComputedSource(ComputeUpload compute) : compute_(std::move(compute)) {}
    std::unique_ptr<UploadBytes> open() override { return std::make_unique<ComputedBytes>(compute_); }

  private:
    ComputeUpload compute_;
};

}  // namespace

void UploadSource::count(const CancelToken* cancel) {
    if (facts_) return;
    std::mutex mutex;
    std::condition_variable ready;
    bool woken = false;
    const std::unique_ptr<UploadBytes> bytes = open();
    bytes->on_ready([&] {
        const std::scoped_lock lock(mutex);
        woken = true;
        ready.notify_one();
    });
    UploadDigest digest;
    std::vector<char> block(std::size_t{64} << 10);
    while (const std::optional<std::size_t> count = bytes->take(block)) {
        stop_if_cancelled(cancel);
        digest.add(std::span(block).first(*count));
        if (*count > 0) continue;
        std::unique_lock lock(mutex);
        ready.wait_for(lock, std::chrono::milliseconds(50), [&] { return woken; });
        woken = false;
    }
    facts_ = digest.facts();
}

std::unique_ptr<UploadSource> make_file_source(const std::filesystem::path& path) {
    return std::make_unique<FileSource>(path);
}

std::unique_ptr<UploadSource> make_computed_source(ComputeUpload compute) {
    return std::make_unique<ComputedSource>(std::move(compute));
}

}  // namespace lamella
