// Galerkin coarsening of elements, Chebyshev smoothing, and the V-cycle.
#include "procedural/elasticity/elastic_multigrid.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "engine/base/parallel.h"
#include "procedural/elasticity/node_blocks.h"

namespace lamella {
namespace {

using Stiffness = std::array<std::array<double, hex_unknowns>, hex_unknowns>;
using Block = std::array<float, 9>;

constexpr int power_steps = 12;  // of the power iteration for the largest eigenvalue
constexpr double safety = 1.1;   // factor on the eigenvalue estimate
// the smoother damps eigenvalues from the largest down to this fraction (1/6) of it
constexpr double smoothed_share = 6;
constexpr std::size_t max_dense = 1200;  // unknowns of a coarsest grid that is still solved directly
constexpr int sweeps_instead = 8;        // smoothing steps on a larger coarsest grid
constexpr double negligible_stiffness =
    1e-5;  // relative to the stiffness: less than the rounding to single precision

/// Returns the interpolation weight of coarse node A at node a of the child in octant `child`.
double weight(std::size_t child, std::size_t a, std::size_t coarse) {
    double product = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = 0.5 * static_cast<double>((child >> axis & 1) + (a >> axis & 1));
        product *= (coarse >> axis & 1) != 0 ? at : 1 - at;
    }
    return product;
}

/// Adds a child's stiffness to that of its parent element: P^T K P.
void add_child(const Stiffness& child_stiffness, std::size_t child, Stiffness& sum) {
    std::array<std::array<double, hex_nodes>, hex_nodes> w;
    for (std::size_t a = 0; a < hex_nodes; ++a) {
        for (std::size_t c = 0; c < hex_nodes; ++c) w[a][c] = weight(child, a, c);
    }
    Stiffness half{};  // K P
    for (std::size_t row = 0; row < hex_unknowns; ++row) {
        for (std::size_t b = 0; b < hex_nodes; ++b) {
            for (std::size_t c = 0; c < hex_nodes; ++c) {
                if (w[b][c] == 0) continue;
                for (std::size_t j = 0; j < 3; ++j)
                    half[row][3 * c + j] += w[b][c] * child_stiffness[row][3 * b + j];
            }
        }
    }
    for (std::size_t a = 0; a < hex_nodes; ++a) {
        for (std::size_t c = 0; c < hex_nodes; ++c) {
            if (w[a][c] == 0) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t column = 0; column < hex_unknowns; ++column)
                    sum[3 * c + i][column] += w[a][c] * half[3 * a + i][column];
            }
        }
    }
}

/// Returns the inverse of a node's diagonal block.
Block inverse_of(const float* block) {
    Eigen::Matrix3d m;
    for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = static_cast<double>(block[k]);
    const Eigen::Matrix3d inverse = m.inverse();
    Block out;
    for (int k = 0; k < 9; ++k) out[static_cast<std::size_t>(k)] = static_cast<float>(inverse(k / 3, k % 3));
    return out;
}

constexpr std::size_t own = 9 * (hex_neighbours / 2);  // offset of the diagonal block in a stencil

}  // namespace

/// The element stiffnesses: a few kinds shared by many elements, or one for each element.
struct ElasticMultigrid::Elements {
    std::vector<Stiffness> kinds;
    std::vector<std::int32_t> kind;  ///< by element, -1 for void

    const Stiffness* at(std::size_t element) const {
        return kind[element] < 0 ? nullptr : &kinds[static_cast<std::size_t>(kind[element])];
    }
    /// Returns elements of twice the size, each the sum of its children. `children` has a bit for each solid
    /// octant.
    Elements summed(const ElementMask& mask, glm::ivec3 size,
                    const std::vector<std::uint8_t>& children) const;
};

ElasticMultigrid::Elements ElasticMultigrid::Elements::summed(
    const ElementMask& mask, glm::ivec3 size, const std::vector<std::uint8_t>& children) const {
    Elements larger;
    larger.kind.assign(children.size(), -1);
    // While all elements are alike, parents with the same set of children are alike, too.
    const bool alike = kinds.size() == 1;
    std::vector<std::int32_t> known(256, -1);
    std::vector<std::size_t> of;  // one representative element of each kind
    for (std::size_t e = 0; e < children.size(); ++e) {
        if (children[e] == 0) continue;
        std::int32_t& same = known[children[e]];
        if (!alike || same < 0) {
            same = static_cast<std::int32_t>(of.size());
            of.push_back(e);
        }
        larger.kind[e] = same;
    }
    larger.kinds.resize(of.size());
    parallel_for(of.size(), [&](std::size_t k) {
        const int x = static_cast<int>(of[k]) % size.x, y = static_cast<int>(of[k]) / size.x % size.y,
                  z = static_cast<int>(of[k]) / (size.x * size.y);
        larger.kinds[k] = {};
        for (std::size_t c = 0; c < 8; ++c) {
            const Stiffness* child =
                at(mask.place(2 * x + static_cast<int>(c & 1), 2 * y + static_cast<int>(c >> 1 & 1),
                              2 * z + static_cast<int>(c >> 2 & 1)));
            if (child != nullptr) add_child(*child, c, larger.kinds[k]);
        }
    });
    return larger;
}

