// TopologyOptimizer: the stiffest distribution of a given volume of material.
#pragma once

#include "procedural/optimization/compliance.h"
#include "procedural/optimization/mma.h"

namespace lamella {

enum class TopologyMethod : std::uint8_t { oc, mma };

struct TopologySettings {
    DensitySettings density;
    TopologyMethod method = TopologyMethod::oc;
    bool sensitivity_filter = false;  ///< instead of the density filter; for comparison with published values
    double move = 0.2;                ///< most change of a variable in an iteration
    double tolerance = 0.01;          ///< stops when no variable changes by more
    int iterations = 100;             ///< at most
    /// Of the projection at the end; 0: none. It comes on at 1 and doubles every `iterations_a_sharpness`.
    double sharpness = 0;
    int iterations_a_sharpness = 10;
    /// At most; 0: the problem's volume is filled. Above 0: the least volume with it is sought, up to the
    /// problem's.
    double compliance = 0;
    double solver_tolerance = 1e-5;
    double oc_tolerance = 1e-3;           ///< of the multiplier of the volume, relative
    const CancelToken* cancel = nullptr;  ///< may be null
    SharedSolves* shared = nullptr;       ///< the processes that share the solves; null for one
};

/// What an iteration found, before it changed the design.
struct TopologyIteration {
    int index = 0;          ///< from 1
    double compliance = 0;  ///< weighted sum over cases
    double volume = 0;      ///< mean density
    double greyness = 0;    ///< mean of 4 rho (1 - rho) over free elements: 0 for a design of 0 and 1
    double change = 0;      ///< largest change of a variable that the iteration made
    double sharpness = 0;
    int solver_iterations = 0;
};

/// What is needed to go on: plain data.
struct TopologyState {
    std::vector<double> design;
    MmaState mma;
    int iteration = 0;
    int phase = 0;        ///< of the projection
    int phase_began = 0;  ///< iteration after which it came on
    double first_compliance = 0;
    double volume = 0;  ///< with a bounded compliance: most of the mean density in the next iteration
    bool finished = false;
    /// By load case, then direction: where the solver begins. Without them, iterations differ within the
    /// solver's tolerance.
    std::vector<std::vector<double>> displacements{};
};

/// Minimises compliance at a bounded volume (Bendsoe and Sigmund 2003, "Topology Optimization", section 1) by
/// optimality criteria or the method of moving asymptotes; or the volume at a bounded compliance, which is
/// the same problem at the volume where the least compliance meets the bound. A pure function of problem and
/// settings.
template <std::size_t Dim>
class TopologyOptimizer {
  public:
    /// Keeps a reference to the problem. Throws InputError for a problem without loads, supports or free
    /// elements, when prescribed elements and the least densities alone exceed the volume, and for the
    /// sensitivity filter along with what only the density filter can do.
    TopologyOptimizer(const TopologyProblem<Dim>& problem, const TopologySettings& settings);

    /// Analyses the present design and improves it. Throws Interrupted once cancelled; then the state is that
    /// before the iteration.
    TopologyIteration iterate();
    /// Whether the last iteration changed the design by less than the tolerance at full sharpness, or no
    /// iteration is left.
    bool is_finished() const { return state_.finished; }
    /// Analyses the present design without changing anything; see DensityMap::Role::result.
    typename Compliance<Dim>::Result analyse();

    /// The densities of the present design, after show_design().
    const DensityMap& densities() const { return map_; }
    void show_design() { map_.forward(state_.design, sharpness()); }
    const Compliance<Dim>& compliance() const { return compliance_; }
    const TopologyState& state() const { return state_; }
    /// Goes on where another object was. Throws InputError for a state that does not fit.
    void set_state(TopologyState state);

  private:
    double volume() const { return settings_.compliance > 0 ? state_.volume : problem_.volume; }
    std::vector<double> start_design(double prescribed, double free) const;
    bool seek_volume(double compliance);
    double sharpness() const;
    double move() const;
    std::span<const double> density(DensityMap::Role role) const;
    std::vector<double> next_design(const typename Compliance<Dim>::Result& found,
                                    const std::vector<double>& compliance_gradient,
                                    const std::vector<double>& volume_gradient, double excess);
    std::vector<double> oc_step(const std::vector<double>& compliance_gradient,
                                const std::vector<double>& volume_gradient, double excess);
    void advance(bool settled);

    const TopologyProblem<Dim>& problem_;
    TopologySettings settings_;
    DensityMap map_;
    Compliance<Dim> compliance_;
    Mma mma_;
    DesignBounds bounds_;
    double least_volume_ = 0;  ///< with all free elements at their least density
    double elements_ = 0;      ///< not outside
    int phases_ = 0;
    TopologyState state_;
};

extern template class TopologyOptimizer<2>;
extern template class TopologyOptimizer<3>;

}  // namespace lamella
