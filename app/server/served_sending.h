// ServedSending: jobs on their way to printers on the network, sent by a server.
#pragma once

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "app/http/event_hub.h"
#include "app/jobs/served_job.h"

namespace lamella {

/// Sends one job at a time in the background, to a host of the user's file of hosts; no other address can be
/// named. Thread-safe.
class ServedSending {
  public:
    ServedSending(EventHub& events, int threads) : events_(events), threads_(threads) {}
    /// Cancels what is on its way.
    ~ServedSending();
    ServedSending(const ServedSending&) = delete;
    ServedSending& operator=(const ServedSending&) = delete;

    /// Begins to send; returns the state. `request`: {"host": "voron", "start": true, "again": true}, the
    /// latter two if wanted. Throws HttpError 400 for other members and unknown hosts, 409 while a job is
    /// sent.
    nlohmann::ordered_json start(std::shared_ptr<const ServedJob> job, const nlohmann::ordered_json& request);
    /// Returns the state of the job that is sent, or that was sent last.
    nlohmann::ordered_json describe() const;
    /// Ends what is on its way; nothing of it is started.
    void cancel();

  private:
    struct Sending;
    void run(Sending& sending) const;
    static nlohmann::ordered_json describe(const Sending& sending);

    EventHub& events_;
    int threads_;
    mutable std::mutex mutex_;
    int next_ = 1;
    std::shared_ptr<Sending> sending_;
    std::thread thread_;
};

}  // namespace lamella
