// Requests of PrusaLink's interface, version 1.
#include "hosts/prusalink.h"

#include <fmt/format.h>

#include "hosts/host_json.h"

namespace lamella {

namespace {

PrintState prusalink_state(const std::string& word) {
    if (word == "PRINTING") return PrintState::printing;
    if (word == "PAUSED") return PrintState::paused;
    if (word == "FINISHED") return PrintState::finished;
    if (word == "STOPPED") return PrintState::cancelled;
    if (word == "ERROR") return PrintState::failed;
    if (word == "BUSY" || word == "ATTENTION") return PrintState::busy;
    return word == "IDLE" || word == "READY" ? PrintState::idle : PrintState::offline;
}

class PrusaLink : public NetworkHost {
  public:
    PrusaLink(const HostAccess& access, std::string storage, const CancelToken* cancel)
        : http_(access, cancel), storage_(std::move(storage)) {
        if (access.user.empty() && !access.key.empty()) http_.send_always("X-Api-Key: " + access.key);
        while (storage_.starts_with('/')) storage_.erase(0, 1);
        while (storage_.ends_with('/')) storage_.pop_back();
    }

    HostFacts facts() override {
        HostFacts facts;
        const auto version = read_json(http_, get("/api/version"));
        facts.software = "PrusaLink " + text_at(version, "/server");
        facts.machine = text_at(version, "/hostname");
        const auto storages = read_json(http_, get("/api/v1/storage"));
        const std::string wanted = storage_.substr(0, storage_.find('/'));
        std::string known;
        for (const auto& each : json_at(storages, "/storage_list")) {
            std::string path = text_at(each, "/path");
            std::erase(path, '/');
            known += (known.empty() ? "" : ", ") + path;
            if (path != wanted) continue;
            facts.free_bytes = size_at(each, "/free_space");
            return facts;
        }
        throw InputError(fmt::format("{}: storage = \"{}\" is not there; accepted: {}", http_.access().name,
                                     wanted,
                                     known.empty() ? "none at the moment; is a drive missing?" : known));
    }

    UploadNeeds needs() const override { return UploadNeeds::size; }

    std::optional<HostFile> find(const std::string& name) override {
        const HostResponse response = http_.ask({.path = address_of(name), .also = {404}});
        if (response.status == 404) return std::nullopt;
        const auto size = size_at(read_json(http_, response), "/size");
        return size ? std::optional(HostFile{*size}) : std::nullopt;
    }

    UploadFacts upload(const std::string& name, UploadSource& source,
                       const std::function<void(std::uint64_t)>& on_sent) override {
        const std::unique_ptr<UploadBytes> bytes = source.open();
        HostRequest request = {.method = "PUT", .path = address_of(name)};
        request.headers.insert(request.headers.end(), {"Content-Type: application/octet-stream",
                                                       "Print-After-Upload: ?0", "Overwrite: ?1"});
        request.upload = bytes.get();
        request.upload_size = source.facts().value().size;
        request.patience = 60;
        request.on_sent = on_sent;
        http_.ask(request);
        return source.facts().value();
    }

    void start(const std::string& name) override { http_.ask({.method = "POST", .path = address_of(name)}); }

    HostStatus status() override {
        HostStatus status;
        const auto json = read_json(http_, get("/api/v1/status"));
        status.state = prusalink_state(text_at(json, "/printer/state"));
        if (const auto percent = number_at(json, "/job/progress")) status.progress = *percent / 100;
        status.elapsed = number_at(json, "/job/time_printing");
        status.left = number_at(json, "/job/time_remaining");
        for (const char* name : {"nozzle", "bed"}) {
            const auto now = number_at(json, (std::string("/printer/temp_") + name).c_str());
            const auto target = number_at(json, (std::string("/printer/target_") + name).c_str());
            if (now) status.heaters.push_back({name, *now, target.value_or(0)});
        }
        status.message = text_at(json, "/printer/status_printer/message");
        if (status.message == "OK") status.message.clear();
        // The name as it was uploaded; older firmware has short names beside it.
        const auto job = read_job();
        status.file = text_at(job, "/file/display_name");
        if (status.file.empty()) status.file = text_at(job, "/file/name");
        return status;
    }

    void pause() override { change_job("PUT", "/pause"); }
    void resume() override { change_job("PUT", "/resume"); }
    void cancel() override { change_job("DELETE", ""); }
    bool is_plain() const override { return http_.is_plain(); }

  private:
    HostResponse get(const std::string& path) { return http_.ask({.path = path}); }
    /// Returns the job; null where there is none.
    nlohmann::json read_job() {
        const HostResponse response = get("/api/v1/job");
        return response.status == 204 ? nlohmann::json() : read_json(http_, response);
    }
    void change_job(const std::string& method, const std::string& what) {
        const auto id = size_at(read_job(), "/id");
        if (!id) throw HostError(HostFailure::refused, http_.access().name + ": prints nothing");
        http_.ask({.method = method, .path = fmt::format("/api/v1/job/{}{}", *id, what)});
    }
    std::string address_of(const std::string& name) const {
        return "/api/v1/files/" + url_path(storage_) + "/" + url_component(name);
    }

    HttpConnection http_;
    std::string storage_;
};

}  // namespace

std::unique_ptr<NetworkHost> make_prusalink(const HostAccess& access, const std::string& storage,
                                            const CancelToken* cancel) {
    return std::make_unique<PrusaLink>(access, storage, cancel);
}

}  // namespace lamella
