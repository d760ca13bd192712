// LayerCheck: the interface of a print check, and the sampled layer that it is given.
#pragma once

#include <functional>
#include <optional>

#include "engine/checks/fault_list.h"
#include "engine/morphology/row_bitmask.h"

namespace lamella {

/// The rows of a layer that the next layers are compared with.
struct LayerFootprint {
    RunRows part;
    RunRows supports;            ///< empty rows if there are no supports
    RunRows part_with_supports;  ///< the union of both; without lines if there are no supports

    const RunRows& printed() const { return supports.runs().empty() ? part : part_with_supports; }
};

/// Returns the printed solid of a layer, part and supports, in the rows of any band.
using RowsIn = std::function<RunRows(const RowBand&)>;

/// A layer as checks see it: sampled in rows. Labels and cells are there if the row of a check asks for them
/// (CheckPass).
struct LayerSample {
    int index = 0;
    LayerFootprint rows;
    LabelledLayer part;                ///< rows.part, labelled without growth
    LabelledLayer part_with_supports;  ///< the union, labelled; without rows if there are no supports
    std::optional<LayerCells> cells;   ///< of the part, on one lattice for all layers
    RowsIn rows_in;

    const LabelledLayer& printed() const {
        return part_with_supports.starts.empty() ? part : part_with_supports;
    }
};

/// The result of LayerCheck::prepare, for `add` of the same check.
struct PreparedRows {
    RunRows rows;
    LabelledLayer labels;
    void serialize(Archive& parcel) { parcel(rows, labels); }
};

/// Finds faults of one or several kinds in layers that stream by, from the lowest on.
///
///     class TopCheck : public LayerCheck {  // reports the highest layer that holds any of the part
///         void add(LayerSample& layer, PreparedRows) override {
///             if (!layer.rows.part.runs().empty()) top_.layer = layer.index;
///         }
///         void finish() override { faults_.add(top_); }
///         const FaultList& faults(Check) const override { return faults_; }
///         Fault top_;
///         FaultList faults_{1};
///     };
class LayerCheck {
  public:
    virtual ~LayerCheck() = default;
    /// Returns how far the check dilates the cells of a layer, run units; empty: it reads no cells.
    virtual std::optional<double> cell_reach() const { return {}; }
    /// Computes rows that one layer alone decides. Thread-safe, pure, called for several layers at once.
    virtual PreparedRows prepare(const LayerSample& /*layer*/) const { return {}; }
    /// Whether rows that another process prepared belong to this check, for layers of so many lines.
    virtual bool accepts(const PreparedRows& prepared, std::size_t /*lines*/) const {
        return prepared.rows.runs().empty() && prepared.labels.runs.empty();
    }
    /// Compares a layer with those before; layers come in ascending order. May move out of `layer` what no
    /// later check of check_passes() reads.
    virtual void add(LayerSample& layer, PreparedRows prepared) = 0;
    /// Ends the check after the last layer.
    virtual void finish() {}
    /// Returns the faults of a kind, once finished.
    virtual const FaultList& faults(Check check) const = 0;
    /// Adds to a report what is no fault, once finished.
    virtual void complete(CheckReport& /*report*/) const {}
};

}  // namespace lamella
