// A record behind a mutex; news is told outside it.
#include "app/jobs/analysis.h"

#include <algorithm>
#include <array>
#include <utility>

#include "app/http/http_server.h"

namespace lamella {

using Json = nlohmann::ordered_json;

Analysis::Analysis(int number, std::string kind, std::function<void(const Json&)> tell)
    : number_(number), kind_(std::move(kind)), tell_(std::move(tell)) {}

template <typename Change>
void Analysis::change(const Change& make) {
    Json news;
    {
        const std::lock_guard lock(mutex_);
        make();
        news = summary();
    }
    tell_(news);
}

Analysis::State Analysis::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void Analysis::begin() {
    change([&] { state_ = State::running; });
}

void Analysis::set_share(double share) {
    constexpr double percent = 0.01;
    {
        const std::lock_guard lock(mutex_);
        if (share < share_ + percent) return;
    }
    change([&] { share_ = std::min(share, 1.0); });
}

void Analysis::add_step(const Json& step, int most) {
    change([&] {
        steps_.push_back(step);
        most_steps_ = std::max(most, static_cast<int>(steps_.size()));
        share_ = static_cast<double>(steps_.size()) / most_steps_;
    });
}

bool Analysis::wants_design() const {
    constexpr std::chrono::seconds least(1);
    const std::lock_guard lock(mutex_);
    return designs_ == 0 || std::chrono::steady_clock::now() - designed_ >= least;
}

void Analysis::set_design(std::string volume) {
    change([&] {
        design_ = std::move(volume);
        ++designs_;
        designed_ = std::chrono::steady_clock::now();
    });
}

void Analysis::set_result(Json result) {
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
}

void Analysis::end(State state, const std::string& message) {
    change([&] {
        state_ = state;
        message_ = message;
        if (state == State::done) share_ = 1;
    });
}

Json Analysis::summary() const {
    constexpr std::array names{"waiting", "running", "done", "failed", "cancelled"};
    return {{"analysis", number_},
            {"kind", kind_},
            {"state", names[static_cast<std::size_t>(state_)]},
            {"share", share_},
            {"count", steps_.size()},
            {"most", most_steps_},
            {"step", steps_.empty() ? Json(nullptr) : steps_.back()},
            {"designs", designs_},
            {"message", message_}};
}

Json Analysis::describe() const {
    const std::lock_guard lock(mutex_);
    Json all = summary();
    all["steps"] = steps_;
    all["result"] = result_;
    return all;
}

std::string Analysis::design() const {
    const std::lock_guard lock(mutex_);
    if (design_.empty()) throw HttpError(404, "this analysis has no design, or none yet");
    return design_;
}

}  // namespace lamella
