// A simulated printer behind a pseudo-terminal, on a thread and a clock of its own.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <mutex>
#include <thread>

#include "tests/printers/serial/simulated_firmware.h"
#include "tests/printers/serial/simulated_grbl.h"

namespace lamella::test {

template <class Printer>
class MachineOnPty {
  public:
    /// `pace` seconds of the machine pass in each second.
    explicit MachineOnPty(typename Printer::Options options, double pace = 1)
        : printer_(options), pace_(pace) {
        plug();
    }
    ~MachineOnPty() { unplug(); }
    MachineOnPty(const MachineOnPty&) = delete;
    MachineOnPty& operator=(const MachineOnPty&) = delete;

    /// Pulls the plug: the port is gone, the printer stays on.
    void unplug() {
        ending_ = true;
        if (thread_.joinable()) thread_.join();
        if (slave_ >= 0) close(slave_);
        if (master_ >= 0) close(master_);
        slave_ = master_ = -1;
    }
    /// Puts it in again, at another path.
    void plug() {
        ending_ = false;
        master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
        REQUIRE(master_ >= 0);
        REQUIRE(grantpt(master_) == 0);
        REQUIRE(unlockpt(master_) == 0);
        char name[128];
        REQUIRE(ptsname_r(master_, name, sizeof name) == 0);
        path_ = name;
        // Held open, so that the line does not end between two programs that use it.
        slave_ = ::open(name, O_RDWR | O_NOCTTY);
        REQUIRE(slave_ >= 0);
        termios mode{};
        tcgetattr(slave_, &mode);
        cfmakeraw(&mode);
        tcsetattr(slave_, TCSANOW, &mode);
        thread_ = std::thread([this] { work(); });
    }

    /// It hears and says nothing until it is told to go on.
    void stand_still(bool still) { still_ = still; }

    const std::string& path() const { return path_; }
    std::vector<std::string> executed() {
        const std::lock_guard lock(mutex_);
        return printer_.executed();
    }
    /// Calls use(printer, its time).
    template <class Use>
    auto with(Use use) {
        const std::lock_guard lock(mutex_);
        return use(printer_, time());
    }
    /// The printer's time, s.
    double time() const {
        return pace_ * std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    void work() {
        while (!ending_) {
            pollfd watched{master_, POLLIN, 0};
            poll(&watched, still_ ? 0 : 1, 1);
            if (still_) continue;
            char buffer[4096];
            const ssize_t got = ::read(master_, buffer, sizeof buffer);
            std::string said;
            {
                const std::lock_guard lock(mutex_);
                if (got > 0) printer_.receive({buffer, static_cast<std::size_t>(got)}, time());
                said = printer_.run(time());
            }
            for (std::size_t at = 0; at < said.size() && !ending_;) {
                const ssize_t gone = ::write(master_, said.data() + at, said.size() - at);
                if (gone > 0) at += static_cast<std::size_t>(gone);
                if (gone <= 0) break;  // nobody reads: what a real wire carries is lost as well
            }
        }
    }

    Printer printer_;
    double pace_;
    int master_ = -1;
    int slave_ = -1;
    std::string path_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::atomic<bool> still_{false};
    std::atomic<bool> ending_{false};
    std::thread thread_;
};

using PtyMachine = MachineOnPty<SimulatedMarlin>;
using PtyGrbl = MachineOnPty<SimulatedGrbl>;

}  // namespace lamella::test
