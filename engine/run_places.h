// RunPlaces: where in a layer's runs something was found, run by run.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/runs.h"

namespace lamella {

/// For each run of a layer whether it was searched, and what was found in it: sorted stretches of it.
class RunPlaces {
  public:
    explicit RunPlaces(const SpanRows& rows)
        : of_runs_(rows.runs().size(), not_searched),
          in_line_(rows.lines(), 0),
          to_search_(rows.runs().size()) {}

    bool all_searched() const { return to_search_ == 0; }
    bool is_searched(std::size_t run) const { return of_runs_[run] != not_searched; }
    /// For a run that was not searched, on that line.
    void put(std::size_t run, std::size_t line, std::span<const Run> found) {
        of_runs_[run] = static_cast<std::uint32_t>(ends_.size()) - 1;
        found_.insert(found_.end(), found.begin(), found.end());
        ends_.push_back(static_cast<std::uint32_t>(found_.size()));
        in_line_[line] += static_cast<std::uint32_t>(found.size());
        --to_search_;
    }
    /// For one that was.
    std::span<const Run> in(std::size_t run) const {
        const std::uint32_t begin = ends_[of_runs_[run]], end = ends_[of_runs_[run] + 1];
        return {found_.data() + begin, end - begin};
    }
    bool any_in_line(std::size_t line) const { return in_line_[line] > 0; }

  private:
    static constexpr std::uint32_t not_searched = UINT32_MAX;
    std::vector<std::uint32_t> of_runs_;  // which search it was
    std::vector<std::uint32_t> ends_{0};  // of what each search found, in found_
    std::vector<Run> found_;
    std::vector<std::uint32_t> in_line_;  // how much
    std::size_t to_search_;
};

}  // namespace lamella