struct ElasticMultigrid::Level {
    Level(const ElementMask& mask, const CancelToken* stop) : cancel(stop), grid(mask) {}

    const CancelToken* cancel;
    ElasticGrid grid;
    std::vector<NodeStencil<float>> stencils;
    /// estimated upper bound of the eigenvalues of D^-1 K, D being the diagonal blocks
    std::vector<std::int32_t> stencil;
    std::vector<Block> inverses;  ///< inverse of the diagonal block, by stencil
    double greatest = 1;          ///< upper bound of the eigenvalues of D^-1 K, D being the diagonal blocks
    std::vector<float> b, x, rest, step;
    /// Direct solver of the coarsest grid, if that is small. Leaves rigid-body modes unchanged.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
    bool is_direct = false;

    const NodeStencil<float>& stencil_of(std::size_t node) const {
        return stencils[static_cast<std::size_t>(stencil[node])];
    }
    void make_room() {
        for (auto* v : {&b, &x, &rest, &step}) v->assign(grid.nodes() * node_numbers, 0.0F);
    }
    /// Computes the residual rest = b - K x.
    void find_rest(const float* right, const float* at);
    void find_greatest();
    void smooth(const float* right, float* at, bool from_zero);
    void factorise();
    void solve_directly(const float* right, float* at) const;
};

void ElasticMultigrid::Level::find_rest(const float* right, const float* at) {
    stop_if_cancelled(cancel);
    for_each_node(grid.nodes(), [&](std::size_t node) {
        std::array<float, node_numbers> force{};
        add_forces(stencil_of(node), grid.neighbours(node), at, force.data());
        for (std::size_t k = 0; k < node_numbers; ++k)
            rest[node * node_numbers + k] = right[node * node_numbers + k] - force[k];
    });
}

/// Estimates the largest eigenvalue by power iteration, with a separate start vector for each load case.
void ElasticMultigrid::Level::find_greatest() {
    std::uint32_t state = 12345;
    for (float& v : x) {
        state = state * 1664525U + 1013904223U;
        v = static_cast<float>(state >> 8) / 16777216.0F - 0.5F;
    }
    std::fill(b.begin(), b.end(), 0.0F);
    for (int i = 0; i < power_steps; ++i) {
        find_rest(b.data(), x.data());
        for_each_node(grid.nodes(), [&](std::size_t node) {
            const Block& inverse = inverses[static_cast<std::size_t>(stencil[node])];
            for (std::size_t r = 0; r < 3; ++r) {
                for (std::size_t l = 0; l < load_cases; ++l) {
                    float sum = 0;
                    for (std::size_t c = 0; c < 3; ++c)
                        sum -= inverse[3 * r + c] * rest[node * node_numbers + load_cases * c + l];
                    step[node * node_numbers + load_cases * r + l] = sum;
                }
            }
        });
        const CaseNumbers before = products(grid.nodes(), x.data(), x.data()),
                          after = products(grid.nodes(), step.data(), step.data());
        greatest = 0;
        for (std::size_t l = 0; l < load_cases; ++l) {
            if (before[l] > 0) greatest = std::max(greatest, safety * std::sqrt(after[l] / before[l]));
        }
        if (!(greatest > 0)) break;
        const auto scale = static_cast<float>(1 / greatest);
        for (std::size_t k = 0; k < x.size(); ++k) x[k] = step[k] * scale;
    }
    if (!(greatest > 0)) greatest = 1;
}

