// Keeps the jobs used last, and one build a session.
#include "app/jobs/job_store.h"

#include <algorithm>
#include <chrono>

#include "app/http/http_server.h"
#include "recipe/build/support_plan.h"
#include "recipe/structure/optimize_part.h"

namespace lamella {

namespace {

/// Without a folder for plans no search would ever be kept: then the build does it.
void check_is_searched(const Recipe& recipe) {
    const std::filesystem::path plans = default_plan_folder();
    if (!recipe.optimize || plans.empty() || has_optimized(first_piece(recipe), plans)) return;
    throw HttpError(428, "the part has to be optimised first; accepted: POST its recipe to /api/optimize");
}

}  // namespace

void JobStore::Build::end_work() {
    work->cancel();
    work = std::make_shared<CancelToken>();
    for (const auto& [view, looking] : views) looking->cancel();
    views.clear();
}

std::shared_ptr<CancelToken> JobStore::begin(const std::string& session, std::int64_t sequence) {
    constexpr std::size_t most_sessions = 64;
    const std::lock_guard lock(mutex_);
    if (builds_.size() >= most_sessions && !builds_.contains(session))
        std::erase_if(builds_, [](const auto& item) { return item.second.cancel.use_count() == 1; });
    if (builds_.size() >= most_sessions && !builds_.contains(session))
        throw HttpError(503, "too many sessions build at once");
    Build& build = builds_[session];
    if (build.cancel && sequence < build.sequence) throw Interrupted("a newer recipe of this session came");
    if (build.cancel) build.cancel->cancel();
    build.sequence = sequence;
    build.cancel = std::make_shared<CancelToken>();
    if (!build.work) build.work = std::make_shared<CancelToken>();
    return build.cancel;
}

/// Ends what is computed of the jobs before the one of a build.
void JobStore::end_work(const std::string& session, std::int64_t sequence) {
    const std::lock_guard lock(mutex_);
    const auto found = builds_.find(session);
    if (found == builds_.end() || found->second.sequence != sequence) return;
    found->second.end_work();
}

void JobStore::end_session(const std::string& session) {
    const std::lock_guard lock(mutex_);
    const auto found = builds_.find(session);
    if (found == builds_.end()) return;
    found->second.cancel->cancel();
    found->second.end_work();
    builds_.erase(found);
}

std::shared_ptr<CancelToken> JobStore::work_of(const std::string& session) {
    const std::lock_guard lock(mutex_);
    const auto found = builds_.find(session);
    return found == builds_.end() ? nullptr : found->second.work;
}

std::shared_ptr<CancelToken> JobStore::begin_view(const std::string& session, View view) {
    const std::lock_guard lock(mutex_);
    const auto found = builds_.find(session);
    if (found == builds_.end()) return nullptr;
    std::shared_ptr<CancelToken>& cancel = found->second.views[view];
    if (cancel) cancel->cancel();
    cancel = std::make_shared<CancelToken>();
    return cancel;
}

std::shared_ptr<const ServedJob> JobStore::held(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(jobs_, id, [](const auto& job) { return job->id; });
    if (found == jobs_.end()) return nullptr;
    jobs_.splice(jobs_.begin(), jobs_, found);
    return jobs_.front();
}

void JobStore::hold(std::shared_ptr<const ServedJob> job) {
    const std::lock_guard lock(mutex_);
    std::erase_if(jobs_, [&](const auto& other) { return other->id == job->id; });
    jobs_.push_front(std::move(job));
    if (jobs_.size() > most_) jobs_.pop_back();
}

std::shared_ptr<const ServedJob> JobStore::build(const std::string& text, const std::string& session,
                                                 std::int64_t sequence, bool searches) {
    const std::shared_ptr<CancelToken> cancel = begin(session, sequence);
    const Recipe recipe = read_served_recipe(text, folder_);
    end_work(session, sequence);  // of a recipe with mistakes the page shows the job before
    const std::string id = served_job_id(recipe, text, &inputs_);
    wait_for_ahead(id, *cancel);
    if (auto job = held(id)) return job;
    if (!searches) check_is_searched(recipe);
    auto job = build_served_job(text, folder_, control(*cancel, session));
    stop_if_cancelled(cancel.get());
    hold(job);
    return job;
}

BuildControl JobStore::control(const CancelToken& cancel, const std::string& session) {
    BuildControl control;
    control.threads = threads_;
    control.cancel = &cancel;
    control.inputs = &inputs_;
    control.on_progress = [this, session](const std::string& what, std::int64_t done, std::int64_t of) {
        events_.send(session, "progress",
                     {{"what", "build"}, {"id", nullptr}, {"done", done}, {"of", of}, {"text", what}});
    };
    return control;
}

std::shared_ptr<const ServedJob> JobStore::build_ahead(const std::string& text, const std::string& session,
                                                       const std::shared_ptr<CancelToken>& cancel) {
    std::shared_ptr<const ServedJob> job;
    try {
        const Recipe recipe = read_served_recipe(text, folder_);
        check_is_searched(recipe);
        const std::string id = served_job_id(recipe, text, &inputs_);
        {
            const std::lock_guard lock(mutex_);
            ahead_ = id;
            ahead_cancel_ = cancel;
        }
        job = held(id);
        if (job) stop_if_cancelled(cancel.get());
        if (!job) job = build_served_job(text, folder_, control(*cancel, session));
        hold(job);
    } catch (const std::exception&) {  // told to whoever asks for the job
    }
    const std::lock_guard lock(mutex_);
    ahead_.clear();
    ahead_ended_.notify_all();
    return job;
}

void JobStore::wait_for_ahead(const std::string& id, const CancelToken& cancel) {
    constexpr std::chrono::milliseconds look{20};
    std::unique_lock lock(mutex_);
    if (!ahead_.empty() && ahead_ != id) ahead_cancel_->cancel();
    while (ahead_ == id && !cancel.cancelled()) ahead_ended_.wait_for(lock, look);
}

std::shared_ptr<const ServedJob> JobStore::find(const std::string& id) {
    if (auto job = held(id)) return job;
    throw HttpError(404, "this job is not held, or not any more; accepted: POST its recipe to /api/jobs");
}

void JobStore::forget(const std::string& id) {
    find(id);
    const std::lock_guard lock(mutex_);
    std::erase_if(jobs_, [&](const auto& job) { return job->id == id; });
}

void JobStore::cancel_all() {
    const std::lock_guard lock(mutex_);
    if (ahead_cancel_) ahead_cancel_->cancel();
    for (auto& [session, build] : builds_) {
        build.cancel->cancel();
        build.end_work();
    }
}

}  // namespace lamella
