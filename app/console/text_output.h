// TextOutput: the destination of a command's result: a file that appears when complete, or standard output.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "engine/base/error.h"

namespace lamella {

/// Thrown when the reader of our output has closed the pipe: not an error, but there is nothing left to do.
class ReaderGone : public Error {
  public:
    ReaderGone() : Error("the reader of the output is gone") {}
    int exit_code() const override { return 0; }
};

/// A buffered sink. Files are written as PATH.part and renamed by close(), so a file with its final name is
/// complete. Without close() the unfinished file is removed.
class TextOutput {
  public:
    /// Opens the file, or standard output when the path is empty or "-". Throws FaultError when that fails.
    explicit TextOutput(const std::string& path);
    ~TextOutput();
    TextOutput(const TextOutput&) = delete;
    TextOutput& operator=(const TextOutput&) = delete;

    /// Throws ReaderGone on a closed pipe, FaultError when the disk is full.
    void write(std::string_view bytes);
    /// Flushes the buffer.
    void flush();
    void close();
    bool to_terminal() const;

  private:
    [[noreturn]] void fail(const std::string& what) const;

    std::string path_;       ///< final name; empty for standard output
    std::string temporary_;  ///< name while unfinished; empty when written in place
    std::FILE* file_;
};

}  // namespace lamella
