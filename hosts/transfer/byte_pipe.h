// BytePipe: a bounded queue of bytes from the thread that computes them to the one that sends them.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/error.h"

namespace lamella {

/// Thrown by BytePipe::write when nobody reads any more.
class PipeClosed : public Error {
  public:
    PipeClosed() : Error("the upload has ended") {}
};

/// A bounded queue of bytes between two threads.
class BytePipe {
  public:
    explicit BytePipe(std::size_t most = std::size_t{1} << 20) : most_(most) {}

    /// Appends bytes; waits while the pipe is full. Throws PipeClosed once the reader has closed it.
    void write(std::string_view bytes);
    /// Tells that no more bytes come. With a failure, the reader gets it instead of the end.
    void end(std::exception_ptr failure = nullptr);

    /// Takes up to out.size() bytes without waiting and returns their number, 0 when none are there yet;
    /// nothing at the end. Throws the writer's failure.
    std::optional<std::size_t> take(std::span<char> out);
    /// Sets what is called, by the writer's thread, when bytes or the end have come after take returned 0.
    void on_ready(std::function<void()> wake);
    /// Ends the reading: the writer is stopped.
    void close();

  private:
    std::size_t most_;
    std::mutex mutex_;
    std::condition_variable room_;
    std::string bytes_;
    std::size_t taken_ = 0;  // of the front of bytes_
    bool ended_ = false, closed_ = false;
    bool waits_ = false;  // the reader has found nothing
    std::exception_ptr failure_;
    std::function<void()> wake_;
};

}  // namespace lamella
