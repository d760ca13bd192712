// PieceCheck: pieces that are not joined to the rest of the part.
#pragma once

#include "engine/checks/check_table.h"
#include "engine/checks/streaming_faults.h"

namespace lamella {

/// Finds every connected component of the part but the largest and those below the limit.
class PieceCheck : public LayerCheck {
  public:
    explicit PieceCheck(const CheckContext& context) : pieces_(context.grid, 0, context.max_faults) {
        pieces_.ignore_below(context.limits.piece);
    }
    void add(LayerSample& layer, PreparedRows /*prepared*/) override {
        pieces_.add(std::move(layer.part), layer.index);
    }
    void finish() override {
        pieces_.finish();
        pieces_.excuse_greatest();  // the part itself
    }
    const FaultList& faults(Check /*check*/) const override { return pieces_.faults(); }

  private:
    StreamingFaults pieces_;
};

}  // namespace lamella
