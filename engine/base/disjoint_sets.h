// DisjointSets: which of many things belong together (union-find).
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace lamella {

/// Things numbered from 0 on, each in a set of its own until sets are joined. A set goes by its lowest
/// number, so that numbers tell what came first.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count = 0) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    std::size_t size() const { return parents_.size(); }
    /// One thing more; returns its number.
    std::uint32_t add() {
        parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
        return parents_.back();
    }
    /// The number of the set that holds a thing. Shortens the way to it.
    std::uint32_t find(std::uint32_t i) {
        while (parents_[i] != i) {
            parents_[i] = parents_[parents_[i]];
            i = parents_[i];
        }
        return i;
    }
    /// Joins the sets of two things; false where they are one already.
    bool join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return false;
        parents_[a < b ? b : a] = a < b ? a : b;
        return true;
    }

  private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace lamella
