// A thread for each job that is sent. Its state is told to all sessions: a printer is everybody's.
#include "app/server/served_sending.h"

#include <chrono>
#include <optional>

#include "app/http/http_server.h"
#include "app/jobs/send_job.h"
#include "hosts/known_hosts.h"

namespace lamella {

using Json = nlohmann::ordered_json;

struct ServedSending::Sending {
    enum class State : unsigned char { running, done, failed, cancelled };

    int number = 0;
    std::shared_ptr<const ServedJob> job;
    KnownHost host;
    JobSending how;
    CancelToken cancel;
    mutable std::mutex mutex;  // guards what follows
    State state = State::running;
    int layers = 0;  // that are computed
    std::uint64_t bytes = 0;
    std::optional<std::uint64_t> of{};
    JobSendReport report{};
    std::string message{};  // what a person should know, or why it failed
};

namespace {

bool flag_of(const Json& request, const char* name) {
    if (!request.contains(name)) return false;
    if (!request[name].is_boolean()) throw HttpError(400, std::string(name) + ": accepted: true or false");
    return request[name].get<bool>();
}

KnownHost host_of(const Json& request) {
    if (const auto host = known_host(text_member(request, "host"))) return *host;
    throw HttpError(400, "host: accepted: a name in " + hosts_file());
}

}  // namespace

ServedSending::~ServedSending() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

Json ServedSending::start(std::shared_ptr<const ServedJob> job, const Json& request) {
    for (const auto& [name, value] : request.items()) {
        if (name != "host" && name != "start" && name != "again")
            throw HttpError(400, name.substr(0, 32) + ": unknown; accepted: host, start, again");
    }
    auto sending = std::make_shared<Sending>();
    sending->host = host_of(request);
    sending->how.upload.start = flag_of(request, "start");
    sending->how.upload.again = flag_of(request, "again");
    sending->how.stream.range = {0, job->job().layers.count()};
    sending->how.stream.threads = threads_;
    sending->job = std::move(job);
    const std::lock_guard lock(mutex_);
    if (sending_) {
        const std::lock_guard state(sending_->mutex);
        if (sending_->state == Sending::State::running)
            throw HttpError(409, "a job is on its way already; accepted: DELETE /api/sending, or wait");
    }
    if (thread_.joinable()) thread_.join();
    sending->number = next_++;
    sending_ = sending;
    thread_ = std::thread([this, sending] { run(*sending); });
    return describe(*sending);
}

void ServedSending::run(Sending& sending) const {
    using Clock = std::chrono::steady_clock;
    Clock::time_point told{};
    const auto change = [&](const auto& what, bool at_once) {
        {
            const std::lock_guard lock(sending.mutex);
            what();
        }
        if (!at_once && Clock::now() - told < std::chrono::milliseconds(200)) return;
        told = Clock::now();
        events_.send("", "sending", describe(sending));
    };
    const auto end = [&](Sending::State state, const std::string& message) {
        change([&] { sending.state = state, sending.message = message; }, true);
    };
    // Layers are computed by another thread than the one that sends: they are counted, and told with the
    // bytes.
    sending.how.stream.on_progress = [&](const Progress& progress) {
        const std::lock_guard lock(sending.mutex);
        sending.layers = progress.done;
    };
    sending.how.upload.cancel = &sending.cancel;
    sending.how.upload.on_note = [&](const std::string& text) {
        change([&] { sending.message = text; }, true);
    };
    sending.how.upload.on_sent = [&](std::uint64_t bytes, std::optional<std::uint64_t> of) {
        change([&] { sending.bytes = bytes, sending.of = of; }, false);
    };
    try {
        const auto host = sending.host.connect(&sending.cancel);
        const ServedJob& job = *sending.job;
        greet_host(*host, sending.how.upload);
        const JobSendReport report = send_job(*host, job.recipe, job.job(), sending.how);
        change([&] { sending.report = report; }, false);
        end(Sending::State::done, "");
    } catch (const Interrupted&) {
        end(Sending::State::cancelled, "");
    } catch (const std::exception& error) {
        end(Sending::State::failed, error.what());
    }
}

Json ServedSending::describe(const Sending& sending) {
    constexpr const char* words[] = {"running", "done", "failed", "cancelled"};
    const std::lock_guard lock(sending.mutex);
    Json json{{"sending", sending.number},
              {"state", words[static_cast<std::size_t>(sending.state)]},
              {"job", sending.job->id},
              {"host", sending.host.access.name},
              {"file", sending.report.name},
              {"layers", sending.layers},
              {"of_layers", sending.job->job().layers.count()},
              {"bytes", sending.bytes},
              {"of_bytes", sending.of ? Json(*sending.of) : Json(nullptr)},
              {"prints", sending.report.upload.prints},
              {"message", sending.message}};
    return json;
}

Json ServedSending::describe() const {
    const std::lock_guard lock(mutex_);
    return sending_ ? describe(*sending_) : Json{{"state", "none"}};
}

void ServedSending::cancel() {
    const std::lock_guard lock(mutex_);
    if (sending_) sending_->cancel.cancel();
}

}  // namespace lamella
