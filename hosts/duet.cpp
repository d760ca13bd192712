// Requests of RepRapFirmware's own web server (/rr_...) and of the Duet web server on a single-board computer
// (/machine/...). A session begins with the first request, and anew when the machine has forgotten it.
#include "hosts/duet.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/text.h"
#include "hosts/host_json.h"
#include "hosts/wait.h"

namespace lamella {

namespace {

PrintState duet_state(const std::string& word) {
    if (word == "processing" || word == "resuming" || word == "changingTool" || word == "simulating")
        return PrintState::printing;
    if (word == "paused" || word == "pausing") return PrintState::paused;
    if (word == "busy" || word == "cancelling" || word == "starting" || word == "updating")
        return PrintState::busy;
    if (word == "halted") return PrintState::failed;
    return word == "idle" ? PrintState::idle : PrintState::offline;
}

class Duet : public NetworkHost {
  public:
    Duet(const HostAccess& access, std::string folder, const CancelToken* cancel)
        : http_(access, cancel), folder_(std::move(folder)) {
        while (folder_.ends_with('/')) folder_.pop_back();
    }

    HostFacts facts() override {
        HostFacts facts;
        const auto boards = model("boards");
        facts.software = text_at(boards, "/0/firmwareName") + " " + text_at(boards, "/0/firmwareVersion");
        facts.machine = text_at(boards, "/0/name");
        facts.free_bytes = size_at(model("volumes"), "/0/freeSpace");
        facts.formats = ".gcode .g .gco .gc .nc";
        return facts;
    }

    UploadNeeds needs() const override { return UploadNeeds::size_and_hash; }

    std::optional<HostFile> find(const std::string& name) override {
        const std::string path = url_component(path_of(name));
        if (has_computer()) {
            const HostResponse response = ask({.path = "/machine/fileinfo/" + path, .also = {404}});
            if (response.status == 404) return std::nullopt;
            return file_of(read_json(http_, response));
        }
        const auto json = read_json(http_, ask({.path = "/rr_fileinfo?name=" + path}));
        return number_at(json, "/err").value_or(1) == 0 ? file_of(json) : std::nullopt;
    }

    UploadFacts upload(const std::string& name, UploadSource& source,
                       const std::function<void(std::uint64_t)>& on_sent) override {
        UploadFacts facts = source.facts().value();
        const std::string path = url_component(path_of(name));
        const bool computer = has_computer();
        // The body is opened anew for a session that has to begin again.
        const HostResponse response = in_session([&] {
            const std::unique_ptr<UploadBytes> bytes = source.open();
            HostRequest request{.method = computer ? "PUT" : "POST"};
            request.path = computer ? "/machine/file/" + path
                                    : fmt::format("/rr_upload?name={}&crc32={:08x}", path, facts.crc32);
            request.headers.push_back("Content-Type: application/octet-stream");
            request.upload = bytes.get();
            request.upload_size = facts.size;
            request.patience = 60;
            request.on_sent = on_sent;
            return request_in_session(request);
        });
        if (!computer && number_at(read_json(http_, response), "/err").value_or(1) != 0) {
            throw HostError(HostFailure::damaged, http_.access().name +
                                                      ": found the upload damaged, or could not "
                                                      "write it");
        }
        return facts;
    }

    void start(const std::string& name) override { run("M32 \"" + path_of(name) + "\""); }

    HostStatus status() override {
        HostStatus status;
        const auto state = model("state");
        status.state = duet_state(text_at(state, "/status"));
        status.message = text_at(state, "/displayMessage");
        const auto job = model("job");
        status.file = text_at(job, "/file/fileName");
        if (status.state == PrintState::idle) {
            status.file = text_at(job, "/lastFileName");
            const bool cancelled = json_at(job, "/lastFileCancelled") == true;
            const bool aborted = json_at(job, "/lastFileAborted") == true;
            if (!status.file.empty())
                status.state = aborted     ? PrintState::failed
                               : cancelled ? PrintState::cancelled
                                           : PrintState::finished;
        }
        const auto size = number_at(job, "/file/size");
        const auto position = number_at(job, "/filePosition");
        if (size && position && *size > 0 && is_active(status.state)) status.progress = *position / *size;
        status.elapsed = number_at(job, "/duration");
        status.left = number_at(job, "/timesLeft/file");
        if (const auto layer = number_at(job, "/layer")) status.layer = static_cast<int>(*layer);
        if (const auto layers = number_at(job, "/file/numLayers")) status.layers = static_cast<int>(*layers);
        add_heaters(status, model("heat"));
        return status;
    }

