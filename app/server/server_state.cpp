// Puts a server together, and stops it.
#include "app/server/server_state.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "engine/base/whole_file.h"

namespace lamella {

namespace {

constexpr std::ptrdiff_t most_computing = 3;

/// Computes what the page first shows of the recipe that it begins with, while the browser starts.
void show_ahead(ServerState& state) {
    try {
        const std::string file = state.folder.file(state.options.recipe).string();
        state.ahead.begin({whole_file(file, "a recipe"), "", {}});
    } catch (const std::exception&) {  // told to the page when it asks
    }
}

}  // namespace

ComputeTurn::ComputeTurn(Turns& turns) : turns_(turns) {
    constexpr std::chrono::seconds patience{30};
    if (!turns_.try_acquire_for(patience)) throw HttpError(503, "too many requests wait already");
}

ServerState::ServerState(const ServerOptions& given)
    : options(given),
      http(given.http),
      folder(given.folder),
      jobs(folder, events, given.threads, given.jobs),
      ahead(jobs, given.threads),
      outputs(folder, events, given.threads),
      printer(folder, events, given.threads),
      sending(events, given.threads),
      analyses(events),
      turns(most_computing) {
    if (!options.recipe.empty()) own_recipes.insert(folder.file(options.recipe));
    add_setting_routes(*this);
    add_recipe_routes(*this);
    add_job_routes(*this);
    add_layer_routes(*this);
    add_output_routes(*this);
    add_print_routes(*this);
    add_host_routes(*this);
    add_analysis_routes(*this);
    if (options.has_page) add_page_routes(*this);
}

SessionWork::SessionWork(ServerState& state, const HttpRequest& request, std::optional<JobStore::View> view) {
    const std::string session = request.text("session");
    cancel = view ? state.jobs.begin_view(session, *view) : state.jobs.work_of(session);
    control.threads = state.options.threads;
    control.cancel = cancel.get();
}

void serve_http(const ServerOptions& options, const CancelToken& cancel,
                const std::function<void(const std::string& address)>& on_ready) {
    ServerState state(options);
    std::atomic<bool> has_ended = false;
    std::thread watch([&] {
        while (!cancel.cancelled() && !has_ended) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (state.printer.is_printing() && options.on_delay)
            options.on_delay("stopping the print; wait until its heaters are off");
        state.printer.end();  // first, so that pages still see how it ends
        state.jobs.cancel_all();
        state.ahead.end();
        state.events.end();
        state.http.stop();
    });
    if (options.has_page && !options.recipe.empty()) show_ahead(state);
    const std::string host = options.http.address == "0.0.0.0" ? "127.0.0.1" : options.http.address;
    on_ready(fmt::format("http://{}:{}/?token={}", host, state.http.port(), options.http.token));
    state.http.serve();
    has_ended = true;
    watch.join();
}

}  // namespace lamella
