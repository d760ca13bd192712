// Finds API sockets and connects to them.
#include "printers/serial/klipper_socket.h"

#include <grp.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>

#include "engine/base/error.h"
#include "printers/serial/serial_port.h"

namespace lamella {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_name = 4096;  // bytes of a record of a user or a group

sockaddr_un address_of(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) {
        throw InputError(path + " is too long for the path of a socket; accepted: at most " +
                         std::to_string(sizeof address.sun_path - 1) + " characters");
    }
    std::memcpy(address.sun_path, path.data(), path.size());
    return address;
}

std::string user_name(uid_t id) {
    std::array<char, most_name> buffer{};
    passwd record{};
    passwd* found = nullptr;
    getpwuid_r(id, &record, buffer.data(), buffer.size(), &found);
    return found != nullptr ? found->pw_name : std::to_string(id);
}

std::string group_name(gid_t id) {
    std::array<char, most_name> buffer{};
    group record{};
    group* found = nullptr;
    getgrgid_r(id, &record, buffer.data(), buffer.size(), &found);
    return found != nullptr ? found->gr_name : std::to_string(id);
}

/// Returns why a socket may not be opened, and who may.
std::string denial(const std::string& path) {
    std::string text = path + " may not be opened by this user";
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) {
        return text +
               ", who may not enter the folder that it lies in; accepted: run lamella as the user of "
               "Klipper";
    }
    const std::string user = user_name(about.st_uid), group = group_name(about.st_gid);
    text += "; it belongs to user " + user + " and group " + group;
    if ((about.st_mode & S_IWGRP) != 0) return text + ": join that group, or run lamella as " + user;
    return text + ", and only its user may write to it: run lamella as " + user +
           ", or let the group write to it (chmod g+rw " + path + ", each time klippy has started)";
}

/// Returns 0 or why the connection failed. klippy lets few programs wait at its socket at a time.
int connect_to(int descriptor, const sockaddr_un& address) {
    constexpr int most_tries = 20;
    constexpr std::chrono::milliseconds interval{50};
    for (int tries = 1;; ++tries) {
        if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return 0;
        if (errno != EAGAIN || tries == most_tries) return errno;
        std::this_thread::sleep_for(interval);
    }
}

/// Claims a socket against other prints by a name that ends with this process: a socket cannot be locked as
/// a file can.
int claim(const std::string& path) {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) return -1;
    const std::string name =
        "lamella-print-" + std::to_string(about.st_dev) + "-" + std::to_string(about.st_ino);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    const int claim = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    if (claim >= 0 && bind(claim, reinterpret_cast<const sockaddr*>(&address), length) == 0) return claim;
    const int error = errno;
    if (claim >= 0) ::close(claim);
    if (error == EADDRINUSE) throw InputError(path + " is in use by another print");
    throw FaultError("cannot claim " + path + ": " + std::generic_category().message(error));
}

void add_if_socket(std::vector<std::string>& list, const fs::path& path) {
    if (is_socket(path.string())) list.push_back(path.string());
}

/// Adds the sockets of the printers of a user: printer_data, printer_1_data and so on.
void add_sockets_of(std::vector<std::string>& list, const fs::path& home) {
    std::error_code error;
    for (fs::directory_iterator entry(home, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with("printer") && name.ends_with("_data"))
            add_if_socket(list, entry->path() / "comms" / "klippy.sock");
    }
}

}  // namespace

bool is_socket(const std::string& path) {
    struct stat about {};
    return stat(path.c_str(), &about) == 0 && S_ISSOCK(about.st_mode);
}

std::vector<std::string> klipper_sockets() {
    std::vector<std::string> list;
    std::error_code error;
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') add_sockets_of(list, home);
    for (fs::directory_iterator entry("/home", error), end; !error && entry != end; entry.increment(error))
        add_sockets_of(list, entry->path());
    for (fs::directory_iterator entry("/run/klipper", error), end; !error && entry != end;
         entry.increment(error))
        add_if_socket(list, entry->path());
    add_if_socket(list, "/tmp/klippy_uds");
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list;
}

MachinePort MachinePort::open_socket(const std::string& path) {
    const sockaddr_un address = address_of(path);
    MachinePort port(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!port.is_open()) throw FaultError("cannot make a socket: " + std::generic_category().message(errno));
    if (const int error = connect_to(port.descriptor_, address); error != 0) {
        if (error == ENOENT) throw InputError("there is no port " + path + "; `lamella ports` lists them");
        if (error == EACCES || error == EPERM) throw InputError(denial(path));
        if (error == ECONNREFUSED) {
            throw InputError((is_socket(path)
                                  ? "nobody listens at " + path +
                                        "; accepted: the API socket of a running klippy (its option -a)"
                                  : path + " is no socket"));
        }
        throw FaultError("cannot open " + path + ": " + std::generic_category().message(error));
    }
    port.claim_ = claim(path);
    if (port.claim_ < 0) throw InputError(path + " has just gone; is klippy restarting?");
    return port;
}

}  // namespace lamella
