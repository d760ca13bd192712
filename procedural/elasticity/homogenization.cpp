// Conjugate gradients for six load cases side by side; the tensor follows from the elastic energy.
#include "procedural/elasticity/homogenization.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/elasticity/elastic_multigrid.h"
#include "procedural/elasticity/node_blocks.h"

namespace lamella {
namespace {

/// The stiffness of the structure in double precision, and its loads.
class Structure {
  public:
    Structure(const ElasticGrid& grid, const HexElement& element) : grid_(grid), stencils_(256), loads_(256) {
        for (const auto& row : element.loads) {
            for (const double f : row) scale_ += f * f / load_cases;
        }
        for (std::size_t about = 1; about < 256; ++about) {
            stencils_[about] = gather_stencil<double>(
                [&](std::size_t e) { return (about >> e & 1) != 0 ? &element.stiffness : nullptr; });
            for (std::size_t e = 0; e < hex_nodes; ++e) {
                if ((about >> e & 1) == 0) continue;
                for (std::size_t k = 0; k < node_numbers; ++k)
                    loads_[about][k] += element.loads[3 * e + k / load_cases][k % load_cases];
            }
        }
    }

    std::size_t nodes() const { return grid_.nodes(); }
    void multiply(const double* x, double* out) const {
        for_each_node(nodes(), [&](std::size_t node) {
            double* sum = out + node * node_numbers;
            std::fill(sum, sum + node_numbers, 0.0);
            add_forces(stencils_[grid_.elements(node)], grid_.neighbours(node), x, sum);
        });
    }
    /// The squared norm that the loads would have if no node's loads cancelled.
    double load_scale() const { return scale_ * static_cast<double>(nodes()); }
    const double* load(std::size_t node) const { return loads_[grid_.elements(node)].data(); }

  private:
    const ElasticGrid& grid_;
    double scale_ = 0;
    std::vector<NodeStencil<double>> stencils_;  // by the bits of the elements around a node
    std::vector<std::array<double, node_numbers>> loads_;
};

/// Conjugate gradients, with separate coefficients for each load case.
class Solution {
  public:
    Solution(const Structure& structure, ElasticMultigrid& multigrid)
        : structure_(structure),
          multigrid_(multigrid),
          x_(size()),
          rest_(size()),
          way_(size()),
          force_(size()),
          single_(size()),
          eased_(size()) {
        for_each_node(nodes(), [&](std::size_t node) {
            std::copy_n(structure_.load(node), node_numbers,
                        rest_.begin() + static_cast<std::ptrdiff_t>(node * node_numbers));
        });
        load_ = products(nodes(), rest_.data(), rest_.data());
        // A strain whose loads cancel at every node, as in a full block, leaves only rounding errors.
        constexpr double hardly_any = 1e-8;
        for (double& load : load_) load = std::max(load, hardly_any * structure.load_scale());
    }

    int solve(const HomogenizationOptions& options);
    const double* x() const { return x_.data(); }
    const double* rest() const { return rest_.data(); }

  private:
    std::size_t nodes() const { return structure_.nodes(); }
    std::size_t size() const { return nodes() * node_numbers; }
    double largest(const CaseNumbers& squares) const {
        double most = 0;
        for (std::size_t l = 0; l < load_cases; ++l) most = std::max(most, squares[l] / load_[l]);
        return std::sqrt(most);
    }
    CaseNumbers ease(const CaseNumbers& squares, double tolerance);

