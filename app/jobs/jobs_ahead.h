// JobsAhead: computes what a page is about to ask for, one thing at a time.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/jobs/job_store.h"

namespace lamella {

/// Builds a job before it is asked for, and what the page shows of it first. Thread-safe.
class JobsAhead {
  public:
    struct Look {
        std::string text;     ///< of the recipe
        std::string session;  ///< is told how far the build is
        /// The layer that will be asked for, clamped to those of the job; none: the coarse volume.
        std::optional<int> layer;
    };

    /// `threads` is for the volume; 0: one per core.
    JobsAhead(JobStore& jobs, int threads) : jobs_(jobs), threads_(threads), thread_([this] { run(); }) {}
    ~JobsAhead() { end(); }
    JobsAhead(const JobsAhead&) = delete;
    JobsAhead& operator=(const JobsAhead&) = delete;

    /// Begins with this, and gives up whatever came before.
    void begin(Look look);
    /// Gives up all, and waits until nothing is computed.
    void end();

  private:
    void run();
    void show(const Look& look, const std::shared_ptr<CancelToken>& cancel) const;

    JobStore& jobs_;
    int threads_;
    std::mutex mutex_;  // guards what follows
    std::condition_variable changed_;
    std::optional<Look> next_;
    std::shared_ptr<CancelToken> cancel_ = std::make_shared<CancelToken>();  // of what is computed
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace lamella
