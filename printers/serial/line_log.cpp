// The thread that writes the log.
#include "printers/serial/line_log.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/number_format.h"

namespace lamella {
namespace {

constexpr auto write_interval = std::chrono::milliseconds(250);
constexpr std::size_t most_waiting = 16u << 20;  // bytes that may wait for a disk that does not take them

}  // namespace

LineLog::LineLog(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "w")) {
    if (file_ == nullptr) {
        throw InputError("--log: cannot write " + path + ": " + std::generic_category().message(errno) +
                         "; accepted: a file in a folder that exists and may be written");
    }
    thread_ = std::thread([this] { work(); });
}

LineLog::~LineLog() {
    close();
    std::fclose(file_);
}

void LineLog::add(double time, char direction, std::size_t in_flight, std::string_view line) {
    const std::lock_guard lock(mutex_);
    if (ending_ || !trouble_.empty()) return;
    if (waiting_.size() > most_waiting) {
        trouble_ = path_ + ": the disk is too slow for it";
        return;
    }
    waiting_ += format_number(time, 6);
    ((waiting_ += ' ') += direction) += ' ';
    ((waiting_ += std::to_string(in_flight)) += ' ') += line;
    waiting_ += '\n';
}

void LineLog::close() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

std::string LineLog::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

void LineLog::work() {
    std::unique_lock lock(mutex_);
    for (bool last = false; !last;) {
        changed_.wait_for(lock, write_interval, [&] { return ending_; });
        last = ending_;
        const std::string text = std::exchange(waiting_, {});
        if (text.empty()) continue;
        lock.unlock();
        errno = 0;
        const bool written =
            std::fwrite(text.data(), 1, text.size(), file_) == text.size() && std::fflush(file_) == 0;
        const int error = errno;
        lock.lock();
        if (!written && trouble_.empty()) trouble_ = path_ + ": " + std::generic_category().message(error);
    }
}

}  // namespace lamella
