// Over libcurl: one transfer at a time, driven by polling, so that a wait for bytes can be ended.
#include "hosts/transfer/http_connection.h"

#include <curl/curl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/text.h"

namespace lamella {

namespace {

constexpr std::size_t largest_answer = std::size_t{16} << 20;
constexpr std::size_t most_headers = 200;
constexpr double connect_seconds = 10;
constexpr int poll_ms = 50;
constexpr long leave_ms = 300;  ///< time that a host has to refuse an upload before its first byte

void start_curl() {
    static std::once_flag once;
    std::call_once(once, [] { curl_global_init(CURL_GLOBAL_DEFAULT); });
}

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A transfer on its way, as curl's callbacks see it.
struct Transfer {
    const HostRequest& request;
    CURL* easy;
    HostResponse response{};
    std::uint64_t sent = 0;
    bool waits_for_bytes = false;  // the upload has none at the moment
    bool asked = false;            // the request was sent, and no header of an answer has come since
    double moved_at = steady_seconds();
    std::exception_ptr failure{};
};

std::size_t take_body(char* out, std::size_t size, std::size_t count, void* user) {
    auto& transfer = *static_cast<Transfer*>(user);
    try {
        const std::span<char> room(out, size * count);
        std::optional<std::size_t> taken = 0;
        if (transfer.request.upload != nullptr) {
            taken = transfer.request.upload->take(room);
        } else {
            const std::string& content = transfer.request.content;
            const auto sent = static_cast<std::size_t>(transfer.sent);
            const std::size_t rest = std::min(room.size(), content.size() - sent);
            content.copy(room.data(), rest, sent);
            taken = rest;
            if (rest == 0) taken.reset();
        }
        if (!taken) return 0;
        if (*taken == 0) {
            transfer.waits_for_bytes = true;
            return CURL_READFUNC_PAUSE;
        }
        transfer.sent += *taken;
        transfer.moved_at = steady_seconds();
        if (transfer.request.on_sent) transfer.request.on_sent(transfer.sent);
        return *taken;
    } catch (...) {
        transfer.failure = std::current_exception();
        return CURL_READFUNC_ABORT;
    }
}

std::size_t store_body(char* bytes, std::size_t size, std::size_t count, void* user) {
    auto& transfer = *static_cast<Transfer*>(user);
    transfer.moved_at = steady_seconds();
    if (transfer.response.body.size() + size * count > largest_answer) return 0;
    transfer.response.body.append(bytes, size * count);
    return size * count;
}

std::size_t store_header(char* bytes, std::size_t size, std::size_t count, void* user) {
    auto& transfer = *static_cast<Transfer*>(user);
    transfer.moved_at = steady_seconds();
    transfer.asked = false;
    const std::string_view line(bytes, size * count);
    if (line.starts_with("HTTP/")) transfer.response.headers.clear(), transfer.response.body.clear();
    const std::size_t colon = line.find(':');
    if (colon != std::string_view::npos && transfer.response.headers.size() < most_headers) {
        transfer.response.headers[lower_case(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
    }
    return size * count;
}

/// Curl repeats a request when the connection is closed that it has kept from an earlier one. Whether a
/// request that changes something was heard is not known then: it must not be sent twice.
int allow_request(void* user, char* /*primary_ip*/, char* /*local_ip*/, int /*primary_port*/,
                  int /*local_port*/) {
    auto& transfer = *static_cast<Transfer*>(user);
    const bool is_question = transfer.request.method == "GET" && !transfer.request.once;
    if (transfer.asked && !is_question) return CURL_PREREQFUNC_ABORT;
    transfer.asked = true;
    return CURL_PREREQFUNC_OK;
}

/// A body that was partly sent cannot be sent again from its start: the caller opens it anew.
int seek_body(void* user, curl_off_t offset, int origin) {
    auto& transfer = *static_cast<Transfer*>(user);
    if (offset != 0 || origin != SEEK_SET) return CURL_SEEKFUNC_FAIL;
    if (transfer.request.upload != nullptr) return transfer.sent == 0 ? CURL_SEEKFUNC_OK : CURL_SEEKFUNC_FAIL;
    transfer.sent = 0;
    return CURL_SEEKFUNC_OK;
}

/// Returns what a host says in the body of an error, shortened: the texts of JSON, or the first line.
std::string words_of(const HostResponse& response) {
    constexpr std::size_t longest = 300;
    std::string words;
    const auto json = nlohmann::json::parse(response.body, nullptr, false);
    if (json.is_object()) {
        const auto& inner = json.contains("error") && json["error"].is_object() ? json["error"] : json;
        for (const char* key : {"message", "error", "text", "title"}) {
            if (!words.empty() || !inner.contains(key) || !inner[key].is_string()) continue;
            words = inner[key].get<std::string>();
        }
    } else if (!response.body.starts_with('<')) {
        words = response.body;
    }
    words = words.substr(0, std::min(words.find('\n'), longest));
    std::erase_if(words, [](unsigned char c) { return c < ' ' || c == 127; });
    return words;
}

}  // namespace

struct HttpConnection::Handles {
    CURL* easy = curl_easy_init();
    CURLM* multi = curl_multi_init();

    Handles() {
        if (easy == nullptr || multi == nullptr) throw FaultError("libcurl could not be started");
    }
    ~Handles() {
        curl_easy_cleanup(easy);
        curl_multi_cleanup(multi);
    }
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;

    void set_up(const HostAccess& access, const HostRequest& request, Transfer& transfer,
                curl_slist* headers);
    CURLcode drive(Transfer& transfer, const CancelToken* cancel);
};

void HttpConnection::Handles::set_up(const HostAccess& access, const HostRequest& request, Transfer& transfer,
                                     curl_slist* headers) {
    curl_easy_reset(easy);  // keeps connections
    curl_easy_setopt(easy, CURLOPT_NOSIGNAL, 1L);
    curl_easy_setopt(easy, CURLOPT_PROTOCOLS_STR, "http,https");
    curl_easy_setopt(easy, CURLOPT_URL, (access.url + request.path).c_str());
    curl_easy_setopt(easy, CURLOPT_USERAGENT, "lamella/" LAMELLA_VERSION);
    curl_easy_setopt(easy, CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(connect_seconds * 1000));
    curl_easy_setopt(easy, CURLOPT_HTTPHEADER, headers);
    curl_easy_setopt(easy, CURLOPT_EXPECT_100_TIMEOUT_MS, leave_ms);
    curl_easy_setopt(easy, CURLOPT_HTTP_VERSION, static_cast<long>(CURL_HTTP_VERSION_1_1));
    if (!access.certificate_file.empty())
        curl_easy_setopt(easy, CURLOPT_CAINFO, access.certificate_file.c_str());
    if (!access.user.empty()) {
        curl_easy_setopt(easy, CURLOPT_HTTPAUTH, static_cast<long>(CURLAUTH_DIGEST));
        curl_easy_setopt(easy, CURLOPT_USERNAME, access.user.c_str());
        curl_easy_setopt(easy, CURLOPT_PASSWORD, access.key.c_str());
    }
    curl_easy_setopt(easy, CURLOPT_WRITEFUNCTION, store_body);
    curl_easy_setopt(easy, CURLOPT_WRITEDATA, &transfer);
    curl_easy_setopt(easy, CURLOPT_PREREQFUNCTION, allow_request);
    curl_easy_setopt(easy, CURLOPT_PREREQDATA, &transfer);
    curl_easy_setopt(easy, CURLOPT_HEADERFUNCTION, store_header);
    curl_easy_setopt(easy, CURLOPT_HEADERDATA, &transfer);
    if (request.upload != nullptr || request.method == "POST" || request.method == "PUT") {
        curl_easy_setopt(easy, CURLOPT_UPLOAD, 1L);
        curl_easy_setopt(easy, CURLOPT_READFUNCTION, take_body);
        curl_easy_setopt(easy, CURLOPT_READDATA, &transfer);
        curl_easy_setopt(easy, CURLOPT_SEEKFUNCTION, seek_body);
        curl_easy_setopt(easy, CURLOPT_SEEKDATA, &transfer);
        if (request.upload == nullptr)
            curl_easy_setopt(easy, CURLOPT_INFILESIZE_LARGE, static_cast<curl_off_t>(request.content.size()));
        else if (request.upload_size)
            curl_easy_setopt(easy, CURLOPT_INFILESIZE_LARGE, static_cast<curl_off_t>(*request.upload_size));
    }
    curl_easy_setopt(easy, CURLOPT_CUSTOMREQUEST, request.method.c_str());
}

CURLcode HttpConnection::Handles::drive(Transfer& transfer, const CancelToken* cancel) {
    if (transfer.request.upload != nullptr)
        transfer.request.upload->on_ready([multi = multi] { curl_multi_wakeup(multi); });
    curl_multi_add_handle(multi, easy);
    CURLcode result = CURLE_OK;
    for (bool running = true; running;) {
        int active = 0;
        curl_multi_perform(multi, &active);
        int left = 0;
        while (const CURLMsg* message = curl_multi_info_read(multi, &left)) {
            if (message->msg == CURLMSG_DONE) result = message->data.result, running = false;
        }
        if (!running) break;
        if (cancel != nullptr && cancel->cancelled()) {
            result = CURLE_ABORTED_BY_CALLBACK;
            transfer.failure = std::make_exception_ptr(Interrupted("stopped"));
            break;
        }
        // Waiting for our own bytes is no fault of the host.
        if (transfer.waits_for_bytes) transfer.moved_at = steady_seconds();
        if (steady_seconds() - transfer.moved_at > transfer.request.patience) {
            result = CURLE_OPERATION_TIMEDOUT;
            break;
        }
        curl_multi_poll(multi, nullptr, 0, poll_ms, nullptr);
        if (std::exchange(transfer.waits_for_bytes, false)) curl_easy_pause(easy, CURLPAUSE_CONT);
    }
    curl_multi_remove_handle(multi, easy);
    if (transfer.request.upload != nullptr) transfer.request.upload->on_ready({});
    return result;
}

HttpConnection::HttpConnection(HostAccess access, const CancelToken* cancel)
    : access_(std::move(access)), cancel_(cancel) {
    start_curl();
    handles_ = std::make_unique<Handles>();
}

HttpConnection::~HttpConnection() = default;

HostResponse HttpConnection::exchange(const HostRequest& request) {
    stop_if_cancelled(cancel_);
    // A host that refuses an upload says so before its first byte, if it is asked.
    curl_slist* list =
        curl_slist_append(nullptr, request.upload != nullptr ? "Expect: 100-continue" : "Expect:");
    for (const std::string& header : always_) list = curl_slist_append(list, header.c_str());
    for (const std::string& header : request.headers) list = curl_slist_append(list, header.c_str());
    const std::unique_ptr<curl_slist, decltype(&curl_slist_free_all)> headers(list, curl_slist_free_all);
    Transfer transfer{request, handles_->easy};
    handles_->set_up(access_, request, transfer, headers.get());
    const CURLcode result = handles_->drive(transfer, cancel_);
    if (transfer.failure) std::rethrow_exception(transfer.failure);
    long status = 0;
    curl_easy_getinfo(handles_->easy, CURLINFO_RESPONSE_CODE, &status);
    transfer.response.status = static_cast<int>(status);
    // A host may refuse a body before it has read it, and close the connection: its answer counts.
    if (result == CURLE_OK || (status >= 400 && result == CURLE_SEND_ERROR))
        return std::move(transfer.response);
    switch (result) {
        case CURLE_COULDNT_RESOLVE_HOST:
        case CURLE_COULDNT_CONNECT:
            throw HostError(HostFailure::unreachable,
                            fmt::format("{}: cannot be reached at {}: {}", access_.name, access_.url,
                                        curl_easy_strerror(result)));
        case CURLE_PEER_FAILED_VERIFICATION:
        case CURLE_SSL_CACERT_BADFILE:
        case CURLE_SSL_CERTPROBLEM:
            throw InputError(fmt::format(
                "{}: the certificate of {} is not trusted: {}; accepted: a certificate for this name by an "
                "authority that this computer trusts, or `certificate = FILE` with the host's own",
                access_.name, access_.url, curl_easy_strerror(result)));
        case CURLE_URL_MALFORMAT:
        case CURLE_UNSUPPORTED_PROTOCOL:
            throw InputError(
                fmt::format("{}: url = \"{}\" is not an address; accepted: http://HOST or https://HOST",
                            access_.name, access_.url));
        case CURLE_OPERATION_TIMEDOUT: {
            double connected = 0;
            curl_easy_getinfo(handles_->easy, CURLINFO_PRETRANSFER_TIME, &connected);
            if (connected <= 0) {
                throw HostError(
                    HostFailure::unreachable,
                    fmt::format("{}: cannot be reached at {}: no answer", access_.name, access_.url));
            }
            throw HostError(HostFailure::unanswered,
                            fmt::format("{}: said nothing for {:g} s", access_.name, request.patience));
        }
        default:
            throw HostError(HostFailure::unanswered, fmt::format("{}: the connection broke: {}", access_.name,
                                                                 curl_easy_strerror(result)));
    }
}

HostResponse HttpConnection::ask(const HostRequest& request) {
    HostResponse response = exchange(request);
    const int status = response.status;
    if ((status >= 200 && status < 300) || std::ranges::find(request.also, status) != request.also.end())
        return response;
    std::string words = words_of(response);
    if (!words.empty()) words = ", " + words;
    if (status == 401 || (status == 403 && request.method == "GET")) {
        throw InputError(fmt::format(
            "{}: {} ({}{}); accepted: `key` (and `user`) of this host in hosts.toml, or LAMELLA_HOST_KEY",
            access_.name, access_.key.empty() ? "asks for a key" : "refuses the key", status, words));
    }
    HostFailure kind = HostFailure::refused;
    if (status == 429 || status == 502 || status == 503 || status == 504) kind = HostFailure::busy;
    if (status == 422) kind = HostFailure::damaged;
    const std::string path = request.path.substr(0, request.path.find('?'));
    throw HostError(
        kind, fmt::format("{}: {} {} was refused: {}{}", access_.name, request.method, path, status, words),
        status);
}

namespace {

std::string percent_encoded(const std::string& text, std::string_view also_plain) {
    std::string encoded;
    for (const char c : text) {
        const bool is_letter_or_digit =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (is_letter_or_digit || also_plain.find(c) != std::string_view::npos)
            encoded += c;
        else
            encoded += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return encoded;
}

}  // namespace

std::string url_component(const std::string& text) { return percent_encoded(text, "-._~"); }

std::string url_path(const std::string& text) { return percent_encoded(text, "-._~/"); }

}  // namespace lamella
