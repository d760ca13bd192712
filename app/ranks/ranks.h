// Ranks: the processes of one run that share its work, on one machine or several.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace lamella {

/// Communication between processes started together. Thread-safe.
class Ranks {
  public:
    Ranks() = default;
    virtual ~Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    virtual int rank() const = 0;  ///< of this process, from 0
    virtual int size() const = 0;
    /// Sends bytes with a RankTag without waiting for their arrival; messages arrive in the order of sending.
    virtual void send(int to, int tag, std::string bytes) = 0;
    /// Returns the next message from a rank with a tag, if one has arrived.
    virtual std::optional<std::string> receive(int from, int tag) = 0;
    /// Returns the number of messages sent by this process that have not been received yet.
    virtual std::size_t outstanding() = 0;
    /// Ends all processes, including this one, with an exit code.
    [[noreturn]] virtual void abort(int code) = 0;
};

/// Tags of messages, by their content.
enum RankTag : int {
    begin_tag = 1,  ///< start of layers: the first layer and the job
    failure_tag,    ///< a rank has failed, with the reason
    ask_tag,        ///< a free rank asks for a task
    task_tag,       ///< its next task
    result_tag,     ///< the result of a task
    turn_tag,       ///< assignment of the next layers
    case_tag,       ///< displacements of a load case
    first_layer_tag = 16
};

/// Returns the ranks with which mpirun started this process; null when it runs alone. Throws FaultError when
/// they cannot be reached, for example because this program was built without MPI.
std::unique_ptr<Ranks> started_ranks();

/// The function that the MPI module exports as lamella_make_ranks.
using MakeRanksFunction = Ranks* (*)();

}  // namespace lamella
