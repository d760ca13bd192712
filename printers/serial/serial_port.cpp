// Opens and configures a tty.
#include "printers/serial/serial_port.h"

#include <asm/termbits.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>
#include <utility>

#include "engine/base/error.h"

namespace lamella {
namespace fs = std::filesystem;
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

/// Sets eight data bits, no parity, one stop bit, no processing, and any baud rate.
void make_raw(int descriptor, const std::string& path, int baud) {
    termios2 mode{};
    if (ioctl(descriptor, TCGETS2, &mode) != 0) throw InputError(path + " is no serial port");
    mode.c_iflag = IGNBRK | IGNPAR;
    mode.c_oflag = 0;
    mode.c_lflag = 0;
    mode.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (BOTHER << IBSHIFT);
    mode.c_ispeed = mode.c_ospeed = static_cast<speed_t>(baud);
    std::fill(std::begin(mode.c_cc), std::end(mode.c_cc), cc_t{0});
    // With this, a read of zero bytes means a disconnected line, and nothing else.
    mode.c_cc[VMIN] = 1;
    if (ioctl(descriptor, TCSETS2, &mode) != 0) {
        throw InputError(path + " cannot be set to " + std::to_string(baud) + " baud: " + reason(errno));
    }
}

/// Asks for low latency: adapters otherwise delay small packets by up to 16 ms. Not all support the request.
void ask_for_low_latency(int descriptor) {
    serial_struct settings{};
    if (ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
    settings.flags |= ASYNC_LOW_LATENCY;
    ioctl(descriptor, TIOCSSERIAL, &settings);
}

std::string first_line(const fs::path& path) {
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    return line;
}

/// Returns the description of a USB device. The folder of its tty lies some levels below that of the device.
std::string usb_description(const std::string& name) {
    std::error_code error;
    fs::path folder = fs::canonical("/sys/class/tty/" + name + "/device", error);
    for (int level = 0; !error && level < 4; ++level, folder = folder.parent_path()) {
        const std::string product = first_line(folder / "product");
        std::string text = first_line(folder / "manufacturer");
        if (!product.empty()) (text += text.empty() ? "" : " ") += product;
        if (!text.empty()) return text;
    }
    return {};
}

}  // namespace

MachinePort::MachinePort(MachinePort&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), claim_(std::exchange(other.claim_, -1)) {}

MachinePort& MachinePort::operator=(MachinePort&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(claim_, other.claim_);
    return *this;
}

MachinePort::~MachinePort() { close(); }

void MachinePort::close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    if (claim_ >= 0) ::close(std::exchange(claim_, -1));
}

MachinePort MachinePort::open_serial(const std::string& path, int baud) {
    MachinePort port(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!port.is_open()) {
        const int error = errno;
        if (error == ENOENT) throw InputError("there is no port " + path + "; `lamella ports` lists them");
        if (error == EACCES) {
            throw InputError(path + " may not be opened by this user; join the group that owns it (dialout)");
        }
        if (error == EBUSY) throw InputError(path + " is in use by another program");
        throw FaultError("cannot open " + path + ": " + reason(error));
    }
    if (isatty(port.descriptor_) == 0) throw InputError(path + " is no serial port");
    // TIOCEXCL does not exclude root. The lock does, among programs that use it.
    if (flock(port.descriptor_, LOCK_EX | LOCK_NB) != 0)
        throw InputError(path + " is in use by another program");
    ioctl(port.descriptor_, TIOCEXCL);
    make_raw(port.descriptor_, path, baud);
    ask_for_low_latency(port.descriptor_);
    ioctl(port.descriptor_, TCFLSH, TCIOFLUSH);
    return port;
}

PortOutcome MachinePort::read(std::string& bytes) {
    PortOutcome outcome;
    std::array<char, 4096> buffer{};
    for (;;) {
        const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
        if (got > 0) {
            bytes.append(buffer.data(), static_cast<std::size_t>(got));
            outcome.bytes += static_cast<std::size_t>(got);
            continue;
        }
        if (got < 0 && errno == EINTR) continue;
        outcome.lost = got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
        return outcome;
    }
}

PortOutcome MachinePort::write(std::string_view bytes) {
    for (;;) {
        // A socket whose other end is gone must not end the process by a signal.
        const ssize_t gone = claim_ >= 0 ? ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                         : ::write(descriptor_, bytes.data(), bytes.size());
        if (gone >= 0) return {static_cast<std::size_t>(gone), false};
        if (errno == EINTR) continue;
        return {0, errno != EAGAIN && errno != EWOULDBLOCK};
    }
}

bool MachinePort::reset_board() {
    const int dtr = TIOCM_DTR;
    if (ioctl(descriptor_, TIOCMBIC, &dtr) != 0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return ioctl(descriptor_, TIOCMBIS, &dtr) == 0;
}

bool is_serial_line(const std::string& path) {
    std::error_code error;
    const fs::path device = fs::canonical(path, error);
    struct stat about {};
    if (error || !device.string().starts_with("/dev/") || stat(device.c_str(), &about) != 0 ||
        !S_ISCHR(about.st_mode))
        return false;
    constexpr unsigned first_pty = 136, last_pty = 143, consoles = 4, own_terminal = 5, serial_consoles = 64;
    const unsigned kind = major(about.st_rdev), number = minor(about.st_rdev);
    if (kind >= first_pty && kind <= last_pty) return true;
    if (kind == own_terminal || (kind == consoles && number < serial_consoles)) return false;
    const std::string entry = "/sys/dev/char/" + std::to_string(kind) + ":" + std::to_string(number);
    return fs::canonical(entry + "/subsystem", error).filename() == "tty";
}

std::string lasting_name(const std::string& path) {
    std::error_code error;
    const fs::path device = fs::canonical(path, error);
    if (error || path.starts_with("/dev/serial/")) return path;
    for (const auto& entry : fs::directory_iterator("/dev/serial/by-id", error)) {
        if (fs::canonical(entry.path(), error) == device) return entry.path().string();
    }
    return path;
}

std::vector<PortInfo> serial_ports() {
    std::vector<PortInfo> ports;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/sys/class/tty", error)) {
        const std::string name = entry.path().filename().string();
        const bool serial = name.starts_with("ttyUSB") || name.starts_with("ttyACM") ||
                            name.starts_with("ttyAMA") || name.starts_with("ttyS");
        // Most of ttyS0 to ttyS31 have no hardware: their type is 0.
        if (!serial || (name.starts_with("ttyS") && first_line(entry.path() / "type") == "0")) continue;
        const std::string path = "/dev/" + name;
        if (!fs::exists(path, error)) continue;
        const std::string lasting = lasting_name(path);
        ports.push_back({path, lasting == path ? "" : lasting, usb_description(name)});
    }
    std::sort(ports.begin(), ports.end(),
              [](const PortInfo& a, const PortInfo& b) { return a.path < b.path; });
    return ports;
}

}  // namespace lamella