    void pause() override { run("M25"); }
    void resume() override { run("M24"); }
    /// A print is cancelled out of its pause.
    void cancel() override {
        constexpr int most_questions = 100;
        run("M25");
        for (int i = 0; i < most_questions && text_at(model("state"), "/status") != "paused"; ++i)
            wait_for(0.2, http_.cancel());
        run("M0");
    }
    bool is_plain() const override { return http_.is_plain(); }

  private:
    static std::optional<HostFile> file_of(const nlohmann::json& json) {
        const auto size = size_at(json, "/size");
        return size ? std::optional(HostFile{*size}) : std::nullopt;
    }

    static void add_heaters(HostStatus& status, const nlohmann::json& heat) {
        const auto& heaters = json_at(heat, "/heaters");
        for (std::size_t i = 0; i < std::min<std::size_t>(heaters.size(), 2); ++i) {
            if (const auto now = number_at(heaters[i], "/current"))
                status.heaters.push_back(
                    {i == 0 ? "bed" : "nozzle", *now, number_at(heaters[i], "/active").value_or(0)});
        }
    }

    bool has_computer() {
        if (!connected_) connect();
        return computer_;
    }

    /// Begins a session.
    void connect() {
        const std::string password =
            url_component(http_.access().key.empty() ? "reprap" : http_.access().key);
        HostResponse response =
            http_.ask({.path = "/rr_connect?sessionKey=yes&password=" + password, .also = {404}});
        computer_ = response.status == 404;
        if (computer_) response = http_.ask({.path = "/machine/connect?password=" + password});
        const auto json = read_json(http_, response);
        const double error = computer_ ? 0 : number_at(json, "/err").value_or(1);
        if (error == 2) throw HostError(HostFailure::busy, http_.access().name + ": has no session free");
        if (error != 0)
            throw InputError(
                http_.access().name +
                ": refuses the password; accepted: the machine's as `key` of this host in hosts.toml");
        const auto& key = json_at(json, "/sessionKey");
        session_ = key.is_string() ? key.get<std::string>() : key.is_number_integer() ? key.dump() : "";
        connected_ = true;
    }

    HostResponse request_in_session(HostRequest request) {
        if (!session_.empty()) request.headers.push_back("X-Session-Key: " + session_);
        request.also.insert(request.also.end(), {401, 403});
        return http_.ask(request);
    }

    /// Calls `send`, and once more in a new session where the machine has forgotten the old one.
    template <typename Send>
    HostResponse in_session(const Send& send) {
        if (!connected_) connect();
        HostResponse response = send();
        if (response.status == 401 || response.status == 403) {
            connect();
            response = send();
        }
        if (response.status == 401 || response.status == 403)
            throw InputError(http_.access().name + ": ends every session at once; is its password right?");
        return response;
    }

    HostResponse ask(const HostRequest& request) {
        return in_session([&] { return request_in_session(request); });
    }

    /// Returns a part of the machine's object model.
    nlohmann::json model(const std::string& key) {
        if (has_computer())
            return json_at(read_json(http_, ask({.path = "/machine/status"})), ("/" + key).c_str());
        const auto json = read_json(http_, ask({.path = "/rr_model?flags=d99vn&key=" + key}));
        return json_at(json, "/result");
    }

    /// Runs a command. Throws HostError when the machine answers with an error.
    void run(const std::string& gcode) {
        std::string reply;
        if (has_computer()) {
            reply = ask({.method = "POST",
                         .path = "/machine/code",
                         .headers = {"Content-Type: text/plain"},
                         .content = gcode})
                        .body;
        } else {
            ask({.path = "/rr_gcode?gcode=" + url_component(gcode), .once = true});
            reply = ask({.path = "/rr_reply"}).body;
        }
        if (reply.find("Error:") != std::string::npos)
            throw HostError(
                HostFailure::refused,
                http_.access().name + ": " + std::string(trimmed(reply.substr(0, reply.find('\n')))));
    }

    std::string path_of(const std::string& name) const { return folder_ + "/" + name; }

    HttpConnection http_;
    std::string folder_;
    std::string session_;
    bool connected_ = false;
    bool computer_ = false;  // a single-board computer answers for the machine
};

}  // namespace

std::unique_ptr<NetworkHost> make_duet(const HostAccess& access, const std::string& storage,
                                       const CancelToken* cancel) {
    return std::make_unique<Duet>(access, storage, cancel);
}

}  // namespace lamella
