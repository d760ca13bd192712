// LevelOptimizer: the steps of structure and appearance optimisation on one grid.
#pragma once

#include "procedural/appearance/appearance.h"
#include "procedural/appearance/appearance_settings.h"

namespace lamella {

/// What was found of a design.
struct LevelAnalysis {
    double compliance = 0;  ///< of the eroded densities, in the units of the problem
    double appearance = 0;  ///< A
    double volume = 0;      ///< mean density
    double greyness = 0;
    int solver_iterations = 0;
    std::vector<double> compliance_gradient, appearance_gradient;  ///< by density
};

/// What the steps on a grid need to go on: plain data.
struct LevelState {
    std::vector<double> design;
    /// Of the design. Without gradients it is that of a former one: the next step analyses the design first.
    LevelAnalysis found;
    MmaState mma;
    MatchState matches;
    std::vector<std::vector<double>> displacements;  ///< where the solver begins, see TopologyState
    int steps = 0;                                   ///< on this grid
    double first_appearance = 0;                     ///< A of the first step

    /// Lets the next step begin anew, with other functions of the design.
    void begin_stage();
};

/// Steps by the same functions of the design.
struct LevelStage {
    double sharpness = 0;  ///< of the projection
    double move = 0.2;     ///< most change of a variable in a step
};

class LevelOptimizer {
  public:
    /// Keeps references to problem and settings. `least_compliance` is C_opt. Throws InputError as Appearance
    /// does.
    LevelOptimizer(const TopologyProblem<2>& problem, const GreyImage& exemplar,
                   const AppearanceSettings& settings, int level, double least_compliance);

    /// Improves the design. Throws Interrupted once cancelled, and InputError for a state that does not fit;
    /// then the state is that before the step.
    AppearanceStep step(LevelState& state, const LevelStage& stage);
    /// Throws InputError for a state that does not fit.
    void check(const LevelState& state) { restore(state); }
    /// Whether the constraints hold closely.
    bool is_feasible(const LevelAnalysis& found) const;

  private:
    struct Candidate {
        std::vector<double> design;
        LevelAnalysis found;
    };
    void restore(const LevelState& state);
    Compliance<2>::Result analyse_structure(const std::vector<double>& design, double sharpness);
    LevelAnalysis analyse(Compliance<2>::Result structure);
    std::vector<double> wished_design(Mma& mma, const std::vector<double>& design, const LevelAnalysis& found,
                                      double first_appearance) const;
    Candidate step_towards(const std::vector<double>& wish, const std::vector<double>& design, double present,
                           double sharpness);
    std::span<const double> density() const { return map_.density(DensityMap::Role::result); }
    double most_compliance() const { return settings_.compliance * least_compliance_; }
    Mma make_mma(double move) const;

    const AppearanceSettings& settings_;
    int level_;
    double least_compliance_;
    DensityMap map_;
    Compliance<2> compliance_;
    Appearance appearance_;
    DesignBounds bounds_;
    std::vector<double> free_;
    double elements_ = 0;  ///< not outside
};

/// Marks the elements that cannot change.
std::vector<std::uint8_t> prescribed_elements(const std::vector<ElementUse>& use);

}  // namespace lamella
