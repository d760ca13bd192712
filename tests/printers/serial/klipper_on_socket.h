// A simulated klippy behind a Unix socket, on a thread and a clock of its own.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include "tests/printers/serial/simulated_klipper.h"

namespace lamella::test {

class KlipperOnSocket {
  public:
    /// `pace` seconds of klippy pass in each second. `seed` breaks up the bytes.
    explicit KlipperOnSocket(KlipperOptions options = {}, double pace = 1, unsigned seed = 1)
        : klippy_(std::move(options)), pace_(pace), random_(seed) {
        char folder[] = "/tmp/lamella_klippy_XXXXXX";
        REQUIRE(mkdtemp(folder) != nullptr);
        folder_ = folder;
        klippy_.boot(0);
        listen();
        thread_ = std::thread([this] { work(); });
    }
    ~KlipperOnSocket() {
        ending_ = true;
        thread_.join();
        hang_up();
        if (listener_ >= 0) close(listener_);
        std::filesystem::remove_all(folder_);
    }
    KlipperOnSocket(const KlipperOnSocket&) = delete;
    KlipperOnSocket& operator=(const KlipperOnSocket&) = delete;

    std::string path() const { return folder_ + "/klippy.sock"; }
    std::string folder() const { return folder_; }
    std::vector<std::string> executed() {
        const std::lock_guard lock(mutex_);
        return klippy_.executed();
    }
    /// Calls use(klippy, its time).
    template <class Use>
    auto with(Use use) {
        const std::lock_guard lock(mutex_);
        return use(klippy_, time());
    }
    /// It hears and says nothing until it is told to go on.
    void stand_still(bool still) { still_ = still; }
    /// Closes the connection when it has got that many bytes more; with `restart`, klippy starts again.
    void cut_after(std::size_t bytes, bool restart) {
        const std::lock_guard lock(mutex_);
        bytes_left_ = bytes;
        restarts_ = restart;
    }
    double time() const {
        return pace_ * std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    void listen() {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, path().c_str(), sizeof address.sun_path - 1);
        listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
        REQUIRE(listener_ >= 0);
        REQUIRE(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
        REQUIRE(::listen(listener_, 1) == 0);
    }
    void hang_up() {
        if (client_ >= 0) close(client_);
        client_ = -1;
        out_.clear();
    }
    void work() {
        while (!ending_) {
            pollfd watched[] = {{listener_, POLLIN, 0}, {client_, POLLIN, 0}};
            poll(watched, client_ >= 0 && !still_ ? 2 : 1, 1);
            if (still_) continue;
            const std::lock_guard lock(mutex_);
            if (client_ < 0) {
                client_ = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK);
            } else {
                hear();
            }
            out_ += klippy_.run(time());
            speak();
        }
    }
    void hear() {
        char buffer[4096];
        const std::size_t most = std::min(bytes_left_, 1 + random_() % sizeof buffer);
        const ssize_t got = most == 0 ? 0 : recv(client_, buffer, most, 0);
        if (got < 0) return;
        if (got > 0) {
            klippy_.receive({buffer, static_cast<std::size_t>(got)}, time());
            if (bytes_left_ != all) bytes_left_ -= static_cast<std::size_t>(got);
            if (bytes_left_ > 0) return;
        }
        hang_up();
        restarts_ ? klippy_.restart(time()) : klippy_.disconnect();
        bytes_left_ = all;
        restarts_ = false;
    }
    void speak() {
        while (client_ >= 0 && !out_.empty()) {
            const std::size_t size = std::min<std::size_t>(out_.size(), 1 + random_() % 3000);
            const ssize_t gone = send(client_, out_.data(), size, MSG_NOSIGNAL);
            if (gone <= 0) return;
            out_.erase(0, static_cast<std::size_t>(gone));
        }
    }

    static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
    SimulatedKlipper klippy_;
    double pace_;
    std::mt19937 random_;
    std::string folder_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    int listener_ = -1, client_ = -1;
    std::string out_;
    std::size_t bytes_left_ = all;
    bool restarts_ = false;
    std::mutex mutex_;
    std::atomic<bool> still_{false}, ending_{false};
    std::thread thread_;
};

}  // namespace lamella::test
