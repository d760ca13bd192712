// Commands over a WebSocket; files in parts of a megabyte over HTTP.
#include "hosts/sdcp.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "engine/base/text.h"
#include "hosts/host_json.h"
#include "hosts/transfer/multipart_body.h"
#include "hosts/transfer/web_socket.h"

namespace lamella {

namespace {

constexpr std::size_t part_bytes = std::size_t{1} << 20;
constexpr double answer_seconds = 10;
constexpr double check_seconds = 2;  ///< time within which a machine complains of a file's MD5

enum Command : int {
    refresh_status = 0,
    tell_attributes = 1,
    start_print = 128,
    pause_print = 129,
    stop_print = 130,
    resume_print = 131,
    list_files = 258
};

/// Returns the address with the protocol's port where it has none.
HostAccess with_port(HostAccess access) {
    const std::size_t host = access.url.find("://") + 3;
    if (access.url.find(':', host) == std::string::npos) access.url += ":3030";
    return access;
}

/// A part of a file's bytes, held in memory.
class PartBytes : public UploadBytes {
  public:
    explicit PartBytes(std::string_view part) : part_(part) {}
    std::optional<std::size_t> take(std::span<char> out) override {
        if (part_.empty()) return std::nullopt;
        const std::size_t count = part_.copy(out.data(), out.size());
        part_.remove_prefix(count);
        return count;
    }

  private:
    std::string_view part_;
};

/// Fills `part` with the next bytes of a file; leaves it short at the end only. Files never make one wait.
void read_part(UploadBytes& bytes, std::string& part) {
    part.resize(part_bytes);
    std::size_t filled = 0;
    while (filled < part.size()) {
        const auto count = bytes.take(std::span(part).subspan(filled));
        if (!count) break;
        filled += *count;
    }
    part.resize(filled);
}

const char* words_of_ack(double ack) {
    constexpr const char* words[] = {"done",
                                     "it is busy",
                                     "it has no such file",
                                     "the file's MD5 is wrong",
                                     "it cannot read the file",
                                     "the file is for another resolution",
                                     "it does not know the file's format",
                                     "the file is for another machine"};
    return ack >= 0 && ack < std::size(words) ? words[static_cast<std::size_t>(ack)] : "for a reason unknown";
}

PrintState sdcp_state(const nlohmann::json& status) {
    const auto sub = number_at(status, "/PrintInfo/Status").value_or(0);
    constexpr double paused = 6, pausing = 5, stopped = 8, complete = 9;
    const auto& current = json_at(status, "/CurrentStatus");
    const bool prints = current == 1 || (current.is_array() &&
                                         std::ranges::find(current, nlohmann::json(1)) != current.end());
    if (prints) return sub == paused || sub == pausing ? PrintState::paused : PrintState::printing;
    const bool idle = current == 0 ||
                      (current.is_array() && std::ranges::find(current, nlohmann::json(0)) != current.end());
    if (!idle) return PrintState::busy;
    if (number_at(status, "/PrintInfo/ErrorNumber").value_or(0) != 0) return PrintState::failed;
    return sub == complete ? PrintState::finished : sub == stopped ? PrintState::cancelled : PrintState::idle;
}

class Sdcp : public NetworkHost {
  public:
    Sdcp(const HostAccess& access, std::string storage, const CancelToken* cancel)
        : http_(with_port(access), cancel), storage_(std::move(storage)) {
        std::erase(storage_, '/');
    }

    HostFacts facts() override {
        ask(tell_attributes, nlohmann::json::object());
        const auto message = wait_for_topic("sdcp/attributes/");
        const auto& attributes = json_at(message, "/Attributes").is_null()
                                     ? json_at(message, "/Data/Attributes")
                                     : json_at(message, "/Attributes");
        HostFacts facts;
        facts.software = "SDCP " + text_at(attributes, "/ProtocolVersion") + ", firmware " +
                         text_at(attributes, "/FirmwareVersion");
        facts.machine = text_at(attributes, "/MachineName");
        facts.free_bytes = size_at(attributes, "/RemainingMemory");
        for (const auto& type : json_at(attributes, "/SupportFileType")) {
            if (type.is_string())
                facts.formats += (facts.formats.empty() ? "." : " .") + lower_case(type.get<std::string>());
        }
        return facts;
    }

    UploadNeeds needs() const override { return UploadNeeds::size_and_hash; }

