// The print check: one streaming pass over a job's layers that finds what a process cannot make.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/layer_stream.h"
#include "engine/run_components.h"

namespace lamella {

/// What is looked for. The sizes that faults have are told with each; the worst is the largest.
enum class Check : unsigned char {
    connectivity,  ///< the part is one piece; size: volume of a further piece, mm^3
    sheets,        ///< each layer is one piece (cutters); size: area of all but the largest of a layer, mm^2
    islands,       ///< nothing begins with nothing below it; size: area, mm^2
    overhangs,     ///< nothing stands out too far over what is below; size: area in one layer, mm^2
    bridges,       ///< no stretch between two holds is too long; size: its length, mm
    thickness,     ///< nothing is too thin; size: volume, mm^3
    necks,         ///< nothing that joins large parts is too thin; size: volume of the neck, mm^3
    gaps,          ///< no void is too narrow; size: volume, mm^3
    cavities,      ///< no void is closed off; size: volume, mm^3
    cups,          ///< no void is closed off by the vat's film while it is printed; size: volume, mm^3
    build_volume,  ///< all lies within the machine's reach; size: by how much something sticks out, mm
    empty_layers   ///< each layer holds some of the part; size: height of the gap, mm
};
inline constexpr std::size_t check_count = 12;

/// Whether a fault matters.
enum class Verdict : unsigned char { off, warn, fail };

/// What a process can make. Lengths in mm.
struct PrintLimits {
    std::array<Verdict, check_count> verdicts{};  ///< by Check, what a fault of it comes to
    double thickness = 0.4;                       ///< least of walls and struts, within layers
    double thickness_up = 0;                      ///< the same upright; 0: layers are looked at one by one
    double gap = 0.4;                             ///< least width of void, within layers
    double gap_up = 0;                            ///< the same upright; 0: layers are looked at one by one
    double neck = 1;                              ///< least thickness of what joins large parts
    double large_part = 1000;                     ///< volume from which a part is large, mm^3
    double overhang = 0.2;                        ///< by which a layer may stand out over the one below
    double free_stretch = 1;                      ///< what hangs and is smaller across needs no hold
    double bridge = 10;                           ///< longest stretch between two holds
    double support_spacing = 3;                   ///< a support holds what lies within this distance
    double support_gap = 0;                       ///< height that may lie between a support and what it holds
    double cavity = 1;                            ///< volume from which a closed void matters, mm^3
    double cup = 10;                              ///< volume from which a suction cup matters, mm^3
    dvec3 build_volume{infinity};                 ///< width, depth and height that the machine reaches

    Verdict verdict(Check check) const { return verdicts[static_cast<std::size_t>(check)]; }
};

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
    Verdict verdict = Verdict::off;  ///< what a fault of it comes to
    double limit = 0;          ///< what sizes or thicknesses were held against, mm, mm^2 or mm^3; 0: none
    std::size_t count = 0;     ///< faults
    double total = 0;          ///< of their sizes
    std::vector<Fault> worst;  ///< by falling size; of equals the lowest first

    bool passed() const { return count == 0; }
};

/// What a check found.
struct CheckReport {
    std::vector<CheckResult> results;  ///< of all that was looked for, in the order of Check
    RowBand band;                      ///< how the runs of faults lie
    double volume = 0;                 ///< of the part, mm^3

    /// Whether nothing is wrong that the process fails for.
    bool passed() const;
};

struct PrintCheckOptions {
    PrintLimits limits;
    double pitch = 0.1;            ///< mm from row to row; thicknesses are known to about a pitch
    std::size_t most_places = 10;  ///< faults of each kind that are told of
};

/// The pitch for these limits where none is asked for, mm: a fifth of the least thickness or gap that is
/// looked for, as near as the job's size and layers allow.
double check_pitch(const Job& job, const PrintLimits& limits);

/// Looks at layers as they stream by. A back-end of its own or beside others; writes nothing.
///
/// Rows lie a pitch apart and are exact along x. Memory depends on a few layers' runs, not on their number.
/// The report is a pure function of job and options, the same by any number of threads. Throws InputError
/// when the limits or the pitch make no sense for the job.
class PrintCheck : public Backend {
  public:
    PrintCheck(const Job& job, const PrintCheckOptions& options);
    ~PrintCheck() override;

    int begin(const Job& job, LayerRange range, bool resume) override;
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;
    void end() override;

    /// After `end`.
    const CheckReport& report() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lamella
