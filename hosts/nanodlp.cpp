// Requests of NanoDLP's web interface. A plate has the upload's name without its ending, and a number.
#include "hosts/nanodlp.h"

#include <fmt/format.h>

#include "hosts/host_json.h"
#include "hosts/transfer/multipart_body.h"

namespace lamella {

namespace {

constexpr const char* ending = ".nanodlp";

/// Returns a number that may stand in quotes.
std::optional<double> loose_number_at(const nlohmann::json& json, const char* pointer) {
    if (const auto number = number_at(json, pointer)) return number;
    const std::string text = text_at(json, pointer);
    const auto parsed = nlohmann::json::parse(text, nullptr, false);
    return parsed.is_number() ? std::optional(parsed.get<double>()) : std::nullopt;
}

class NanoDlp : public NetworkHost {
  public:
    NanoDlp(const HostAccess& access, std::string profile, const CancelToken* cancel)
        : http_(access, cancel), profile_(std::move(profile)) {
        if (!access.key.empty()) http_.send_always("Authorization: Bearer " + access.key);
    }

    HostFacts facts() override {
        HostFacts facts;
        const auto json = read_json(http_, get("/status"));
        facts.software = "NanoDLP";
        if (const auto build = loose_number_at(json, "/Build"))
            facts.software += fmt::format(" build {:.0f}", *build);
        facts.machine = text_at(json, "/Hostname");
        facts.formats = ending;
        return facts;
    }

    UploadNeeds needs() const override { return UploadNeeds::size; }

    /// The host tells layers of a plate, not bytes: it has read the whole file once it can count them.
    std::optional<HostFile> find(const std::string& name) override {
        const nlohmann::json plate = plate_of(name);
        if (plate.is_null() || loose_number_at(plate, "/LayersCount").value_or(0) < 1) return std::nullopt;
        return HostFile{};
    }

    UploadFacts upload(const std::string& name, UploadSource& source,
                       const std::function<void(std::uint64_t)>& on_sent) override {
        UploadForm form;
        form.before = {{"Path", plate_name(name)}, {"ProfileID", profile_}};
        form.file_field = "ZipFile";
        form.file_name = name;
        MultipartBody body(std::move(form), source.open());
        HostRequest request = {.method = "POST", .path = "/plate/add", .also = {302, 303}};
        request.headers.push_back("Content-Type: " + body.content_type());
        request.upload = &body;
        request.upload_size = body.size_with(source.facts().value().size);
        request.patience = 120;  // it reads all layers before it answers
        request.on_sent = on_sent;
        http_.ask(request);
        return body.sent();
    }

    void start(const std::string& name) override {
        const auto id = loose_number_at(plate_of(name), "/PlateID");
        if (!id)
            throw HostError(HostFailure::refused, http_.access().name + ": has no plate " + plate_name(name));
        http_.ask({.method = "POST", .path = fmt::format("/api/v1/printer/start/{:.0f}", *id)});
    }

    HostStatus status() override {
        HostStatus status;
        const auto json = read_json(http_, get("/status"));
        const bool paused = json_at(json, "/Paused") == true;
        const bool printing = json_at(json, "/Printing") == true;
        status.state = printing ? (paused ? PrintState::paused : PrintState::printing) : PrintState::idle;
        if (const std::string path = text_at(json, "/Path"); !path.empty()) status.file = path + ending;
        const auto layer = loose_number_at(json, "/LayerID");
        const auto layers = loose_number_at(json, "/LayersCount");
        if (layer) status.layer = static_cast<int>(*layer);
        if (layers) status.layers = static_cast<int>(*layers);
        if (layer && layers && *layers > 0) status.progress = *layer / *layers;
        if (!printing && layer && layers && *layers > 0 && *layer >= *layers)
            status.state = PrintState::finished;
        status.message = text_at(json, "/Error");
        return status;
    }

    void pause() override { change("/api/v1/printer/printer/pause"); }
    void resume() override { change("/api/v1/printer/printer/unpause"); }
    void cancel() override { change("/api/v1/printer/printer/stop"); }
    bool is_plain() const override { return http_.is_plain(); }

  private:
    void change(const std::string& path) { http_.ask({.path = path, .once = true}); }
    HostResponse get(const std::string& path) { return http_.ask({.path = path}); }

    static std::string plate_name(const std::string& name) {
        return name.ends_with(ending) ? name.substr(0, name.rfind('.')) : name;
    }

    /// Returns the newest plate of an upload's name; null where there is none.
    nlohmann::json plate_of(const std::string& name) {
        nlohmann::json newest;
        for (const auto& plate : read_json(http_, get("/plates/list/json"))) {
            const bool is_newer = newest.is_null() || loose_number_at(plate, "/PlateID").value_or(0) >
                                                          loose_number_at(newest, "/PlateID").value_or(0);
            if (text_at(plate, "/Path") == plate_name(name) && is_newer) newest = plate;
        }
        return newest;
    }

    HttpConnection http_;
    std::string profile_;
};

}  // namespace

std::unique_ptr<NetworkHost> make_nanodlp(const HostAccess& access, const std::string& storage,
                                          const CancelToken* cancel) {
    return std::make_unique<NanoDlp>(access, storage, cancel);
}

}  // namespace lamella
