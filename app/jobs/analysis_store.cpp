// One thread computes what waits, the lowest number first.
#include "app/jobs/analysis_store.h"

#include <algorithm>
#include <new>
#include <utility>

#include "app/http/http_server.h"

namespace lamella {

AnalysisStore::AnalysisStore(EventHub& events) : events_(events) {
    worker_ = std::thread([this] { run(); });
}

AnalysisStore::~AnalysisStore() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        for (const auto& [number, entry] : entries_) entry.analysis->cancel().cancel();
        changed_.notify_all();
    }
    worker_.join();
}

void AnalysisStore::forget_oldest() {
    constexpr std::size_t most_kept = 16;
    while (entries_.size() >= most_kept) {
        const auto oldest = std::ranges::find_if(
            entries_, [](const auto& item) { return item.second.analysis->has_ended(); });
        if (oldest == entries_.end()) return;
        entries_.erase(oldest);
    }
}

int AnalysisStore::start(const std::string& kind, const std::string& session, Work work) {
    constexpr std::ptrdiff_t most_waiting = 4;
    const std::lock_guard lock(mutex_);
    const auto waiting = std::ranges::count_if(
        entries_, [](const auto& item) { return item.second.analysis->state() == Analysis::State::waiting; });
    if (waiting >= most_waiting) throw HttpError(503, "too many analyses wait already");
    forget_oldest();
    const auto tell = [this, session](const nlohmann::ordered_json& news) {
        events_.send(session, "analysis", news);
    };
    entries_.emplace(next_, Entry{std::make_shared<Analysis>(next_, kind, tell), std::move(work)});
    changed_.notify_all();
    return next_++;
}

std::shared_ptr<Analysis> AnalysisStore::find(int number) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(number);
    if (found == entries_.end()) throw HttpError(404, "there is no such analysis");
    return found->second.analysis;
}

std::shared_ptr<Analysis> AnalysisStore::stop(int number) {
    std::shared_ptr<Analysis> analysis = find(number);
    analysis->cancel().cancel();
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(number);
    // The worker has not taken it, and may be long with the one before.
    if (entry != entries_.end() && entry->second.work) {
        entry->second.work = nullptr;
        analysis->end(Analysis::State::cancelled, "stopped before it began");
    }
    return analysis;
}

void AnalysisStore::remove(int number) {
    const std::shared_ptr<Analysis> analysis = find(number);
    analysis->cancel().cancel();
    const std::lock_guard lock(mutex_);
    entries_.erase(number);
}

std::map<int, AnalysisStore::Entry>::iterator AnalysisStore::next_waiting() {
    return std::ranges::find_if(
        entries_, [](const auto& item) { return item.second.analysis->state() == Analysis::State::waiting; });
}

void AnalysisStore::run() {
    using State = Analysis::State;
    while (true) {
        std::shared_ptr<Analysis> analysis;
        Work work;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return ended_ || next_waiting() != entries_.end(); });
            if (ended_) return;
            Entry& entry = next_waiting()->second;
            analysis = entry.analysis;
            work = std::move(entry.work);  // what it holds goes with it
        }
        analysis->begin();
        try {
            stop_if_cancelled(&analysis->cancel());
            work(*analysis);
            analysis->end(State::done, "");
        } catch (const Interrupted& error) {
            analysis->end(State::cancelled, error.what());
        } catch (const std::bad_alloc&) {
            analysis->end(State::failed, "memory is short; accepted: fewer elements");
        } catch (const std::exception& error) {
            analysis->end(State::failed, error.what());
        }
    }
}

}  // namespace lamella
