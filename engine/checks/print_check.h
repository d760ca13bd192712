// The print check: one streaming pass over a job's layers that finds what a process cannot make.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/checks/layer_curve.h"
#include "engine/checks/print_limits.h"
#include "engine/layers/layer_stream.h"
#include "engine/runs/run_components.h"

namespace lamella {

/// A fault and where it is.
struct Fault {
    dvec3 at{0};    ///< a point of it in its largest layer, mm, in the part's coordinates
    int layer = 0;  ///< that layer
    int first_layer = 0, end_layer = 0;  ///< [first_layer, end_layer): all of its layers
    double size = 0;                     ///< see Check
    Box box;                             ///< encloses it, mm
    std::vector<PlacedRun> runs;         ///< of its largest layer, the first of them where it has very many
};

/// What was found of one kind.
struct CheckResult {
    Check check = Check::connectivity;
    Severity verdict = Severity::off;  ///< what a fault of it comes to
    double limit = 0;          ///< what sizes or thicknesses were held against, mm, mm^2 or mm^3; 0: none
    std::size_t count = 0;     ///< faults
    double total = 0;          ///< of their sizes
    std::vector<Fault> worst;  ///< by falling size; of equals the lowest first

    bool passed() const { return count == 0; }
};

/// What layers pull at while they are peeled off the vat's film (PeelCheck).
struct PeelCurve {
    LayerCurve area;  ///< of the layer, mm^2
    LayerCurve load;  ///< of the section that is stressed most: area pulled over area of the section
};

/// What a check found.
struct CheckReport {
    std::vector<CheckResult> results;  ///< of all that was looked for, in the order of Check
    RowBand band;                      ///< how the runs of faults lie
    double volume = 0;                 ///< of the part, mm^3
    std::optional<PeelCurve> peel;     ///< if Check::peel was looked for

    /// Whether nothing is wrong that the process fails for.
    bool passed() const;
};

struct PrintCheckOptions {
    PrintLimits limits;
    double pitch = 0.1;  ///< mm from row to row; thicknesses are known to about a pitch
    /// Lines that another back-end goes through anyway, with a step: the rows then lie there, and what it
    /// finds of them need not be found again. The pitch is theirs.
    std::optional<RowBand> lines{};
    std::size_t max_places = 10;  ///< faults of each kind that are told of
};

/// The pitch for these limits where none is asked for, mm: a fifth of the least thickness or gap that is
/// looked for, as near as the job's size and layers allow.
double check_pitch(const Job& job, const PrintLimits& limits);

/// Looks at layers as they stream by. A back-end of its own or beside others; writes nothing.
///
/// Rows lie a pitch apart and are exact along their own direction. Memory depends on a few layers' runs, not
/// on their number. The report is a pure function of job and options, the same by any number of threads.
/// Throws InputError when the limits or the pitch make no sense for the job.
class PrintCheck : public Backend {
  public:
    PrintCheck(const Job& job, const PrintCheckOptions& options);
    ~PrintCheck() override;

    int open(const Job& job, LayerRange range, bool resume) override;
    std::optional<RowBand> shared_lines() const override;
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    std::unique_ptr<LayerProduct> empty_product() const override;
    void write(const Layer& layer, LayerProduct& product) override;
    void finish() override;

    /// After `end`.
    const CheckReport& report() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lamella
