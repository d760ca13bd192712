// ProgressDisplay: the progress of a run, as a bar on a terminal and as lines at intervals otherwise.
#pragma once

#include <chrono>
#include <string>

#include "engine/layers/layer_stream.h"

namespace lamella {

/// Writes to standard error. Call from one thread.
class ProgressDisplay {
  public:
    /// Shows nothing when quiet; `what` names the work at the front of every line.
    explicit ProgressDisplay(bool quiet, std::string what = "");
    ~ProgressDisplay() { finish(); }
    ProgressDisplay(const ProgressDisplay&) = delete;
    ProgressDisplay& operator=(const ProgressDisplay&) = delete;

    void show(const Progress& progress);
    /// Shows the progress of other work than layers: the finished share, 0 to 1.
    void show(double share);
    /// Ends the bar's line.
    void finish();
    /// Returns the time from construction to the first layer; 0 before it.
    double first_layer_seconds() const { return first_layer_; }
    double seconds() const;

  private:
    bool is_due(bool last, double now);
    void draw(double share, const std::string& text);

    bool quiet_;
    std::string what_;
    bool terminal_;
    bool line_open_ = false;
    std::chrono::steady_clock::time_point start_;
    double first_layer_ = 0;
    double last_shown_ = 0;
};

/// Returns "45 %  90/200 layers  12.5 layers/s  0:09 left".
std::string progress_text(const Progress& progress, double seconds);

}  // namespace lamella
