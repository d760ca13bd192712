// OutputStore: files that a server slices in the background.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "app/http/event_hub.h"
#include "app/jobs/served_job.h"
#include "app/jobs/temporary_folder.h"

namespace lamella {

/// Slices jobs to files of their machines, one after the other. Thread-safe. Files without a place in the
/// served folder lie in a temporary one, which goes with the store.
class OutputStore {
  public:
    OutputStore(const ServedFolder& folder, EventHub& events, int threads);
    ~OutputStore();
    OutputStore(const OutputStore&) = delete;
    OutputStore& operator=(const OutputStore&) = delete;

    /// Starts an output; returns its number. `file`: within the folder, of an ending of the machine; empty:
    /// the part's name, in the temporary folder. Throws HttpError for a file that exists, lies elsewhere or
    /// has another ending, and 503 where eight wait already.
    int start(std::shared_ptr<const ServedJob> job, const std::string& file, const std::string& session);
    /// Returns number, state, layers done and to do, file, bytes and message. Throws HttpError 404.
    nlohmann::ordered_json describe(int number);
    /// Returns the file of an output that is done. Throws HttpError 404 for others, and for folders.
    std::filesystem::path file(int number);
    /// Cancels an output, and forgets it with its temporary file.
    void remove(int number);

  private:
    struct Entry;
    std::shared_ptr<Entry> find(int number);
    void run();
    void slice(Entry& entry);
    nlohmann::ordered_json describe(Entry& entry);
    std::filesystem::path place_of(const ServedJob& job, const std::string& file, int number) const;

    const ServedFolder& folder_;
    EventHub& events_;
    int threads_;
    TemporaryFolder temporary_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    int next_ = 1;
    std::map<int, std::shared_ptr<Entry>> entries_;
    std::thread worker_;
};

}  // namespace lamella
