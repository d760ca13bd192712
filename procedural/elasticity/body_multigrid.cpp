// The cycle: Chebyshev smoothing, restriction, a dense solve on the coarsest grid, interpolation.
#include "procedural/elasticity/body_multigrid.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "procedural/elasticity/dense_symmetric.h"
#include "procedural/elasticity/galerkin.h"
#include "procedural/elasticity/grid_transfer.h"

namespace lamella {

namespace {

constexpr int power_iterations = 10;     // of the power iteration for the largest eigenvalue
constexpr double estimate_margin = 1.1;  // factor on the eigenvalue estimate
constexpr int smoothing_degree = 3;
constexpr double smoothed_range = 14;  // the smoother damps eigenvalues down to this fraction of the largest
// Members of a few elements are too stiff on coarse grids: one visit there leaves much to be done.
constexpr int visits_to_coarser = 2;
constexpr std::size_t max_direct = 600;  // unknowns of a coarsest grid
// The coarsest matrix comes from single precision: what is softer than this share of its diagonal is noise.
constexpr double direct_noise = 1e-7;

/// Returns the largest eigenvalue of D^-1 k for one element, D being the diagonal of k. It bounds that of any
/// body of such elements, whatever their moduli: both K and its diagonal are sums over elements.
template <std::size_t Dim>
double greatest_of(const GridElement<Dim>& element) {
    constexpr std::size_t n = GridElement<Dim>::unknowns;
    std::vector<double> k(n * n);
    const auto& s = element.stiffness;
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) k[b * n + a] = s[a][b] / std::sqrt(s[a][a] * s[b][b]);
    }
    return greatest_eigenvalue(std::move(k), n);
}

}  // namespace

template <std::size_t Dim>
struct BodyMultigrid<Dim>::Level {
    using Vector = NodalVector<Dim, float>;

    Level(const NodeGrid<Dim>& nodes, const std::vector<std::uint8_t>& present)
        : grid(nodes),
          runs(used_nodes(grid, present)),
          inverse(grid.size()),
          b(grid.size()),
          x(grid.size()),
          next(grid.size()),
          step(grid.size()) {}

    NodeGrid<Dim> grid;
    NodeRuns runs;
    ElementForces<Dim, float> elements;
    std::optional<Stencils<Dim>> stencils;  // not on the finest grid
    StencilForces<Dim> forces;
    Vector inverse;       // of the diagonal; 0 where nothing moves
    double greatest = 1;  // upper bound of the eigenvalues of D^-1 K
    Vector b, x, next, step;
    // Of the coarsest grid: the unknowns that move, and their stiffness.
    std::vector<std::pair<std::size_t, std::size_t>> unknowns;
    DenseCholesky factors;

    /// Calls combine(d, first, last, force) for each run and direction: force[i - first] is (K at)_i.
    template <typename Combine>
    void for_each_force(const Vector& at, const Combine& combine) const {
        constexpr std::size_t most = 4096;
        runs.for_each([&](std::size_t begin, std::size_t end) {
            std::array<std::array<float, most>, Dim> buffer;
            for (std::size_t from = begin; from < end; from += most) {
                const std::size_t to = std::min(end, from + most);
                std::array<float*, Dim> out;
                for (std::size_t d = 0; d < Dim; ++d) out[d] = buffer[d].data();
                if (stencils) {
                    multiply(forces, at.data(), out, from, to);
                } else {
                    multiply(elements, at.data(), out, from, to);
                }
                for (std::size_t d = 0; d < Dim; ++d) combine(d, from, to, out[d]);
            }
        });
    }
    void find_inverse();
    void find_greatest();
    void first_step(double take);
    void next_step(double keep, double take);
    void smooth(bool from_zero);
    void find_rest();
    void factorise();
    void solve_directly();
};

/// Computes the inverse of the diagonal from the stencils.
template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::find_inverse() {
    constexpr std::size_t own = NodeGrid<Dim>::neighbours / 2 * Dim * Dim;
    runs.for_each([&](std::size_t begin, std::size_t end) {
        for (std::size_t d = 0; d < Dim; ++d) {
            for (std::size_t i = begin; i < end; ++i) {
                const float diagonal = stencils->at(i, own + d * Dim + d);
                inverse.along[d][i] = diagonal > 0 ? 1 / diagonal : 0;
            }
        }
    });
}

