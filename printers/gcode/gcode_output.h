// GcodeOutput: destination of a job's G-code: a growing file, or a machine on a line.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "printers/archive/job_stamp.h"

namespace lamella {

/// Receives a job's text from front to end, layer by layer, and remembers where an interrupted run resumes.
/// Called from one thread.
class GcodeOutput {
  public:
    virtual ~GcodeOutput() = default;
    /// Opens the output and returns the first missing layer. Throws InputError if the output belongs to
    /// another job or may not be replaced or resumed; FaultError if it cannot be opened.
    virtual int begin(const JobStamp& stamp, bool resume) = 0;
    /// Returns the state that the last complete layer (or the prologue) passed to `commit`, if begin resumes
    /// after it; null if begin starts anew.
    virtual nlohmann::ordered_json state() const = 0;
    /// Returns the error for a state whose content is invalid.
    virtual InputError damaged_state() const = 0;
    /// Takes a part of the job that an earlier run has sent, before the first call of `commit`: lines keep
    /// their numbers. `seconds` is its time of motion.
    virtual void skip(std::string_view /*text*/, double /*seconds*/) {}
    /// Tells the time of motion of all that will be passed to `commit`, s, if it is known beforehand.
    virtual void expect(double /*seconds*/) {}
    /// Appends the text of everything before layer `next`. `state` holds what a run resumed here must know.
    virtual void commit(std::string_view text, int next, const nlohmann::ordered_json& state) = 0;
    /// Appends the end of the job.
    virtual void end(std::string_view text) = 0;
};

/// Makes an output to a file. `force` allows a file of that name to be replaced, and an unfinished one to be
/// discarded.
std::unique_ptr<GcodeOutput> make_gcode_file(const std::string& path, bool force);

}  // namespace lamella
