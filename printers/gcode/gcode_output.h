// Where the G-code of a job goes: a file that grows, or a machine at the other end of a line.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "printers/archive/job_stamp.h"

namespace lamella {

/// Takes a job's text from the front to the end, layer by layer, and knows where a run that was stopped goes
/// on. Called from one thread.
class GcodeOutput {
  public:
    virtual ~GcodeOutput() = default;
    /// Opens the output and returns the first missing layer. Throws InputError when the output belongs to
    /// another job or may not be replaced or continued; FaultError when it cannot be opened.
    virtual int begin(const JobStamp& stamp, bool resume) = 0;
    /// What the last complete layer (or the prologue) handed to `commit`, where begin goes on behind it; null
    /// where it begins anew.
    virtual nlohmann::ordered_json state() const = 0;
    /// What to throw when that state is not what was once handed over.
    virtual InputError damaged_state() const = 0;
    /// Takes the text of what lies before layer `next`, which is complete with it. `state` is what a run that
    /// continues here has to know.
    virtual void commit(std::string_view text, int next, const nlohmann::ordered_json& state) = 0;
    /// Takes the end of the job.
    virtual void end(std::string_view text) = 0;
};

/// A file of its own; `force` lets one of that name be replaced, and an unfinished one be discarded.
std::unique_ptr<GcodeOutput> make_gcode_file(const std::string& path, bool force);

}  // namespace lamella