/// Estimates the largest eigenvalue by power iteration.
template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::find_greatest() {
    for (std::size_t d = 0; d < Dim; ++d) {
        std::uint32_t state = 12345 + static_cast<std::uint32_t>(d);
        for (std::size_t i = 0; i < x.along[d].size(); ++i) {
            state = state * 1664525U + 1013904223U;
            x.along[d][i] =
                inverse.along[d][i] > 0 ? static_cast<float>(state >> 8) / 16777216.0F - 0.5F : 0.0F;
        }
    }
    const auto squares = [&](const Vector& v) {
        return runs.sum([&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t d = 0; d < Dim; ++d) {
                for (std::size_t i = begin; i < end; ++i)
                    sum += static_cast<double>(v.along[d][i]) * static_cast<double>(v.along[d][i]);
            }
            return sum;
        });
    };
    double norm = std::sqrt(squares(x));
    greatest = 0;
    for (int k = 0; k < power_iterations && norm > 0; ++k) {
        for_each_force(x, [&](std::size_t d, std::size_t begin, std::size_t end, const float* force) {
            for (std::size_t i = begin; i < end; ++i)
                next.along[d][i] = inverse.along[d][i] * force[i - begin] / static_cast<float>(norm);
        });
        std::swap(x, next);
        norm = std::sqrt(squares(x));
        greatest = estimate_margin * norm;
    }
    if (!(greatest > 0)) greatest = 1;
}

template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::first_step(double take) {
    const auto factor = static_cast<float>(take);
    runs.for_each([&](std::size_t begin, std::size_t end) {
        for (std::size_t d = 0; d < Dim; ++d) {
            for (std::size_t i = begin; i < end; ++i)
                x.along[d][i] = step.along[d][i] = factor * (inverse.along[d][i] * b.along[d][i]);
        }
    });
}

template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::next_step(double keep, double take) {
    const auto old = static_cast<float>(keep), factor = static_cast<float>(take);
    for_each_force(x, [&](std::size_t d, std::size_t begin, std::size_t end, const float* force) {
        const float *right = b.along[d].data(), *scale = inverse.along[d].data(), *at = x.along[d].data();
        float *way = step.along[d].data(), *to = next.along[d].data();
        for (std::size_t i = begin; i < end; ++i) {
            way[i] = old * way[i] + factor * (scale[i] * (right[i] - force[i - begin]));
            to[i] = at[i] + way[i];
        }
    });
    std::swap(x, next);
}

/// Performs a few steps of Chebyshev iteration, preconditioned by the diagonal.
template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::smooth(bool from_zero) {
    const double high = greatest, low = greatest / smoothed_range, middle = (high + low) / 2,
                 half = (high - low) / 2, sigma = middle / half;
    if (from_zero) {
        first_step(1 / middle);
    } else {
        next_step(0, 1 / middle);
    }
    double before = 1 / sigma;
    for (int k = 1; k < smoothing_degree; ++k) {
        const double rho = 1 / (2 * sigma - before);
        next_step(rho * before, 2 * rho / half);
        before = rho;
    }
}

/// Stores the residual in `step`; 0 where nothing moves.
template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::find_rest() {
    for_each_force(x, [&](std::size_t d, std::size_t begin, std::size_t end, const float* force) {
        for (std::size_t i = begin; i < end; ++i)
            step.along[d][i] = inverse.along[d][i] > 0 ? b.along[d][i] - force[i - begin] : 0.0F;
    });
}

template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::factorise() {
    unknowns.clear();
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> index(Dim * grid.size(), none);
    for (std::size_t node = 0; node < grid.size(); ++node) {
        for (std::size_t d = 0; d < Dim; ++d) {
            if (!(inverse.along[d][node] > 0)) continue;
            index[Dim * node + d] = unknowns.size();
            unknowns.emplace_back(node, d);
        }
    }
    const std::size_t size = unknowns.size();
    const auto steps = grid.neighbour_steps();
    std::vector<double> k(size * size);
    for (std::size_t row = 0; row < size; ++row) {
        const auto [node, i] = unknowns[row];
        for (std::size_t n = 0; n < steps.size(); ++n) {
            const auto other = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + steps[n]);
            for (std::size_t j = 0; j < Dim; ++j) {
                const std::size_t column = index[Dim * other + j];
                if (column != none)
                    k[column * size + row] = static_cast<double>(stencils->at(node, (n * Dim + i) * Dim + j));
            }
        }
    }
    for (double share = direct_noise; share < 1; share *= 10) {
        std::vector<double> raised = k;
        for (std::size_t i = 0; i < size; ++i) raised[i * size + i] = (1 + share) * k[i * size + i];
        if (factors.factorise(std::move(raised), size)) break;
    }
}

