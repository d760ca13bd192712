// JobStore: the jobs that a server holds, and those that it is building.
#pragma once

#include <condition_variable>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "app/http/event_hub.h"
#include "app/jobs/served_job.h"

namespace lamella {

/// Holds the jobs that were used last, `most` of them. Thread-safe. Jobs in use outlive their place here.
class JobStore {
  public:
    JobStore(const ServedFolder& folder, EventHub& events, int threads, std::size_t most)
        : folder_(folder), events_(events), threads_(threads), most_(most) {}

    /// Returns the job of a recipe's text; builds it if it is not held. Progress goes to the session. A build
    /// of the session with a lower number is cancelled. `searches`: whether the build does the search of
    /// [optimize] where its result is not kept. Throws RecipeMistakes, HttpError 428 for a job that needs a
    /// search that it may not do, and Interrupted when a build with a higher number came.
    std::shared_ptr<const ServedJob> build(const std::string& text, const std::string& session,
                                           std::int64_t sequence, bool searches = true);
    /// Builds the job of a text before anyone asks for it; build() waits for it, and one of another job
    /// cancels it. Progress goes to the session. Returns null where build() would throw. One at a time.
    std::shared_ptr<const ServedJob> build_ahead(const std::string& text, const std::string& session,
                                                 const std::shared_ptr<CancelToken>& cancel);
    /// Ends the build of a session, and what is computed for those who look at its job.
    void end_session(const std::string& session);
    /// Returns what tells slow work for a session that a newer recipe of the session has come; null for a
    /// session that has built nothing.
    std::shared_ptr<CancelToken> work_of(const std::string& session);
    /// What a session looks at one of at a time: a layer's paths, a curve over the layers.
    enum class View : std::uint8_t { paths, curve };
    /// Ends what is computed for such a view of the session before; returns what tells the same to the next.
    std::shared_ptr<CancelToken> begin_view(const std::string& session, View view);
    /// Throws HttpError 404 for a job that is not held.
    std::shared_ptr<const ServedJob> find(const std::string& id);
    void forget(const std::string& id);
    /// Cancels all builds.
    void cancel_all();

  private:
    struct Build {
        std::int64_t sequence = 0;
        std::shared_ptr<CancelToken> cancel;
        std::shared_ptr<CancelToken> work;  ///< for those who look at the job
        std::map<View, std::shared_ptr<CancelToken>> views;

        /// Ends the work and that for the views, and begins it anew.
        void end_work();
    };
    std::shared_ptr<CancelToken> begin(const std::string& session, std::int64_t sequence);
    void end_work(const std::string& session, std::int64_t sequence);
    std::shared_ptr<const ServedJob> held(const std::string& id);
    void hold(std::shared_ptr<const ServedJob> job);
    /// Waits until a job that is built ahead is there, or will not be. Cancels another one.
    void wait_for_ahead(const std::string& id, const CancelToken& cancel);
    BuildControl control(const CancelToken& cancel, const std::string& session);

    const ServedFolder& folder_;
    EventHub& events_;
    int threads_;
    std::size_t most_;
    InputCache inputs_;
    std::mutex mutex_;
    std::list<std::shared_ptr<const ServedJob>> jobs_;  // the one used last first
    std::map<std::string, Build> builds_;               // the latest of each session
    std::string ahead_;                                 // id of the job that is built ahead, while it is
    std::shared_ptr<CancelToken> ahead_cancel_;         // of it
    std::condition_variable ahead_ended_;
};

}  // namespace lamella