    /// The list tells used storage, which need not be the file's size: the MD5 speaks for the file.
    std::optional<HostFile> find(const std::string& name) override {
        const auto answer = ask(list_files, {{"Url", "/" + storage_ + "/"}});
        for (const auto& file : json_at(answer, "/FileList")) {
            const std::string path = text_at(file, "/name");
            if (path == name || path == path_of(name)) return HostFile{};
        }
        return std::nullopt;
    }

    UploadFacts upload(const std::string& name, UploadSource& source,
                       const std::function<void(std::uint64_t)>& on_sent) override {
        UploadFacts facts = source.facts().value();
        const std::string id = facts.md5.substr(0, 24) + fmt::format("{:08x}", ++uploads_);
        connect();
        const std::unique_ptr<UploadBytes> bytes = source.open();
        std::string part;
        for (std::uint64_t offset = 0; offset < facts.size; offset += part.size()) {
            read_part(*bytes, part);
            if (part.empty()) throw FaultError(name + ": has become shorter while it was sent");
            send_part(name, facts, id, offset, part);
            on_sent(offset + part.size());
        }
        refuse_damaged();
        return facts;
    }

    void start(const std::string& name) override {
        const auto answer = ask(start_print, {{"Filename", path_of(name)}, {"StartLayer", 0}});
        check_ack(answer, "cannot print " + name);
    }

    HostStatus status() override {
        ask(refresh_status, nlohmann::json::object());
        const auto message = wait_for_topic("sdcp/status/");
        const auto& told = json_at(message, "/Status").is_null() ? json_at(message, "/Data/Status")
                                                                 : json_at(message, "/Status");
        HostStatus status;
        status.state = sdcp_state(told);
        status.file = text_at(told, "/PrintInfo/Filename");
        const auto layer = number_at(told, "/PrintInfo/CurrentLayer");
        const auto layers = number_at(told, "/PrintInfo/TotalLayer");
        if (layer) status.layer = static_cast<int>(*layer);
        if (layers) status.layers = static_cast<int>(*layers);
        if (layer && layers && *layers > 0) status.progress = *layer / *layers;
        constexpr double milliseconds = 1000;
        const auto elapsed = number_at(told, "/PrintInfo/CurrentTicks");
        const auto total = number_at(told, "/PrintInfo/TotalTicks");
        if (elapsed) status.elapsed = *elapsed / milliseconds;
        if (elapsed && total && *total >= *elapsed) status.left = (*total - *elapsed) / milliseconds;
        if (status.state == PrintState::failed)
            status.message =
                fmt::format("error {:.0f}", number_at(told, "/PrintInfo/ErrorNumber").value_or(0));
        return status;
    }

    void pause() override { check_ack(ask(pause_print, nlohmann::json::object()), "cannot pause"); }
    void resume() override { check_ack(ask(resume_print, nlohmann::json::object()), "cannot go on"); }
    void cancel() override { check_ack(ask(stop_print, nlohmann::json::object()), "cannot stop"); }
    bool is_plain() const override { return true; }

  private:
    const std::string& host_name() const { return http_.access().name; }
    std::string path_of(const std::string& name) const { return "/" + storage_ + "/" + name; }

    void connect() {
        if (socket_) return;
        const std::string& url = http_.access().url;
        const std::size_t host = url.find("://") + 3;
        const std::size_t colon = url.find(':', host);
        const std::string address = url.substr(host, colon - host);
        if (board_.empty()) {
            const auto machines = find_sdcp(address, 0.5, http_.cancel());
            if (!machines.empty()) board_ = machines[0].board;
        }
        socket_ = std::make_unique<WebSocket>(host_name(), address, url.substr(colon + 1), "/websocket",
                                              http_.cancel());
        topics_.clear();
    }

    /// Returns the next message within this time, s; null where none comes. A connection that is lost is
    /// opened anew by the next request.
    nlohmann::json next_message(double seconds) {
        try {
            const auto text = socket_->receive(seconds);
            if (!text) return nullptr;
            auto json = nlohmann::json::parse(*text, nullptr, false);
            if (board_.empty()) {
                board_ = text_at(json, "/MainboardID");
                if (board_.empty()) board_ = text_at(json, "/Data/MainboardID");
            }
            return json.is_object() ? json : nlohmann::json::object();
        } catch (const HostError&) {
            socket_.reset();
            throw;
        }
    }

