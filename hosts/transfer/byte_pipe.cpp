// A string as the queue: what is taken is dropped once half of it is.
#include "hosts/transfer/byte_pipe.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lamella {

void BytePipe::write(std::string_view bytes) {
    while (!bytes.empty()) {
        std::unique_lock lock(mutex_);
        room_.wait(lock, [&] { return closed_ || bytes_.size() - taken_ < most_; });
        if (closed_) throw PipeClosed();
        const std::size_t count = std::min(bytes.size(), most_ - (bytes_.size() - taken_));
        bytes_.append(bytes.substr(0, count));
        bytes.remove_prefix(count);
        if (std::exchange(waits_, false) && wake_) wake_();
    }
}

void BytePipe::end(std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    failure_ = std::move(failure);
    if (wake_) wake_();
}

std::optional<std::size_t> BytePipe::take(std::span<char> out) {
    const std::scoped_lock lock(mutex_);
    const std::size_t count = std::min(out.size(), bytes_.size() - taken_);
    if (count == 0) {
        if (failure_) std::rethrow_exception(failure_);
        if (ended_) return std::nullopt;
        waits_ = true;
        return 0;
    }
    std::memcpy(out.data(), bytes_.data() + taken_, count);
    taken_ += count;
    if (taken_ * 2 >= bytes_.size()) {
        bytes_.erase(0, taken_);
        taken_ = 0;
    }
    room_.notify_one();
    return count;
}

void BytePipe::on_ready(std::function<void()> wake) {
    const std::scoped_lock lock(mutex_);
    wake_ = std::move(wake);
}

void BytePipe::close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    wake_ = {};
    room_.notify_all();
}

}  // namespace lamella
