// ServerState: what the routes of a server share.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <semaphore>
#include <set>
#include <string>
#include <string_view>

#include "app/http/http_server.h"
#include "app/jobs/analysis_store.h"
#include "app/jobs/job_store.h"
#include "app/jobs/jobs_ahead.h"
#include "app/jobs/output_store.h"
#include "app/server/served_printer.h"
#include "app/server/served_sending.h"

namespace lamella {

struct ServerOptions {
    HttpOptions http;
    std::filesystem::path folder = ".";  ///< beyond which no file is read or written
    std::string recipe;                  ///< file within the folder that the page begins with; empty: none
    bool has_page = false;               ///< serves the studio's page
    int threads = 0;                     ///< for layers; 0: one per core
    std::size_t jobs = 4;                ///< that are held
    /// Told why the server does not end at once; may be empty.
    std::function<void(const std::string& text)> on_delay{};
};

/// Limits the requests that compute at the same time, each of which may use all threads.
class ComputeTurn {
  public:
    using Turns = std::counting_semaphore<64>;
    /// Waits for a turn. Throws HttpError 503 after 30 seconds.
    explicit ComputeTurn(Turns& turns);
    ~ComputeTurn() { turns_.release(); }
    ComputeTurn(const ComputeTurn&) = delete;
    ComputeTurn& operator=(const ComputeTurn&) = delete;

  private:
    Turns& turns_;
};

struct ServerState {
    explicit ServerState(const ServerOptions& given);

    ServerOptions options;
    HttpServer http;
    ServedFolder folder;
    EventHub events;
    JobStore jobs;
    JobsAhead ahead;
    OutputStore outputs;
    ServedPrinter printer;
    ServedSending sending;
    AnalysisStore analyses;
    ComputeTurn::Turns turns;
    std::mutex own_recipes_mutex;
    std::set<std::filesystem::path> own_recipes;  ///< which may be written again
};

/// Control of slow work that a request asks for: a newer recipe of its session ends it. Without a session
/// nothing does.
struct SessionWork {
    /// With a view another request of the session for the same ends the work, too.
    SessionWork(ServerState& state, const HttpRequest& request, std::optional<JobStore::View> view = {});

    std::shared_ptr<CancelToken> cancel;  ///< null without a session
    PassControl control;
};

/// Add the routes of a part of the interface (docs/embedding/http.md).
void add_setting_routes(ServerState& state);
void add_recipe_routes(ServerState& state);
void add_job_routes(ServerState& state);
void add_layer_routes(ServerState& state);
void add_output_routes(ServerState& state);
void add_print_routes(ServerState& state);
void add_host_routes(ServerState& state);
void add_analysis_routes(ServerState& state);
void add_page_routes(ServerState& state);

/// Serves until `cancel` is set, and until a print that runs then was stopped with its heaters off.
/// `on_ready` is told the address of the page or of the interface.
void serve_http(const ServerOptions& options, const CancelToken& cancel,
                const std::function<void(const std::string& address)>& on_ready);

}  // namespace lamella