    const Structure& structure_;
    ElasticMultigrid& multigrid_;
    std::vector<double> x_, rest_, way_, force_;
    std::vector<float> single_, eased_;
    CaseNumbers load_{};  // squared norms of the loads
};

/// Applies the preconditioner. Each load case is scaled to unit residual for single precision. Returns the
/// scales; 0 for converged cases, which are left out: their residual is rounding error, for which there is no
/// solution.
CaseNumbers Solution::ease(const CaseNumbers& squares, double tolerance) {
    CaseNumbers scale{};
    for (std::size_t l = 0; l < load_cases; ++l) {
        if (squares[l] > tolerance * tolerance * load_[l]) scale[l] = 1 / std::sqrt(squares[l]);
    }
    for_each_node(nodes(), [&](std::size_t node) {
        for (std::size_t k = node * node_numbers; k < (node + 1) * node_numbers; ++k)
            single_[k] = static_cast<float>(rest_[k] * scale[k % load_cases]);
    });
    multigrid_.solve(single_, eased_);
    for (std::size_t l = 0; l < load_cases; ++l) scale[l] = scale[l] > 0 ? 1 / scale[l] : 0;
    return scale;
}

int Solution::solve(const HomogenizationOptions& options) {
    CaseNumbers before{};
    for (int i = 0; i < options.max_iterations; ++i) {
        const CaseNumbers squares = products(nodes(), rest_.data(), rest_.data());
        const double share = largest(squares);
        if (options.on_progress) options.on_progress(i, share);
        if (share <= options.tolerance) return i;
        stop_if_cancelled(options.cancel);
        const CaseNumbers scale = ease(squares, options.tolerance);
        CaseNumbers now = products(nodes(), rest_.data(), eased_.data()), keep{};
        for (std::size_t l = 0; l < load_cases; ++l) {
            now[l] *= scale[l];
            keep[l] = before[l] > 0 ? now[l] / before[l] : 0;
        }
        for_each_node(nodes(), [&](std::size_t node) {
            for (std::size_t k = node * node_numbers; k < (node + 1) * node_numbers; ++k) {
                const std::size_t l = k % load_cases;
                way_[k] = scale[l] * static_cast<double>(eased_[k]) + keep[l] * way_[k];
            }
        });
        stop_if_cancelled(options.cancel);
        structure_.multiply(way_.data(), force_.data());
        const CaseNumbers work = products(nodes(), way_.data(), force_.data());
        CaseNumbers step{};
        for (std::size_t l = 0; l < load_cases; ++l) step[l] = work[l] > 0 ? now[l] / work[l] : 0;
        for_each_node(nodes(), [&](std::size_t node) {
            for (std::size_t k = node * node_numbers; k < (node + 1) * node_numbers; ++k) {
                x_[k] += step[k % load_cases] * way_[k];
                rest_[k] -= step[k % load_cases] * force_[k];
            }
        });
        before = now;
    }
    throw FaultError("a structure was not homogenised in " + std::to_string(options.max_iterations) +
                     " iterations");
}

/// Computes C = (volume fraction) * C_s - (f_a . x_b + x_a . r_b) / V from the elastic energy, whose error is
/// quadratic in that of x.
ElasticTensor tensor_of(const Structure& structure, const Solution& solution, const ElasticTensor& solid,
                        double share, double volume) {
    ElasticTensor c{};
    for (std::size_t a = 0; a < load_cases; ++a) {
        const CaseNumbers saved = sum_over_nodes(structure.nodes(), [&](std::size_t node, CaseNumbers& sums) {
            const double *f = structure.load(node), *x = solution.x() + node * node_numbers,
                         *r = solution.rest() + node * node_numbers;
            for (std::size_t d = 0; d < 3; ++d) {
                for (std::size_t b = 0; b < load_cases; ++b) {
                    sums[b] += f[load_cases * d + a] * x[load_cases * d + b] +
                               x[load_cases * d + a] * r[load_cases * d + b];
                }
            }
        });
        for (std::size_t b = 0; b < load_cases; ++b) c[a][b] = share * solid[a][b] - saved[b] / volume;
    }
    for (std::size_t a = 0; a < load_cases; ++a) {
        for (std::size_t b = 0; b < a; ++b) c[a][b] = c[b][a] = 0.5 * (c[a][b] + c[b][a]);
    }
    return c;
}

void check_sample(const ElementMask& sample) {
    const glm::ivec3 n = sample.size;
    constexpr int most = 1024;
    for (int k = 0; k < 3; ++k) {
        if (n[k] < 1 || n[k] > most)
            throw InputError("a sample has " + std::to_string(n[k]) +
                             " elements along a side; accepted: 1 to " + std::to_string(most));
    }
    const std::size_t count =
        static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z);
    if (sample.present.size() != count)
        throw InputError("a sample has not as many elements as its sides say");
    if (std::ranges::none_of(sample.present, [](std::uint8_t p) { return p != 0; }))
        throw InputError("a sample is empty: there is nothing to homogenise");
}

}  // namespace

Homogenized homogenize(const ElementMask& sample, const IsotropicMaterial& material,
                       const HomogenizationOptions& options) {
    check_material(material);
    check_sample(sample);
    const auto solid =
        static_cast<double>(std::ranges::count_if(sample.present, [](std::uint8_t p) { return p != 0; }));
    const auto volume = static_cast<double>(sample.present.size());
    const ElasticTensor stiffness = stiffness_of(material);
    const HexElement element = make_hex_element(stiffness);
    ThreadArena arena(options.threads);
    const auto work = [&] {
        ElasticMultigrid multigrid(sample, element, options.cancel);
        const Structure structure(multigrid.grid(), element);
        Solution solution(structure, multigrid);
        Homogenized result;
        result.iterations = solution.solve(options);
        result.density = solid / volume;
        result.nodes = structure.nodes();
        result.stiffness = tensor_of(structure, solution, stiffness, result.density, volume);
        return result;
    };
    try {
        return arena.execute(work);
    } catch (const Interrupted&) {
        throw Interrupted("stopped while a structure was homogenised");
    }
}

}  // namespace lamella