template <std::size_t Dim>
void BodyMultigrid<Dim>::Level::solve_directly() {
    std::vector<double> right(unknowns.size());
    for (std::size_t i = 0; i < right.size(); ++i) {
        const auto [node, d] = unknowns[i];
        right[i] = static_cast<double>(b.along[d][node]);
    }
    factors.solve(right);
    for (std::size_t i = 0; i < right.size(); ++i) {
        const auto [node, d] = unknowns[i];
        x.along[d][node] = static_cast<float>(right[i]);
    }
}

template <std::size_t Dim>
BodyMultigrid<Dim>::BodyMultigrid(const ElasticBody<Dim>& body, const CancelToken* cancel)
    : body_(body), cancel_(cancel) {
    std::vector<std::uint8_t> present = body.present;
    levels_.push_back(std::make_unique<Level>(body.grid, present));
    Level& finest = *levels_.front();
    for (std::size_t i = 0; i < finest.elements.stiffness.size(); ++i) {
        constexpr std::size_t n = GridElement<Dim>::unknowns;
        finest.elements.stiffness[i] = static_cast<float>(body.element.stiffness[i / n][i % n]);
    }
    finest.elements.corners = body.grid.corner_steps();
    finest.greatest = greatest_of(body.element);
    do {
        stop_if_cancelled(cancel_);
        const NodeGrid<Dim> fine = levels_.back()->grid;
        present = coarse_elements(fine, present);
        levels_.push_back(std::make_unique<Level>(coarser(fine), present));
        Level& level = *levels_.back();
        level.stencils.emplace(level.grid);
        level.forces.stencils = level.stencils->numbers.data();
        level.forces.neighbours = level.grid.neighbour_steps();
        const glm::ivec3 n = level.grid.nodes();
        if (Dim * static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
                static_cast<std::size_t>(n.z) <=
            max_direct)
            break;
    } while (true);
}

template <std::size_t Dim>
BodyMultigrid<Dim>::~BodyMultigrid() = default;

template <std::size_t Dim>
void BodyMultigrid<Dim>::set_moduli(std::span<const float> moduli) {
    Level& finest = *levels_.front();
    finest.elements.moduli = moduli.data();
    finest.runs.for_each([&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; ++node) {
            for (std::size_t d = 0; d < Dim; ++d) {
                float diagonal = 0;
                for (std::size_t c = 0; c < GridElement<Dim>::corners; ++c) {
                    const std::size_t row = Dim * c + d;
                    const auto element = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) -
                                                                  finest.elements.corners[c]);
                    diagonal +=
                        moduli[element] * finest.elements.stiffness[row * GridElement<Dim>::unknowns + row];
                }
                const bool moves = diagonal > 0 && (body_.fixed[node] >> d & 1) == 0;
                finest.inverse.along[d][node] = moves ? 1 / diagonal : 0.0F;
            }
        }
    });
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        stop_if_cancelled(cancel_);
        Level& level = *levels_[l];
        if (l == 1) {
            coarsen(body_, moduli, level.runs, *level.stencils);
        } else {
            coarsen(*levels_[l - 1]->stencils, *level.stencils);
        }
        level.find_inverse();
        if (l + 1 < levels_.size()) {
            level.find_greatest();
        } else {
            level.factorise();
        }
    }
}

template <std::size_t Dim>
NodalVector<Dim, float>& BodyMultigrid<Dim>::right() {
    return levels_.front()->b;
}

template <std::size_t Dim>
const NodeRuns& BodyMultigrid<Dim>::used() const {
    return levels_.front()->runs;
}

template <std::size_t Dim>
const NodalVector<Dim, float>& BodyMultigrid<Dim>::solve() {
    cycle(0);
    return levels_.front()->x;
}

template <std::size_t Dim>
void BodyMultigrid<Dim>::cycle(std::size_t l) {
    Level& level = *levels_[l];
    if (l + 1 == levels_.size()) return level.solve_directly();
    stop_if_cancelled(cancel_);
    Level& coarse = *levels_[l + 1];
    level.smooth(true);
    const int visits = l == 0 ? 1 : visits_to_coarser;
    for (int visit = 0; visit < visits; ++visit) {
        level.find_rest();
        restrict_to(level.grid, level.step, coarse.grid, coarse.b);
        cycle(l + 1);
        interpolate(coarse.grid, coarse.x, level.grid, level.inverse, level.x);
        level.smooth(false);
    }
}

template class BodyMultigrid<2>;
template class BodyMultigrid<3>;

}  // namespace lamella
