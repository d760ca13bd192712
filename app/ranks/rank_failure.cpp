// Failures are messages with an exit code and a text.
#include "app/ranks/rank_failure.h"

#include "engine/base/archive.h"
#include "engine/base/error.h"

namespace lamella {
namespace {

void broadcast(Ranks& ranks, int exit_code, const std::string& what) {
    std::string words = "rank " + std::to_string(ranks.rank()) + ": " + what;
    Archive parcel;
    parcel(exit_code, words);
    ranks.send(0, failure_tag, parcel.bytes());
}

}  // namespace

void tell_failures(Ranks& ranks, const std::function<void()>& work) {
    try {
        work();
    } catch (const Interrupted&) {
        throw;
    } catch (const Error& error) {
        broadcast(ranks, error.exit_code(), error.what());
    } catch (const std::exception& error) {
        broadcast(ranks, FaultError("").exit_code(), error.what());
    }
}

void throw_failure(Ranks& ranks) {
    for (int rank = 1; rank < ranks.size(); ++rank) {
        const auto told = ranks.receive(rank, failure_tag);
        if (!told) continue;
        Archive parcel(*told);
        int exit_code = 0;
        std::string words;
        parcel(exit_code, words);
        if (exit_code == InputError("").exit_code()) throw InputError(words);
        if (exit_code == ConstraintError("").exit_code()) throw ConstraintError(words);
        throw FaultError(words);
    }
}

}  // namespace lamella
