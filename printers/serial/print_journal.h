// What is known of a print on disk, so that it can go on after the host was killed.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

namespace lamella {

/// Writes a small file whole or not at all, on a thread of its own: a slow disk holds up no line.
class PrintJournal {
  public:
    explicit PrintJournal(std::filesystem::path path);
    ~PrintJournal();
    PrintJournal(const PrintJournal&) = delete;
    PrintJournal& operator=(const PrintJournal&) = delete;

    /// Has the file written anew soon; of several in a row the last one counts.
    void write(std::string text);
    /// Waits until all is written, then forgets the file.
    void remove();
    /// Why the last writing failed; empty when it did not.
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
