// A rank asks, gets a task's number, and sends the result.
#include "app/ranks/distribute_tasks.h"

#include <algorithm>

#include "app/ranks/rank_failure.h"
#include "app/ranks/wait_for.h"
#include "engine/base/archive.h"

namespace lamella {
namespace {

/// The reply of rank 0 to a request.
struct Order {
    void serialize(Archive& parcel) { parcel(task, count, identity); }
    std::uint64_t task = 0, count = 0;  ///< equal when no task is left
    std::string identity;
};

/// The message to rank 0 with a result.
struct Result {
    void serialize(Archive& parcel) { parcel(task, bytes); }
    std::uint64_t task = 0;
    std::string bytes;
};

}  // namespace

DistributedTasks::DistributedTasks(Ranks* ranks, std::size_t count, std::string identity, DoTask task,
                                   const CancelToken* cancel)
    : ranks_(ranks),
      identity_(std::move(identity)),
      task_(std::move(task)),
      cancel_(cancel),
      results_(count) {
    if (ranks_ != nullptr) desk_ = std::jthread([this](const std::stop_token& stop) { hand_out(stop); });
}

void DistributedTasks::hand_out(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        for (int rank = 1; rank < ranks_->size(); ++rank) {
            if (!ranks_->receive(rank, ask_tag)) continue;
            const std::size_t task = std::min(next_++, results_.size());
            ranks_->send(rank, task_tag, packed(Order{task, results_.size(), identity_}));
            if (task == results_.size()) ++sent_home_;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
}

void DistributedTasks::collect() {
    if (ranks_ == nullptr) return;
    throw_failure(*ranks_);
    for (int rank = 1; rank < ranks_->size(); ++rank) {
        while (auto bytes = ranks_->receive(rank, result_tag)) {
            Result result = unpacked<Result>(std::move(*bytes));
            if (result.task >= results_.size())
                throw FaultError("a rank has sent the result of an unknown task");
            results_[static_cast<std::size_t>(result.task)] = std::move(result.bytes);
        }
    }
}

const std::string& DistributedTasks::result(std::size_t task) {
    while (!results_[task]) {
        if (const std::size_t mine = next_++; mine < results_.size()) {
            results_[mine] = task_(mine);
            collect();
            continue;
        }
        wait_for([&] { return collect(), is_done(task); }, cancel_);
    }
    return *results_[task];
}

void DistributedTasks::finish() {
    if (ranks_ == nullptr) return;
    wait_for([&] { return collect(), sent_home_ + 1 == ranks_->size(); }, cancel_);
}

void help_with_tasks(Ranks& ranks, const std::string& identity, const DoTask& task,
                     const CancelToken* cancel) {
    for (;;) {
        ranks.send(0, ask_tag, "");
        const auto told = wait_for([&] { return ranks.receive(0, task_tag); }, cancel);
        const Order order = unpacked<Order>(*told);
        if (order.identity != identity)
            throw InputError(
                "its work differs from that of rank 0; accepted: the same recipe and files for all ranks");
        if (order.task == order.count) return;
        ranks.send(0, result_tag, packed(Result{order.task, task(static_cast<std::size_t>(order.task))}));
    }
}

}  // namespace lamella
