// One thread slices what waits, the lowest number first.
#include "app/jobs/output_store.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/http/http_server.h"
#include "engine/layers/layer_stream.h"
#include "printers/registry.h"
#include "recipe/printer_choice.h"

namespace lamella {

namespace fs = std::filesystem;

struct OutputStore::Entry {
    enum class State : unsigned char { waiting, running, done, failed, cancelled };

    int number = 0;
    std::shared_ptr<const ServedJob> job;
    std::string session;
    fs::path path;
    bool is_temporary = false;
    CancelToken cancel;
    std::mutex mutex;  // guards what follows
    State state = State::waiting;
    std::int64_t done = 0;
    std::string message;
};

OutputStore::OutputStore(const ServedFolder& folder, EventHub& events, int threads)
    : folder_(folder), events_(events), threads_(threads) {
    worker_ = std::thread([this] { run(); });
}

OutputStore::~OutputStore() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        for (const auto& [number, entry] : entries_) entry->cancel.cancel();
        changed_.notify_all();
    }
    worker_.join();
}

fs::path OutputStore::place_of(const ServedJob& job, const std::string& file, int number) const {
    const PrinterProfile& printer = job.recipe.printer;
    if (file.empty())
        return temporary_.path() / fmt::format("{}", number) / default_output(printer, job.job().name);
    fs::path path = folder_.file(file);
    const std::vector<std::string> endings = output_endings(find_backend(printer.backend));
    const bool fits =
        std::ranges::any_of(endings, [&](const std::string& ending) { return file.ends_with(ending); });
    if (!fits && !endings.empty() && !endings.front().empty())
        throw HttpError(400, fmt::format("{}: not a file of {}; accepted: a name that ends in {}", file,
                                         printer.name, endings.front()));
    if (fs::exists(path)) throw HttpError(400, file + ": exists already; accepted: another name");
    return path;
}

int OutputStore::start(std::shared_ptr<const ServedJob> job, const std::string& file,
                       const std::string& session) {
    constexpr std::size_t most_waiting = 8, most_kept = 32;
    const std::lock_guard lock(mutex_);
    const auto waiting = std::ranges::count_if(entries_, [](const auto& item) {
        const std::lock_guard state(item.second->mutex);
        return item.second->state <= Entry::State::running;
    });
    if (static_cast<std::size_t>(waiting) >= most_waiting)
        throw HttpError(503, "too many outputs wait already");
    if (entries_.size() >= most_kept)
        throw HttpError(503, "too many outputs are kept; accepted: DELETE some");
    auto entry = std::make_shared<Entry>();
    entry->number = next_;
    entry->path = place_of(*job, file, next_);
    entry->is_temporary = file.empty();
    entry->job = std::move(job);
    entry->session = session;
    entries_.emplace(next_, entry);
    changed_.notify_all();
    return next_++;
}

std::shared_ptr<OutputStore::Entry> OutputStore::find(int number) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(number);
    if (found == entries_.end()) throw HttpError(404, "there is no such output");
    return found->second;
}

nlohmann::ordered_json OutputStore::describe(Entry& entry) {
    constexpr std::array names{"waiting", "running", "done", "failed", "cancelled"};
    const std::lock_guard lock(entry.mutex);
    std::error_code error;
    const bool is_done = entry.state == Entry::State::done;
    const auto bytes = is_done && fs::is_regular_file(entry.path) ? fs::file_size(entry.path, error) : 0;
    return {{"output", entry.number},
            {"state", names[static_cast<std::size_t>(entry.state)]},
            {"done", entry.done},
            {"of", entry.job->job().layers.count()},
            {"file", entry.is_temporary ? entry.path.filename().string()
                                        : fs::relative(entry.path, folder_.path()).string()},
            {"is_kept", !entry.is_temporary},
            {"bytes", bytes},
            {"message", entry.message}};
}

nlohmann::ordered_json OutputStore::describe(int number) { return describe(*find(number)); }

fs::path OutputStore::file(int number) {
    const std::shared_ptr<Entry> entry = find(number);
    const std::lock_guard lock(entry->mutex);
    if (entry->state != Entry::State::done) throw HttpError(404, "this output is not done");
    if (!fs::is_regular_file(entry->path))
        throw HttpError(404, entry->path.string() + " is a folder; accepted: outputs that are one file");
    return entry->path;
}

void OutputStore::remove(int number) {
    const std::shared_ptr<Entry> entry = find(number);
    entry->cancel.cancel();
    const std::lock_guard lock(mutex_);
    entries_.erase(number);
    std::error_code error;
    if (entry->is_temporary) fs::remove_all(entry->path.parent_path(), error);
}

void OutputStore::slice(Entry& entry) {
    if (entry.is_temporary) fs::create_directories(entry.path.parent_path());
    const Job& job = entry.job->job();
    const auto backend = make_backend(entry.job->recipe.printer, entry.path.string(), false);
    StreamOptions options;
    options.range = {0, job.layers.count()};
    options.threads = threads_;
    options.cancel = &entry.cancel;
    options.on_progress = [&](const Progress& progress) {
        {
            const std::lock_guard lock(entry.mutex);
            if (progress.done < entry.done + job.layers.count() / 200 && progress.done < progress.total)
                return;
            entry.done = progress.done;
        }
        events_.send(entry.session, "output", describe(entry));
    };
    stream_layers(job, *backend, options);
}

void OutputStore::run() {
    while (true) {
        std::shared_ptr<Entry> entry;
        {
            std::unique_lock lock(mutex_);
            const auto waits = [&](const auto& item) {
                const std::lock_guard state(item.second->mutex);
                return item.second->state == Entry::State::waiting;
            };
            changed_.wait(lock, [&] { return ended_ || std::ranges::any_of(entries_, waits); });
            if (ended_) return;
            entry = std::ranges::find_if(entries_, waits)->second;
            const std::lock_guard state(entry->mutex);
            entry->state = Entry::State::running;
        }
        auto state = Entry::State::done;
        std::string message;
        try {
            slice(*entry);
        } catch (const Interrupted&) {
            state = Entry::State::cancelled;
            // Nobody goes on with it.
            std::error_code error;
            for (const char* rest : {".partial", ".partial.journal"})
                fs::remove_all(entry->path.string() + rest, error);
        } catch (const std::exception& error) {
            state = Entry::State::failed;
            message = error.what();
        }
        {
            const std::lock_guard lock(entry->mutex);
            entry->state = state;
            entry->message = message;
            if (state == Entry::State::done) entry->done = entry->job->job().layers.count();
        }
        events_.send(entry->session, "output", describe(*entry));
    }
}

}  // namespace lamella
