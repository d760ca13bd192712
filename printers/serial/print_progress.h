// PrintProgress: the share of a job that is printed and the time it still takes, by the motion model.
#pragma once

#include <optional>

namespace lamella {

/// What is known of a job's length, and how far it is. Times are of motion alone, in s: heating, homing,
/// pauses and waits are none of them.
struct PrintProgress {
    int layers = 0;             ///< layers of the job, or parts of a ready file
    int layers_before = 0;      ///< of those: done in earlier runs
    int layers_known = 0;       ///< of those: computed in this run so far
    double layers_seconds = 0;  ///< model time of the computed layers
    double known_seconds = 0;   ///< model time of all that was computed in this run, layers and the rest
    double done_seconds = 0;    ///< model time of the lines that are answered in this run
    double printing = 0;        ///< measured time in which those were printed
    /// Model times that a ready file tells beforehand: of its parts done in earlier runs, and of the rest.
    std::optional<double> seconds_before{}, seconds_ahead{};

    /// Returns the time that the lines not yet answered take, computed or not, s. Nothing while no layer is
    /// known. Layers that are not computed yet are taken to be as long as the mean of the known ones. The
    /// pace measured so far corrects the model, the more the longer it was measured.
    std::optional<double> left() const;
    /// Returns the printed share of the job's motion, 0 to 1, earlier runs included.
    std::optional<double> share() const;

  private:
    /// Model time of this run.
    std::optional<double> total() const;
};

}  // namespace lamella
