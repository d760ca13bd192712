// AnalysisStore: the analyses of a server, one after the other.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "app/http/event_hub.h"
#include "app/jobs/analysis.h"

namespace lamella {

/// Runs analyses in the background, the oldest first. Thread-safe. Keeps the sixteen newest.
class AnalysisStore {
  public:
    explicit AnalysisStore(EventHub& events);
    /// Cancels all, and waits for the one that runs.
    ~AnalysisStore();
    AnalysisStore(const AnalysisStore&) = delete;
    AnalysisStore& operator=(const AnalysisStore&) = delete;

    using Work = std::function<void(Analysis&)>;
    /// Starts an analysis, whose news goes to the session as event "analysis"; returns its number. Throws
    /// HttpError 503 where four wait already.
    int start(const std::string& kind, const std::string& session, Work work);
    /// Throws HttpError 404 for an analysis that is not kept.
    std::shared_ptr<Analysis> find(int number);
    /// Ends an analysis; what it has found stays. Returns it.
    std::shared_ptr<Analysis> stop(int number);
    /// Cancels an analysis, and forgets it.
    void remove(int number);

  private:
    struct Entry {
        std::shared_ptr<Analysis> analysis;
        Work work;
    };
    std::map<int, Entry>::iterator next_waiting();
    void forget_oldest();
    void run();

    EventHub& events_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    int next_ = 1;
    std::map<int, Entry> entries_;
    std::thread worker_;
};

}  // namespace lamella
