// ServedPrinter: the one print that a server may run.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>

#include "app/http/event_hub.h"
#include "app/jobs/served_folder.h"
#include "app/jobs/served_job.h"
#include "app/server/served_print.h"

namespace lamella {

/// Starts prints and hands on requests to the one that runs. Journals lie in the served folder, under the
/// names that `lamella print` gives them. Thread-safe.
class ServedPrinter {
  public:
    ServedPrinter(const ServedFolder& folder, EventHub& events, int threads)
        : folder_(folder), events_(events), threads_(threads) {}

    /// Whether a job can be printed, why not, and what is left of a stopped print of its name.
    nlohmann::ordered_json outlook(const ServedJob& job) const;
    /// Starts a print; returns its state. Throws HttpError 400 for a machine without G-code and for what
    /// read_print_request refuses, 409 while another print runs or where a stopped one was left.
    nlohmann::ordered_json start(std::shared_ptr<const ServedJob> job, const nlohmann::ordered_json& request);
    /// Returns the state of the print that runs, or that ran last.
    nlohmann::ordered_json describe() const;
    /// Returns the messages of that print.
    nlohmann::ordered_json messages() const;
    /// Calls order(print) and returns the print's state. Throws HttpError 409 where none runs.
    nlohmann::ordered_json tell(const std::function<void(ServedPrint&)>& order);
    bool is_printing() const;
    /// Stops a running print, and waits until its heaters are off. No other one is accepted.
    void end();

  private:
    std::filesystem::path journal_of(const ServedJob& job) const;
    bool runs() const { return print_ && !print_->has_ended(); }

    const ServedFolder& folder_;
    EventHub& events_;
    int threads_;
    mutable std::mutex mutex_;
    int next_ = 1;
    bool ended_ = false;
    std::shared_ptr<ServedPrint> print_;
};

}  // namespace lamella
