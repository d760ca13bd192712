// Requests of Moonraker's HTTP interface.
#include "hosts/moonraker.h"

#include "hosts/host_json.h"
#include "hosts/transfer/multipart_body.h"

namespace lamella {

namespace {

PrintState klipper_state(const std::string& klippy, const std::string& print) {
    if (klippy == "startup") return PrintState::busy;
    if (klippy == "error" || klippy == "shutdown") return PrintState::failed;
    if (klippy != "ready") return PrintState::offline;
    if (print == "printing") return PrintState::printing;
    if (print == "paused") return PrintState::paused;
    if (print == "complete") return PrintState::finished;
    if (print == "cancelled") return PrintState::cancelled;
    if (print == "error") return PrintState::failed;
    return PrintState::idle;
}

class Moonraker : public NetworkHost {
  public:
    Moonraker(const HostAccess& access, std::string folder, const CancelToken* cancel)
        : http_(access, cancel), folder_(std::move(folder)) {
        if (!access.key.empty()) http_.send_always("X-Api-Key: " + access.key);
        while (folder_.ends_with('/')) folder_.pop_back();
    }

    HostFacts facts() override {
        const auto server = read_json(http_, get("/server/info"));
        HostFacts facts;
        facts.software = "Moonraker " + text_at(server, "/result/moonraker_version");
        // Klipper tells its computer's name only while it runs.
        const HostResponse printer = http_.ask({.path = "/printer/info", .also = {500, 503}});
        if (printer.status == 200) facts.machine = text_at(read_json(http_, printer), "/result/hostname");
        const auto files = read_json(http_, get("/server/files/directory?path=gcodes"));
        facts.free_bytes = size_at(files, "/result/disk_usage/free");
        facts.formats = ".gcode .g .gco .ufp .nc";
        return facts;
    }

    UploadNeeds needs() const override { return UploadNeeds::nothing; }

    std::optional<HostFile> find(const std::string& name) override {
        const HostResponse response = http_.ask(
            {.path = "/server/files/metadata?filename=" + url_component(path_of(name)), .also = {404}});
        if (response.status == 404) return std::nullopt;
        const auto size = size_at(read_json(http_, response), "/result/size");
        if (!size) return std::nullopt;
        return HostFile{*size};
    }

    UploadFacts upload(const std::string& name, UploadSource& source,
                       const std::function<void(std::uint64_t)>& on_sent) override {
        UploadForm form;
        form.before = {{"root", "gcodes"}};
        if (!folder_.empty()) form.before.emplace_back("path", folder_);
        form.file_name = name;
        form.after = [](const UploadFacts& sent) {
            return std::vector<FormField>{{"checksum", sent.sha256}};
        };
        MultipartBody body(std::move(form), source.open());
        HostRequest request = {.method = "POST", .path = "/server/files/upload"};
        request.headers.push_back("Content-Type: " + body.content_type());
        request.upload = &body;
        if (source.facts()) request.upload_size = body.size_with(source.facts()->size);
        request.patience = 60;  // Moonraker reads the file's metadata before it answers
        request.on_sent = on_sent;
        http_.ask(request);
        return body.sent();
    }

    void start(const std::string& name) override {
        post("/printer/print/start?filename=" + url_component(path_of(name)));
    }

    HostStatus status() override {
        HostStatus status;
        const auto server = read_json(http_, get("/server/info"));
        const std::string klippy = text_at(server, "/result/klippy_state");
        status.state = klipper_state(klippy, "");
        const HostResponse response = http_.ask(
            {.path = "/printer/objects/query?webhooks&print_stats&virtual_sdcard&display_status&extruder&"
                     "heater_bed",
             .also = {500, 503}});
        if (response.status != 200) return status;  // Klipper does not run
        const auto json = read_json(http_, response);
        const nlohmann::json& objects = json_at(json, "/result/status");
        const std::string running = text_at(objects, "/webhooks/state");
        status.state =
            klipper_state(running.empty() ? klippy : running, text_at(objects, "/print_stats/state"));
        status.file = text_at(objects, "/print_stats/filename");
        status.progress = number_at(objects, "/virtual_sdcard/progress");
        status.elapsed = number_at(objects, "/print_stats/print_duration");
        if (status.progress && status.elapsed && *status.progress > 0.01)
            status.left = *status.elapsed * (1 - *status.progress) / *status.progress;
        if (const auto layer = number_at(objects, "/print_stats/info/current_layer"))
            status.layer = static_cast<int>(*layer);
        if (const auto layers = number_at(objects, "/print_stats/info/total_layer"))
            status.layers = static_cast<int>(*layers);
        add_heater(status, objects, "extruder", "nozzle");
        add_heater(status, objects, "heater_bed", "bed");
        status.message = text_at(objects, "/print_stats/message");
        if (status.message.empty()) status.message = text_at(objects, "/display_status/message");
        if (status.state == PrintState::failed && status.message.empty())
            status.message = text_at(objects, "/webhooks/state_message");
        return status;
    }

    void pause() override { post("/printer/print/pause"); }
    void resume() override { post("/printer/print/resume"); }
    void cancel() override { post("/printer/print/cancel"); }
    bool is_plain() const override { return http_.is_plain(); }

  private:
    HostResponse get(const std::string& path) { return http_.ask({.path = path}); }
    /// Requests of the printer are answered when Klipper has done them.
    void post(const std::string& path) { http_.ask({.method = "POST", .path = path, .patience = 60}); }
    std::string path_of(const std::string& name) const {
        return folder_.empty() ? name : folder_ + "/" + name;
    }
    static void add_heater(HostStatus& status, const nlohmann::json& objects, const std::string& object,
                           const std::string& name) {
        const auto now = number_at(objects, ("/" + object + "/temperature").c_str());
        if (!now) return;
        const auto target = number_at(objects, ("/" + object + "/target").c_str());
        status.heaters.push_back({name, *now, target.value_or(0)});
    }

    HttpConnection http_;
    std::string folder_;
};

}  // namespace

std::unique_ptr<NetworkHost> make_moonraker(const HostAccess& access, const std::string& storage,
                                            const CancelToken* cancel) {
    return std::make_unique<Moonraker>(access, storage, cancel);
}

}  // namespace lamella
