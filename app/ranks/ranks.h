// Ranks: the processes of one run that share its layers, on one machine or several.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace lamella {

/// What processes started together can do. Thread-safe.
class Ranks {
  public:
    Ranks() = default;
    virtual ~Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    virtual int rank() const = 0;  ///< this process, from 0
    virtual int size() const = 0;
    /// Sends bytes with a RankTag; they are on their way when this returns, and arrive in the order of
    /// sending.
    virtual void send(int to, int tag, std::string bytes) = 0;
    /// What has come from a rank with a tag, if anything has.
    virtual std::optional<std::string> receive(int from, int tag) = 0;
    /// How many messages of this process have not been taken yet.
    virtual std::size_t outstanding() = 0;
    /// Ends all processes, this one included, with an exit code.
    [[noreturn]] virtual void abort(int code) = 0;
};

/// Tags of messages, by what they say.
enum RankTag : int {
    begin_tag = 1,  ///< layers are to be made, from which on, and of which job
    failure_tag,    ///< a rank has failed, and why
    ask_tag,        ///< a rank is free for a task
    task_tag,       ///< what it is to do
    result_tag,     ///< what came of it
    turn_tag,       ///< who makes which of the next layers
    first_layer_tag = 16
};

/// The ranks that mpirun started this process with; null when it runs alone. Throws FaultError where they
/// cannot be reached, as when this program was built without MPI.
std::unique_ptr<Ranks> started_ranks();

/// What the module for MPI exports, by the name lamella_make_ranks.
using MakeRanksFunction = Ranks* (*)();

}  // namespace lamella
