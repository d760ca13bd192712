// Analysis: a computation about a part's stiffness that a server runs in the background.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/cancel_token.h"

namespace lamella {

/// What is known of a computation as it goes on. Thread-safe.
class Analysis {
  public:
    enum class State : unsigned char { waiting, running, done, failed, cancelled };

    /// `kind`: "homogenize" or "optimize". `tell` gets a short description whenever there is news.
    Analysis(int number, std::string kind, std::function<void(const nlohmann::ordered_json&)> tell);

    int number() const { return number_; }
    CancelToken& cancel() { return cancel_; }
    State state() const;
    bool has_ended() const { return state() > State::running; }

    void begin();
    /// Takes the share of the work that is done, 0 to 1; told in steps of a percent.
    void set_share(double share);
    /// Takes a step of a search of at most `most` steps.
    void add_step(const nlohmann::ordered_json& step, int most);
    /// Whether a second has passed since the last design: designs that follow each other faster are not seen.
    bool wants_design() const;
    void set_design(std::string volume);
    /// Keeps what was found. It is the result even when the computation was cancelled.
    void set_result(nlohmann::ordered_json result);
    void end(State state, const std::string& message);

    /// Returns all that is known, with steps and result.
    nlohmann::ordered_json describe() const;
    /// Returns the newest design. Throws HttpError 404 before the first one.
    std::string design() const;

  private:
    nlohmann::ordered_json summary() const;  // with the mutex held
    /// Changes something under the mutex, then tells it.
    template <typename Change>
    void change(const Change& make);

    const int number_;
    const std::string kind_;
    const std::function<void(const nlohmann::ordered_json&)> tell_;
    CancelToken cancel_;
    mutable std::mutex mutex_;  // guards what follows
    State state_ = State::waiting;
    double share_ = 0;
    int most_steps_ = 0;
    nlohmann::ordered_json steps_ = nlohmann::ordered_json::array();
    nlohmann::ordered_json result_ = nullptr;
    std::string message_;
    std::string design_;
    int designs_ = 0;
    std::chrono::steady_clock::time_point designed_{};
};

}  // namespace lamella
