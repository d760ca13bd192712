// Over Boost.Beast. Operations are asynchronous and driven for short times, so that a wait can be ended.
#include "hosts/transfer/web_socket.h"

#include <fmt/format.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <utility>

#include "hosts/transfer/host_error.h"

namespace lamella {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;

constexpr std::size_t longest_message = std::size_t{4} << 20;
constexpr double request_seconds = 10;
constexpr std::chrono::milliseconds step{20};

}  // namespace

struct WebSocket::Connection {
    std::string name;
    const CancelToken* cancel;
    asio::io_context io;
    beast::websocket::stream<beast::tcp_stream> stream{io};
    beast::flat_buffer buffer{longest_message};
    asio::ip::tcp::resolver resolver{io};
    asio::ip::tcp::resolver::results_type places;
    std::optional<beast::error_code> result;  // of the last connect, handshake or write, once it has ended
    std::string written;                      // lives as long as the write
    bool reads = false;                       // a read is on its way
    std::optional<beast::error_code> read_result;  // of the read, once it has ended

    Connection(std::string given, const CancelToken* token) : name(std::move(given)), cancel(token) {}

    /// Drives operations until `done`; returns false when the time, s, is over before.
    bool drive(double seconds, const std::function<bool()>& done) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (!done()) {
            stop_if_cancelled(cancel);
            if (std::chrono::steady_clock::now() >= until) return false;
            io.restart();
            io.run_one_for(step);
        }
        return true;
    }

    /// Waits for one operation. Throws HostError of this kind when it fails or takes too long.
    void finish(HostFailure failure, const char* what) {
        if (!drive(request_seconds, [&] { return result.has_value(); }))
            throw HostError(failure, fmt::format("{}: {}: no answer", name, what));
        if (*result) throw HostError(failure, fmt::format("{}: {}: {}", name, what, result->message()));
    }

    void connect(const std::string& host, const std::string& port, const std::string& path) {
        resolver.async_resolve(host, port, [this](beast::error_code error, auto found) {
            places = std::move(found);
            result = error;
        });
        finish(HostFailure::unreachable, "cannot be found");
        result.reset();
        beast::get_lowest_layer(stream).async_connect(
            places, [this](beast::error_code error, const asio::ip::tcp::endpoint&) { result = error; });
        finish(HostFailure::unreachable, "cannot be reached");
        result.reset();
        stream.async_handshake(host + ":" + port, path, [this](beast::error_code error) { result = error; });
        finish(HostFailure::unreachable, "opens no WebSocket");
        stream.read_message_max(longest_message);
    }

    void send(const std::string& text) {
        result.reset();
        written = text;
        stream.async_write(asio::buffer(written),
                           [this](beast::error_code error, std::size_t /*bytes*/) { result = error; });
        finish(HostFailure::unanswered, "the connection broke");
    }

    std::optional<std::string> receive(double seconds) {
        if (!std::exchange(reads, true)) {
            read_result.reset();
            stream.async_read(
                buffer, [this](beast::error_code error, std::size_t /*bytes*/) { read_result = error; });
        }
        if (!drive(seconds, [&] { return read_result.has_value(); })) return std::nullopt;
        reads = false;
        if (*read_result)
            throw HostError(HostFailure::unanswered,
                            fmt::format("{}: the connection broke: {}", name, read_result->message()));
        std::string text = beast::buffers_to_string(buffer.data());
        buffer.consume(buffer.size());
        return text;
    }
};

WebSocket::WebSocket(std::string name, const std::string& host, const std::string& port,
                     const std::string& path, const CancelToken* cancel)
    : connection_(std::make_unique<Connection>(std::move(name), cancel)) {
    connection_->connect(host, port, path);
}

/// What is on its way when the connection is destroyed is dropped with it.
WebSocket::~WebSocket() = default;

void WebSocket::send(const std::string& text) { connection_->send(text); }

std::optional<std::string> WebSocket::receive(double seconds) { return connection_->receive(seconds); }

}  // namespace lamella
