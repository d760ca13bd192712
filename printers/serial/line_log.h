// LineLog: the log of a print: every line that was sent or received, with its time.
#pragma once

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace lamella {

/// Writes a log on a thread of its own, so that a slow disk delays no line. Entries are on the disk within a
/// second, also while the print waits.
class LineLog {
  public:
    /// Throws InputError if the file cannot be opened.
    explicit LineLog(const std::string& path);
    ~LineLog();
    LineLog(const LineLog&) = delete;
    LineLog& operator=(const LineLog&) = delete;

    /// Appends an entry: time (s), '>' for sent, '<' for received or '#' for a remark, unanswered bytes,
    /// line.
    void add(double time, char direction, std::size_t in_flight, std::string_view line);
    /// Writes what is left. Entries added later are discarded.
    void close();
    /// Returns why the log is not complete; empty if it is.
    std::string trouble() const;

  private:
    void work();

    std::string path_;
    std::FILE* file_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::string waiting_;
    std::string trouble_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace lamella
