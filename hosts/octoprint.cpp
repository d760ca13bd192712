// Requests of OctoPrint's REST interface.
#include "hosts/octoprint.h"

#include <nlohmann/json.hpp>

#include "hosts/host_json.h"
#include "hosts/transfer/multipart_body.h"

namespace lamella {

namespace {

PrintState octoprint_state(const std::string& text, std::optional<double> completion) {
    constexpr double whole = 99.99;
    if (text.starts_with("Offline") || text.starts_with("Opening") || text.starts_with("Detecting") ||
        text.starts_with("Connecting"))
        return PrintState::offline;
    if (text.starts_with("Error") || text.starts_with("Closed")) return PrintState::failed;
    if (text.starts_with("Paus")) return PrintState::paused;
    if (text.starts_with("Printing") || text.starts_with("Starting") || text.starts_with("Resuming") ||
        text.starts_with("Finishing") || text.starts_with("Sending"))
        return PrintState::printing;
    if (text.starts_with("Cancelling")) return PrintState::busy;
    if (completion && *completion >= whole) return PrintState::finished;
    return PrintState::idle;
}

class OctoPrint : public NetworkHost {
  public:
    OctoPrint(const HostAccess& access, const std::string& storage, const CancelToken* cancel)
        : http_(access, cancel), location_(storage.substr(0, storage.find('/'))) {
        if (!access.key.empty()) http_.send_always("X-Api-Key: " + access.key);
        if (storage.size() > location_.size()) folder_ = storage.substr(location_.size() + 1);
        while (folder_.ends_with('/')) folder_.pop_back();
    }

    HostFacts facts() override {
        HostFacts facts;
        const auto version = read_json(http_, get("/api/version"));
        facts.software = text_at(version, "/text");
        if (facts.software.empty()) facts.software = "OctoPrint " + text_at(version, "/server");
        facts.free_bytes = size_at(read_json(http_, get("/api/files/" + location_)), "/free");
        return facts;
    }

    UploadNeeds needs() const override { return UploadNeeds::size; }

    std::optional<HostFile> find(const std::string& name) override {
        const HostResponse response = http_.ask({.path = address_of(name), .also = {404}});
        if (response.status == 404) return std::nullopt;
        const auto file = read_json(http_, response);
        const auto size = size_at(file, "/size");
        return size ? std::optional(HostFile{*size, text_at(file, "/hash")}) : std::nullopt;
    }

    UploadFacts upload(const std::string& name, UploadSource& source,
                       const std::function<void(std::uint64_t)>& on_sent) override {
        UploadForm form;
        if (!folder_.empty()) form.before.emplace_back("path", folder_);
        form.before.emplace_back("select", "false");
        form.before.emplace_back("print", "false");
        form.file_name = name;
        MultipartBody body(std::move(form), source.open());
        HostRequest request = {.method = "POST", .path = "/api/files/" + location_};
        request.headers.push_back("Content-Type: " + body.content_type());
        request.upload = &body;
        request.upload_size = body.size_with(source.facts().value().size);
        request.patience = 60;
        request.on_sent = on_sent;
        http_.ask(request);
        return body.sent();
    }

    void start(const std::string& name) override {
        post(address_of(name), {{"command", "select"}, {"print", true}});
    }

    HostStatus status() override {
        HostStatus status;
        const auto job = read_json(http_, get("/api/job"));
        const auto completion = number_at(job, "/progress/completion");
        status.state = octoprint_state(text_at(job, "/state"), completion);
        status.file = text_at(job, "/job/file/path");
        if (status.file.empty()) status.file = text_at(job, "/job/file/name");
        if (completion) status.progress = *completion / 100;
        status.elapsed = number_at(job, "/progress/printTime");
        status.left = number_at(job, "/progress/printTimeLeft");
        if (status.state == PrintState::failed) status.message = text_at(job, "/state");
        const HostResponse response = http_.ask({.path = "/api/printer", .also = {404, 409}});
        if (response.status != 200) return status;  // not connected to its printer
        const auto printer = read_json(http_, response);
        for (const auto& [object, name] : {std::pair("tool0", "nozzle"), std::pair("bed", "bed")}) {
            const std::string place = std::string("/temperature/") + object;
            if (const auto now = number_at(printer, (place + "/actual").c_str()))
                status.heaters.push_back(
                    {name, *now, number_at(printer, (place + "/target").c_str()).value_or(0)});
        }
        return status;
    }

    void pause() override { post("/api/job", {{"command", "pause"}, {"action", "pause"}}); }
    void resume() override { post("/api/job", {{"command", "pause"}, {"action", "resume"}}); }
    void cancel() override { post("/api/job", {{"command", "cancel"}}); }
    bool is_plain() const override { return http_.is_plain(); }

  private:
    HostResponse get(const std::string& path) { return http_.ask({.path = path}); }
    void post(const std::string& path, const nlohmann::json& command) {
        http_.ask({.method = "POST",
                   .path = path,
                   .headers = {"Content-Type: application/json"},
                   .content = command.dump()});
    }
    std::string address_of(const std::string& name) const {
        return "/api/files/" + location_ + "/" + (folder_.empty() ? "" : url_path(folder_) + "/") +
               url_component(name);
    }

    HttpConnection http_;
    std::string location_, folder_;
};

}  // namespace

std::unique_ptr<NetworkHost> make_octoprint(const HostAccess& access, const std::string& storage,
                                            const CancelToken* cancel) {
    return std::make_unique<OctoPrint>(access, storage, cancel);
}

}  // namespace lamella
