// DisjointSets: union-find with path halving.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace lamella {

/// Elements are numbered from 0; each is a set of its own until sets are joined. The lowest number in a set
/// represents it, so that representatives are in order of first appearance.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count = 0) : parents_(count) {
        std::iota(parents_.begin(), parents_.end(), 0U);
    }

    std::size_t size() const { return parents_.size(); }
    /// Adds an element; returns its number.
    std::uint32_t add() {
        parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
        return parents_.back();
    }
    /// Returns the representative of the element's set. Halves the path to it.
    std::uint32_t find(std::uint32_t i) {
        while (parents_[i] != i) {
            parents_[i] = parents_[parents_[i]];
            i = parents_[i];
        }
        return i;
    }
    /// Joins the sets of two elements; returns false if they were one set already.
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
