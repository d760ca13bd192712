// Solves are tasks; results are sent as archives.
#include "app/ranks/distribute_solves.h"

#include "engine/base/archive.h"
#include "recipe/identity.h"

namespace lamella {

DistributedSolves::DistributedSolves(Ranks* ranks, const Recipe& recipe,
                                     const std::vector<StiffnessSolve>& solves,
                                     const StiffnessOptions& options)
    : solves_(solves),
      tasks_(
          ranks, solves.size(), job_identity(recipe),
          [this, &recipe, options](std::size_t task) {
              own_ = task;
              StiffnessOptions mine = options;
              mine.on_progress = [this](double share) {
                  own_share_ = share;
                  tasks_.collect();
                  tell_progress();
              };
              return packed(solve_sample(recipe, solves_[task], mine));
          },
          options.cancel) {}

void DistributedSolves::tell_progress() {
    double whole = 0, done = 0;
    for (std::size_t i = from_; i < to_; ++i) {
        whole += solves_[i].work;
        done += solves_[i].work * (tasks_.is_done(i) ? 1 : i == own_ ? own_share_ : 0);
    }
    if (done < whole) show_(done / whole);
}

std::vector<SolvedSample> DistributedSolves::next(std::size_t count,
                                                  const std::function<void(double share)>& show) {
    from_ = to_;
    to_ += count;
    show_ = show;
    std::vector<SolvedSample> solved;
    for (std::size_t i = from_; i < to_; ++i) {
        solved.push_back(unpacked<SolvedSample>(tasks_.result(i)));
        tell_progress();
    }
    show_(1);
    return solved;
}

void help_with_solves(Ranks& ranks, const Recipe& recipe, const std::vector<StiffnessSolve>& solves,
                      const StiffnessOptions& options) {
    const auto solve = [&](std::size_t task) {
        return packed(solve_sample(recipe, solves.at(task), options));
    };
    help_with_tasks(ranks, job_identity(recipe), solve, options.cancel);
}

}  // namespace lamella
