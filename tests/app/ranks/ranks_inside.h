// Ranks that are threads of one process, for tests.
#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <tuple>

#include "app/ranks/ranks.h"

namespace lamella {

/// What several ranks of one process have sent each other.
struct Post {
    std::mutex access;
    std::map<std::tuple<int, int, int>, std::deque<std::string>> sent;  ///< by from, to, tag
    std::map<int, std::size_t> outstanding;                             ///< by from
    std::size_t max_outstanding = 0;
};

class RanksInside : public Ranks {
  public:
    RanksInside(Post& post, int rank, int size) : post_(post), rank_(rank), size_(size) {}
    int rank() const override { return rank_; }
    int size() const override { return size_; }
    void send(int to, int tag, std::string bytes) override {
        const std::lock_guard lock(post_.access);
        post_.sent[{rank_, to, tag}].push_back(std::move(bytes));
        const std::size_t now = ++post_.outstanding[rank_];
        if (rank_ > 0) post_.max_outstanding = std::max(post_.max_outstanding, now);
    }
    std::optional<std::string> receive(int from, int tag) override {
        const std::lock_guard lock(post_.access);
        const auto found = post_.sent.find({from, rank_, tag});
        if (found == post_.sent.end() || found->second.empty()) return std::nullopt;
        std::string bytes = std::move(found->second.front());
        found->second.pop_front();
        --post_.outstanding[from];
        return bytes;
    }
    std::size_t outstanding() override {
        const std::lock_guard lock(post_.access);
        return post_.outstanding[rank_];
    }
    [[noreturn]] void abort(int code) override { throw std::runtime_error(std::to_string(code)); }

  private:
    Post& post_;
    int rank_, size_;
};

}  // namespace lamella