/// Performs two steps of Chebyshev iteration, preconditioned by the diagonal blocks.
void ElasticMultigrid::Level::smooth(const float* right, float* at, bool from_zero) {
    const double high = greatest, low = greatest / smoothed_share, middle = (high + low) / 2,
                 half = (high - low) / 2, sigma = middle / half, rho = 1 / (2 * sigma - 1 / sigma);
    for (int k = 0; k < 2; ++k) {
        const bool first = k == 0;
        if (first && from_zero) {
            std::copy(right, right + rest.size(), rest.begin());
            std::fill(at, at + rest.size(), 0.0F);
        } else {
            find_rest(right, at);
        }
        const auto keep = static_cast<float>(first ? 0 : rho / sigma),
                   take = static_cast<float>(first ? 1 / middle : 2 * rho / half);
        stop_if_cancelled(cancel);
        for_each_node(grid.nodes(), [&](std::size_t node) {
            const Block& inverse = inverses[static_cast<std::size_t>(stencil[node])];
            const std::size_t base = node * node_numbers;
            for (std::size_t r = 0; r < 3; ++r) {
                for (std::size_t l = 0; l < load_cases; ++l) {
                    float sum = 0;
                    for (std::size_t c = 0; c < 3; ++c)
                        sum += inverse[3 * r + c] * rest[base + load_cases * c + l];
                    float& way = step[base + load_cases * r + l];
                    way = (first ? 0.0F : keep * way) + take * sum;
                    at[base + load_cases * r + l] += way;
                }
            }
        });
    }
}

void ElasticMultigrid::Level::factorise() {
    const auto unknowns = static_cast<Eigen::Index>(3 * grid.nodes());
    if (3 * grid.nodes() > max_dense) return;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(unknowns, unknowns);
    for (std::size_t node = 0; node < grid.nodes(); ++node) {
        const auto neighbours = grid.neighbours(node);
        for (std::size_t n = 0; n < hex_neighbours; ++n) {
            if (neighbours[n] < 0) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j) {
                    k(static_cast<Eigen::Index>(3 * node + i),
                      3 * Eigen::Index{neighbours[n]} + static_cast<Eigen::Index>(j)) +=
                        static_cast<double>(stencil_of(node)[9 * n + 3 * i + j]);
                }
            }
        }
    }
    factors.setThreshold(negligible_stiffness);
    factors.compute(k);
    is_direct = true;
}

void ElasticMultigrid::Level::solve_directly(const float* right, float* at) const {
    const auto rows = static_cast<Eigen::Index>(3 * grid.nodes());
    Eigen::MatrixXd m(rows, static_cast<Eigen::Index>(load_cases));
    for (Eigen::Index r = 0; r < rows; ++r) {
        for (Eigen::Index l = 0; l < m.cols(); ++l) m(r, l) = static_cast<double>(right[r * m.cols() + l]);
    }
    const Eigen::MatrixXd solved = factors.solve(m);
    for (Eigen::Index r = 0; r < rows; ++r) {
        for (Eigen::Index l = 0; l < m.cols(); ++l) at[r * m.cols() + l] = static_cast<float>(solved(r, l));
    }
}

void ElasticMultigrid::add_level(const ElementMask& mask, const Elements& elements) {
    stop_if_cancelled(cancel_);
    auto level = std::make_unique<Level>(mask, cancel_);
    const ElasticGrid& grid = level->grid;
    const glm::ivec3 size = mask.size;
    // With one kind of element, nodes with the same elements around them share a stencil.
    const bool shared = elements.kinds.size() == 1;
    std::vector<std::int32_t> known(256, -1);
    level->stencil.resize(grid.nodes());
    for (std::size_t node = 0; node < grid.nodes(); ++node) {
        std::int32_t& same = known[grid.elements(node)];
        if (shared && same >= 0) {
            level->stencil[node] = same;
            continue;
        }
        same = static_cast<std::int32_t>(level->stencils.size());
        level->stencil[node] = same;
        const glm::ivec3 at = grid.place(node);
        level->stencils.push_back(gather_stencil<float>([&](std::size_t e) {
            const int x = (at.x - static_cast<int>(e & 1) + size.x) % size.x,
                      y = (at.y - static_cast<int>(e >> 1 & 1) + size.y) % size.y,
                      z = (at.z - static_cast<int>(e >> 2 & 1) + size.z) % size.z;
            return elements.at(mask.place(x, y, z));
        }));
    }
    for (const NodeStencil<float>& stencil : level->stencils) {
        Block block{};
        std::copy_n(stencil.data() + own, 9, block.data());
        level->inverses.push_back(inverse_of(block.data()));
    }
    level->make_room();
    levels_.push_back(std::move(level));
}

namespace {

struct Coarser {
    ElementMask mask;
    std::vector<std::uint8_t> children;  // by element: bits of the solid octants
};

Coarser coarsened(const ElementMask& fine) {
    Coarser coarse;
    coarse.mask.size = fine.size / 2;
    const glm::ivec3 size = coarse.mask.size;
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                unsigned children = 0;
                for (unsigned c = 0; c < 8; ++c) {
                    if (fine.at(2 * x + static_cast<int>(c & 1), 2 * y + static_cast<int>(c >> 1 & 1),
                                2 * z + static_cast<int>(c >> 2 & 1)))
                        children |= 1U << c;
                }
                coarse.children.push_back(static_cast<std::uint8_t>(children));
                coarse.mask.present.push_back(children != 0);
            }
        }
    }
    return coarse;
}

