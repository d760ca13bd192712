// The thread that writes the journal.
#include "printers/serial/print_journal.h"

#include "engine/base/error.h"
#include "printers/archive/output_file.h"

namespace lamella {

PrintJournal::PrintJournal(std::filesystem::path path)
    : path_(std::move(path)), thread_([this] { work(); }) {}

PrintJournal::~PrintJournal() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void PrintJournal::write(std::string text) {
    {
        const std::lock_guard lock(mutex_);
        next_ = std::move(text);
    }
    changed_.notify_all();
}

void PrintJournal::remove() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
    std::error_code ignored;  // if the file stays behind, the next print asks about it
    std::filesystem::remove(path_, ignored);
}

std::string PrintJournal::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

void PrintJournal::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [&] { return ending_ || next_; });
        if (!next_) return;
        const std::string text = *std::exchange(next_, std::nullopt);
        lock.unlock();
        std::string trouble;
        try {
            write_whole_file(path_, text);
        } catch (const Error& error) {
            trouble = error.what();
        }
        lock.lock();
        trouble_ = trouble;
    }
}

}  // namespace lamella
