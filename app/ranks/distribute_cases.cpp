// Each case is one message to each other rank; as all ask in the same order, messages need no number.
#include "app/ranks/distribute_cases.h"

#include "app/ranks/rank_failure.h"
#include "app/ranks/wait_for.h"
#include "engine/base/archive.h"
#include "engine/base/error.h"

namespace lamella {
namespace {

/// The message with a case.
struct CaseParcel {
    void serialize(Archive& parcel) {
        parcel(solved.problem, solved.iterations, directions);
        if (parcel.unpacks()) solved.displacements.resize(directions);
        for (std::vector<double>& along : solved.displacements) parcel(along);
    }
    SolvedCase solved;
    std::uint8_t directions = 0;
};

}  // namespace

void DistributedCases::give(const SolvedCase& solved) {
    const std::string parcel =
        packed(CaseParcel{solved, static_cast<std::uint8_t>(solved.displacements.size())});
    for (int rank = 0; rank < searching_; ++rank) {
        if (rank != ranks_.rank()) ranks_.send(rank, case_tag, parcel);
    }
}

SolvedCase DistributedCases::take(std::size_t load_case, std::uint64_t problem) {
    const int from = solver_of(load_case);
    const auto bytes = wait_for(
        [&] {
            if (ranks_.rank() == 0) throw_failure(ranks_);
            return ranks_.receive(from, case_tag);
        },
        cancel_);
    SolvedCase solved = unpacked<CaseParcel>(*bytes).solved;
    if (solved.problem != problem)
        throw FaultError("its search came to another design than that of rank " + std::to_string(from));
    return solved;
}

}  // namespace lamella
