// The search by UDP: every machine answers the text M99999 on port 3000 with JSON.
#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "hosts/host_json.h"
#include "hosts/sdcp.h"

namespace lamella {

namespace {

constexpr const char* search_port = "3000";
constexpr std::string_view question = "M99999";

class UdpSocket {
  public:
    UdpSocket() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        const int yes = 1;
        ::setsockopt(socket_, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
    }
    ~UdpSocket() {
        if (socket_ >= 0) ::close(socket_);
    }
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;

    void ask(const std::string& address) const {
        addrinfo hints{};
        hints.ai_family = AF_INET;
        hints.ai_socktype = SOCK_DGRAM;
        addrinfo* found = nullptr;
        if (::getaddrinfo(address.c_str(), search_port, &hints, &found) != 0) return;
        ::sendto(socket_, question.data(), question.size(), 0, found->ai_addr, found->ai_addrlen);
        ::freeaddrinfo(found);
    }

    /// Returns an answer; empty when none comes within these milliseconds.
    std::string answer(int milliseconds) const {
        pollfd waiting{socket_, POLLIN, 0};
        if (::poll(&waiting, 1, milliseconds) <= 0) return "";
        std::string text(std::size_t{64} << 10, '\0');
        const ssize_t size = ::recv(socket_, text.data(), text.size(), 0);
        text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return text;
    }

  private:
    int socket_;
};

}  // namespace

std::vector<SdcpMachine> find_sdcp(const std::string& address, double seconds, const CancelToken* cancel) {
    using Clock = std::chrono::steady_clock;
    constexpr std::size_t most = 1000;
    std::vector<SdcpMachine> machines;
    const UdpSocket socket;
    const bool one = !address.empty();
    socket.ask(one ? address : "255.255.255.255");
    const auto until = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < until && machines.size() < most) {
        stop_if_cancelled(cancel);
        const auto json = nlohmann::json::parse(socket.answer(50), nullptr, false);
        if (!json.is_object()) continue;
        SdcpMachine machine{text_at(json, "/Data/Name"), text_at(json, "/Data/MachineName"),
                            text_at(json, "/Data/MainboardIP"), text_at(json, "/Data/MainboardID")};
        const auto same = [&](const SdcpMachine& other) { return other.board == machine.board; };
        if (machine.board.empty() || std::ranges::any_of(machines, same)) continue;
        machines.push_back(std::move(machine));
        if (one) break;
    }
    return machines;
}

}  // namespace lamella
