// PrintJournal: the progress of a print on disk, from which it is resumed if the host was killed.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

namespace lamella {

/// Writes a small file atomically, on a thread of its own, so that a slow disk delays no line.
class PrintJournal {
  public:
    explicit PrintJournal(std::filesystem::path path);
    ~PrintJournal();
    PrintJournal(const PrintJournal&) = delete;
    PrintJournal& operator=(const PrintJournal&) = delete;

    /// Schedules the file to be rewritten. Of several calls in quick succession the last one counts.
    void write(std::string text);
    /// Waits until all is written, then deletes the file.
    void remove();
    /// Returns why the last write failed; empty if it succeeded.
    std::string trouble() const;

  private:
    void work();

    std::filesystem::path path_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<std::string> next_;
    std::string trouble_;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace lamella