bool can_halve(glm::ivec3 size) {
    for (int k = 0; k < 3; ++k) {
        if (size[k] % 2 != 0 || size[k] < 4) return false;
    }
    return true;
}

}  // namespace

ElasticMultigrid::ElasticMultigrid(const ElementMask& fine, const HexElement& element,
                                   const CancelToken* cancel)
    : cancel_(cancel) {
    ElementMask mask = fine;
    Elements elements;
    elements.kinds.push_back(element.stiffness);
    for (const std::uint8_t present : mask.present) elements.kind.push_back(present != 0 ? 0 : -1);
    add_level(mask, elements);
    while (can_halve(mask.size)) {
        stop_if_cancelled(cancel_);
        Coarser coarse = coarsened(mask);
        Elements larger = elements.summed(mask, coarse.mask.size, coarse.children);
        mask = std::move(coarse.mask);
        elements = std::move(larger);
        add_level(mask, elements);
    }
    for (const auto& level : levels_) level->find_greatest();
    levels_.back()->factorise();
}

ElasticMultigrid::~ElasticMultigrid() = default;

const ElasticGrid& ElasticMultigrid::grid() const { return levels_.front()->grid; }
int ElasticMultigrid::levels() const { return static_cast<int>(levels_.size()); }

namespace {

/// Calls visit(fine place, weight) for the fine nodes around a coarse node, with their restriction weights.
template <typename Visit>
void for_each_share(glm::ivec3 coarse, const Visit& visit) {
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const float w = (dx == 0 ? 1.0F : 0.5F) * (dy == 0 ? 1.0F : 0.5F) * (dz == 0 ? 1.0F : 0.5F);
                visit(2 * coarse + glm::ivec3(dx, dy, dz), w);
            }
        }
    }
}

}  // namespace

void ElasticMultigrid::cycle(std::size_t l) {
    Level& level = *levels_[l];
    if (l + 1 == levels_.size()) {
        if (level.is_direct) return level.solve_directly(level.b.data(), level.x.data());
        for (int k = 0; k < sweeps_instead; ++k) level.smooth(level.b.data(), level.x.data(), k == 0);
        return;
    }
    Level& coarse = *levels_[l + 1];
    level.smooth(level.b.data(), level.x.data(), true);
    level.find_rest(level.b.data(), level.x.data());
    for_each_node(coarse.grid.nodes(), [&](std::size_t node) {
        std::array<float, node_numbers> sum{};
        for_each_share(coarse.grid.place(node), [&](glm::ivec3 p, float w) {
            const std::int32_t from = level.grid.number(p.x, p.y, p.z);
            if (from < 0) return;
            const float* rest = level.rest.data() + node_numbers * static_cast<std::size_t>(from);
            for (std::size_t k = 0; k < node_numbers; ++k) sum[k] += w * rest[k];
        });
        std::copy(sum.begin(), sum.end(),
                  coarse.b.begin() + static_cast<std::ptrdiff_t>(node * node_numbers));
    });
    cycle(l + 1);
    for_each_node(level.grid.nodes(), [&](std::size_t node) {
        const glm::ivec3 p = level.grid.place(node), lo = p / 2, odd = p - 2 * lo;
        float* x = level.x.data() + node * node_numbers;
        const float w = 1.0F / static_cast<float>(1 << (odd.x + odd.y + odd.z));
        for (int dz = 0; dz <= odd.z; ++dz) {
            for (int dy = 0; dy <= odd.y; ++dy) {
                for (int dx = 0; dx <= odd.x; ++dx) {
                    const std::int32_t from = coarse.grid.number(lo.x + dx, lo.y + dy, lo.z + dz);
                    const float* way = coarse.x.data() + node_numbers * static_cast<std::size_t>(from);
                    for (std::size_t k = 0; k < node_numbers; ++k) x[k] += w * way[k];
                }
            }
        }
    });
    level.smooth(level.b.data(), level.x.data(), false);
}

void ElasticMultigrid::solve(std::span<const float> b, std::span<float> x) {
    Level& top = *levels_.front();
    std::copy(b.begin(), b.end(), top.b.begin());
    cycle(0);
    std::copy(top.x.begin(), top.x.end(), x.begin());
}

}  // namespace lamella
