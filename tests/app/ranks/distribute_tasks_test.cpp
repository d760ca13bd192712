// Tasks over several ranks: each is done once, by whoever is free, and what fails is told.
#include "app/ranks/distribute_tasks.h"

#include <array>
#include <catch2/catch.hpp>

#include "app/ranks/rank_failure.h"
#include "engine/base/error.h"
#include "tests/app/ranks/ranks_inside.h"

namespace distribute_tasks_test {

using namespace lamella;

namespace {

/// Ranks of one process that help with tasks, each in a thread; joined when this goes.
class Helpers {
  public:
    Helpers(Post& post, int size, const DoTask& task, const std::string& identity = "work") {
        for (int rank = 1; rank < size; ++rank) {
            threads_.emplace_back([&post, rank, size, task, identity] {
                RanksInside ranks(post, rank, size);
                tell_failures(ranks, [&] { help_with_tasks(ranks, identity, task, nullptr); });
            });
        }
    }

  private:
    std::vector<std::jthread> threads_;
};

std::string square(std::size_t task) { return std::to_string(task * task); }

}  // namespace

TEST_CASE("tasks come to the same by any number of ranks, and none is done twice", "[ranks]") {
    constexpr std::size_t count = 200;
    for (const int size : {1, 2, 5}) {
        std::array<std::atomic<int>, count> done{};
        const auto task = [&](std::size_t i) {
            ++done[i];
            std::this_thread::sleep_for(std::chrono::microseconds(i % 7 * 300));
            return square(i);
        };
        Post post;
        const Helpers helpers(post, size, task);
        RanksInside first(post, 0, size);
        DistributedTasks tasks(&first, count, "work", task, nullptr);
        for (std::size_t i = 0; i < count; ++i) CHECK(tasks.result(i) == square(i));
        tasks.finish();
        for (const auto& times : done) CHECK(times == 1);
    }
}

TEST_CASE("a rank that is busy leaves tasks to the others", "[ranks]") {
    constexpr std::size_t count = 40;
    std::atomic<int> helped{0};
    const auto slow = [](std::size_t i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        return square(i);
    };
    Post post;
    const Helpers helpers(post, 2, [&](std::size_t i) { return ++helped, square(i); });
    RanksInside first(post, 0, 2);
    DistributedTasks tasks(&first, count, "work", slow, nullptr);
    for (std::size_t i = 0; i < count; ++i) CHECK(tasks.result(i) == square(i));
    tasks.finish();
    CHECK(helped > 20);
}

TEST_CASE("a process on its own does tasks in their order", "[ranks]") {
    std::vector<std::size_t> order;
    DistributedTasks tasks(
        nullptr, 4, "work", [&](std::size_t i) { return order.push_back(i), square(i); }, nullptr);
    CHECK(tasks.result(2) == "4");
    CHECK(order == std::vector<std::size_t>{0, 1, 2});
    CHECK_FALSE(tasks.is_done(3));
    CHECK(tasks.result(0) == "0");
    CHECK(tasks.result(3) == "9");
    CHECK(order.size() == 4);
    tasks.finish();
}

TEST_CASE("a task that fails elsewhere fails the run with its words and its exit code", "[ranks]") {
    const auto outcome = [](const DoTask& task, const std::string& identity) {
        Post post;
        const Helpers helpers(post, 3, task, identity);
        RanksInside first(post, 0, 3);
        const auto slow = [](std::size_t i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            return square(i);
        };
        try {
            DistributedTasks tasks(&first, 50, "work", slow, nullptr);
            for (std::size_t i = 0; i < 50; ++i) tasks.result(i);
            tasks.finish();
        } catch (const Error& error) {
            // The other helper asks on, which an abort ends in earnest.
            DistributedTasks last(&first, 0, identity, slow, nullptr);
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            return std::pair(error.exit_code(), std::string(error.what()));
        }
        return std::pair(0, std::string());
    };
    const auto failing = [](std::size_t i) -> std::string {
        if (i > 20) throw FaultError("no memory for a sample");
        return square(i);
    };
    const auto [code, words] = outcome(failing, "work");
    CHECK(code == 3);
    CHECK_THAT(words, Catch::StartsWith("rank ") && Catch::EndsWith(": no memory for a sample"));
    const auto wrong = [](std::size_t) -> std::string { throw InputError("no foam"); };
    CHECK(outcome(wrong, "work").first == 2);
    CHECK(outcome(square, "work").first == 0);
    const auto [other_code, other_words] = outcome(square, "other work");
    CHECK(other_code == 2);
    CHECK_THAT(other_words, Catch::Contains("its work differs from that of rank 0"));
}

TEST_CASE("who waits for tasks of others can be stopped", "[ranks]") {
    Post post;
    RanksInside first(post, 0, 2), second(post, 1, 2);
    CancelToken cancel;
    second.send(0, ask_tag, "");
    DistributedTasks tasks(&first, 1, "work", square, &cancel);
    // The only task goes to a rank that never answers.
    while (!second.receive(0, task_tag)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    cancel.cancel();
    CHECK_THROWS_AS(tasks.result(0), Interrupted);
}

}  // namespace distribute_tasks_test