    /// Sends a command and returns the data of its answer.
    nlohmann::json ask(Command command, const nlohmann::json& data) {
        connect();
        const std::string id = fmt::format("{:016x}", ++requests_);
        const nlohmann::ordered_json request{{"Id", ""},
                                             {"Data",
                                              {{"Cmd", static_cast<int>(command)},
                                               {"Data", data},
                                               {"RequestID", id},
                                               {"MainboardID", board_},
                                               {"TimeStamp", 0},
                                               {"From", 0}}},
                                             {"Topic", "sdcp/request/" + board_}};
        try {
            socket_->send(request.dump());
        } catch (const HostError&) {
            socket_.reset();
            throw;
        }
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(answer_seconds);
        while (std::chrono::steady_clock::now() < until) {
            const auto message = next_message(answer_seconds);
            if (message.is_null()) break;
            if (text_at(message, "/Data/RequestID") == id) return json_at(message, "/Data/Data");
            keep(message);
        }
        throw HostError(HostFailure::unanswered, host_name() + ": does not answer");
    }

    /// Keeps the last message of each topic.
    void keep(const nlohmann::json& message) {
        const std::string topic = text_at(message, "/Topic");
        const std::size_t slash = topic.rfind('/');
        if (slash != std::string::npos) topics_[topic.substr(0, slash + 1)] = message;
    }

    /// Returns the message of a topic that follows a request, or has come just before its answer.
    nlohmann::json wait_for_topic(const std::string& topic) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(answer_seconds);
        while (!topics_.contains(topic) && std::chrono::steady_clock::now() < until) {
            const auto message = next_message(answer_seconds);
            if (!message.is_null()) keep(message);
        }
        const auto node = topics_.extract(topic);
        if (node.empty())
            throw HostError(HostFailure::unanswered, host_name() + ": tells nothing of " + topic);
        return node.mapped();
    }

    void check_ack(const nlohmann::json& answer, const std::string& what) const {
        const double ack = number_at(answer, "/Ack").value_or(-1);
        if (ack == 0) return;
        throw HostError(ack == 1 ? HostFailure::busy : HostFailure::refused,
                        fmt::format("{}: {}: {}", host_name(), what, words_of_ack(ack)));
    }

    void send_part(const std::string& name, const UploadFacts& facts, const std::string& id,
                   std::uint64_t offset, const std::string& part) {
        UploadForm form;
        form.before = {{"S-File-MD5", facts.md5},
                       {"Check", "1"},
                       {"Offset", std::to_string(offset)},
                       {"Uuid", id},
                       {"TotalSize", std::to_string(facts.size)}};
        form.file_field = "File";
        form.file_name = name;
        MultipartBody body(std::move(form), std::make_unique<PartBytes>(part));
        HostRequest request{.method = "POST", .path = "/uploadFile/upload"};
        request.headers.push_back("Content-Type: " + body.content_type());
        request.upload = &body;
        request.upload_size = body.size_with(part.size());
        request.patience = 60;
        const auto answer = read_json(http_, http_.ask(request));
        if (json_at(answer, "/success") == true) return;
        throw HostError(
            HostFailure::damaged,
            fmt::format(
                "{}: the part at byte {} was refused: {}", host_name(), offset,
                json_at(answer, "/messages").dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)));
    }

    /// Waits for what the machine says of a file that is there.
    void refuse_damaged() {
        const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(check_seconds);
        topics_.erase("sdcp/error/");
        while (std::chrono::steady_clock::now() < until && !topics_.contains("sdcp/error/")) {
            const auto message = next_message(check_seconds);
            if (!message.is_null()) keep(message);
        }
        const auto error = topics_.extract("sdcp/error/");
        if (error.empty()) return;
        const auto& code = json_at(error.mapped(), "/Data/Data/ErrorCode");
        const bool is_format = code == 2 || code == "2";
        throw HostError(
            is_format ? HostFailure::refused : HostFailure::damaged,
            host_name() + (is_format ? ": does not know the file's format" : ": the file's MD5 is wrong"));
    }

    HttpConnection http_;
    std::string storage_;
    std::string board_;  // the machine's own name for itself
    std::unique_ptr<WebSocket> socket_;
    std::map<std::string, nlohmann::json> topics_;  // last message of each, by the topic without the board
    std::uint64_t requests_ = 0;
    unsigned uploads_ = 0;
};

}  // namespace

std::unique_ptr<NetworkHost> make_sdcp(const HostAccess& access, const std::string& storage,
                                       const CancelToken* cancel) {
    return std::make_unique<Sdcp>(access, storage, cancel);
}

}  // namespace lamella
