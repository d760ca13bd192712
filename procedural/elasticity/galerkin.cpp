// Galerkin products: element by element from moduli, node by node from stencils and near fixed nodes.
#include "procedural/elasticity/galerkin.h"

#include <algorithm>
#include <cstdlib>

namespace lamella {

namespace {

constexpr int points_of_cube(int base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * points_of_cube(base, exponent - 1);
}

/// Interpolation weight of a coarse node at a fine node that lies `distance` fine elements away.
constexpr double interpolation_weight(int distance) {
    return distance == 0 ? 1 : distance == 1 || distance == -1 ? 0.5 : 0;
}

/// Splits k, the number of a point in a cube of `side` points, into offsets from the cube's centre.
template <std::size_t Dim>
glm::ivec3 offset(int k, int side) {
    const int half = side / 2;
    return {k % side - half, k / side % side - half, Dim == 2 ? 0 : k / (side * side) - half};
}

template <std::size_t Dim>
int place(glm::ivec3 at, int side) {
    const int half = side / 2;
    return at.x + half + side * (at.y + half) + (Dim == 2 ? 0 : side * side * (at.z + half));
}

template <std::size_t Dim>
double interpolation_weight(glm::ivec3 at) {
    return interpolation_weight(at.x) * interpolation_weight(at.y) *
           (Dim == 2 ? 1 : interpolation_weight(at.z));
}

template <std::size_t Dim>
using NodeBlock = std::array<double, Dim * Dim>;
template <std::size_t Dim>
using NodeStencilOf = std::array<NodeBlock<Dim>, NodeGrid<Dim>::neighbours>;

}  // namespace

/// Which neighbours of which fine neighbour lie where, and how coarse nodes interpolate there.
template <std::size_t Dim>
struct CoarseningWeights {
    static constexpr int near = points_of_cube(3, Dim), far = points_of_cube(5, Dim);
    struct Share {
        std::size_t coarse;
        double weight;
    };

    std::array<double, near> restriction;
    std::array<std::array<std::size_t, near>, near> reached;  ///< fine neighbour, its neighbour: of the 5^Dim
    std::array<std::vector<Share>, far> interpolation;        ///< coarse neighbours of each of the 5^Dim

    CoarseningWeights() {
        for (int s = 0; s < near; ++s) {
            const glm::ivec3 from = offset<Dim>(s, 3);
            restriction[static_cast<std::size_t>(s)] = interpolation_weight<Dim>(from);
            for (int k = 0; k < near; ++k) {
                reached[static_cast<std::size_t>(s)][static_cast<std::size_t>(k)] =
                    static_cast<std::size_t>(place<Dim>(from + offset<Dim>(k, 3), 5));
            }
        }
        for (int t = 0; t < far; ++t) {
            for (int c = 0; c < near; ++c) {
                const double w = interpolation_weight<Dim>(offset<Dim>(t, 5) - 2 * offset<Dim>(c, 3));
                if (w != 0)
                    interpolation[static_cast<std::size_t>(t)].push_back({static_cast<std::size_t>(c), w});
            }
        }
    }
};

namespace {

/// Computes the stencil of a coarse node. `stencil_of(node)` returns that of a fine node.
template <std::size_t Dim, typename StencilAt>
NodeStencilOf<Dim> coarse_stencil(const CoarseningWeights<Dim>& weights, const NodeGrid<Dim>& fine,
                                  glm::ivec3 coarse_node, const StencilAt& stencil_of) {
    std::array<NodeBlock<Dim>, CoarseningWeights<Dim>::far> half{};  // restriction times stiffness
    const glm::ivec3 nodes = fine.nodes();
    for (int s = 0; s < CoarseningWeights<Dim>::near; ++s) {
        const glm::ivec3 at = 2 * coarse_node + offset<Dim>(s, 3);
        if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= nodes.x || at.y >= nodes.y || at.z >= nodes.z)
            continue;
        const NodeStencilOf<Dim> stencil = stencil_of(fine.number(at.x, at.y, at.z));
        const double w = weights.restriction[static_cast<std::size_t>(s)];
        for (std::size_t k = 0; k < stencil.size(); ++k) {
            NodeBlock<Dim>& sum = half[weights.reached[static_cast<std::size_t>(s)][k]];
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * stencil[k][i];
        }
    }
    NodeStencilOf<Dim> coarse{};
    for (std::size_t t = 0; t < half.size(); ++t) {
        for (const auto& share : weights.interpolation[t]) {
            for (std::size_t i = 0; i < Dim * Dim; ++i) coarse[share.coarse][i] += share.weight * half[t][i];
        }
    }
    return coarse;
}

template <std::size_t Dim>
void store(const NodeStencilOf<Dim>& stencil, std::size_t node, Stencils<Dim>& to) {
    for (std::size_t k = 0; k < stencil.size(); ++k) {
        for (std::size_t i = 0; i < Dim * Dim; ++i)
            to.at(node, k * Dim * Dim + i) = static_cast<float>(stencil[k][i]);
    }
}

/// Calls work(node, number) for the nodes of a grid, rows in parallel.
template <std::size_t Dim, typename Work>
void for_each_node_of(const NodeGrid<Dim>& grid, const Work& work) {
    const glm::ivec3 n = grid.nodes();
    parallel_for(n.y * n.z, [&](int row) {
        const int y = row % n.y, z = row / n.y;
        for (int x = 0; x < n.x; ++x) work(glm::ivec3(x, y, z), grid.number(x, y, z));
    });
}

/// The stiffness P^T k P of a coarse element of which one child has modulus 1, the others none.
template <std::size_t Dim>
using CoarseElement = std::array<std::array<double, GridElement<Dim>::unknowns>, GridElement<Dim>::unknowns>;

template <std::size_t Dim>
CoarseElement<Dim> with_one_child(const GridElement<Dim>& element, unsigned child) {
    constexpr std::size_t corners = GridElement<Dim>::corners;
    std::array<std::array<double, corners>, corners> w;  // of coarse corner C at corner c of the child
    for (unsigned c = 0; c < corners; ++c) {
        for (unsigned at = 0; at < corners; ++at) {
            w[c][at] = 1;
            for (unsigned d = 0; d < Dim; ++d) {
                const int p = static_cast<int>((child >> d & 1) + (c >> d & 1)), end = at >> d & 1 ? 2 : 0;
                w[c][at] *= 1 - 0.5 * std::abs(p - end);
            }
        }
    }
    CoarseElement<Dim> sum{};
    for (std::size_t a = 0; a < corners; ++a) {
        for (std::size_t b = 0; b < corners; ++b) {
            for (std::size_t p = 0; p < corners; ++p) {
                for (std::size_t q = 0; q < corners; ++q) {
                    const double both = w[a][p] * w[b][q];
                    if (both == 0) continue;
                    for (std::size_t i = 0; i < Dim; ++i) {
                        for (std::size_t j = 0; j < Dim; ++j)
                            sum[Dim * p + i][Dim * q + j] +=
                                both * element.stiffness[Dim * a + i][Dim * b + j];
                    }
                }
            }
        }
    }
    return sum;
}

/// The moduli of the children of coarse elements: one array for each octant (in the plane: quadrant).
template <std::size_t Dim>
std::array<std::vector<float>, (std::size_t{1} << Dim)> by_octant(const NodeGrid<Dim>& fine,
                                                                  const NodeGrid<Dim>& coarse,
                                                                  std::span<const float> moduli) {
    std::array<std::vector<float>, (std::size_t{1} << Dim)> octants;
    const glm::ivec3 n = coarse.elements(), most = fine.elements();
    for (unsigned c = 0; c < octants.size(); ++c) {
        octants[c].assign(coarse.size(), 0.0F);
        const glm::ivec3 child(c & 1, c >> 1 & 1, c >> 2 & 1);
        parallel_for(n.y * n.z, [&](int row) {
            const int y = row % n.y, z = row / n.y, fine_y = 2 * y + child.y,
                      fine_z = Dim == 2 ? 0 : 2 * z + child.z;
            if (fine_y >= most.y || fine_z >= most.z) return;
            for (int x = 0; 2 * x + child.x < most.x; ++x)
                octants[c][coarse.number(x, y, z)] = moduli[fine.number(2 * x + child.x, fine_y, fine_z)];
        });
    }
    return octants;
}

/// The stencil of a node of a body: rows and columns of what is fixed are zero.
template <std::size_t Dim>
NodeStencilOf<Dim> body_stencil(const ElasticBody<Dim>& body, std::span<const float> moduli,
                                const std::array<std::ptrdiff_t, GridElement<Dim>::corners>& corners,
                                const std::array<std::ptrdiff_t, NodeGrid<Dim>::neighbours>& neighbours,
                                std::size_t node) {
    NodeStencilOf<Dim> stencil{};
    for (unsigned e = 0; e < corners.size(); ++e) {
        const double modulus = static_cast<double>(
            moduli[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) - corners[e])]);
        if (modulus == 0) continue;
        for (unsigned c = 0; c < corners.size(); ++c) {
            std::size_t k = 0;
            for (std::size_t d = Dim; d-- > 0;) k = 3 * k + (1 + (c >> d & 1) - (e >> d & 1));
            for (std::size_t i = 0; i < Dim; ++i) {
                for (std::size_t j = 0; j < Dim; ++j)
                    stencil[k][Dim * i + j] += modulus * body.element.stiffness[Dim * e + i][Dim * c + j];
            }
        }
    }
    for (std::size_t k = 0; k < stencil.size(); ++k) {
        const std::uint8_t columns =
            body.fixed[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + neighbours[k])];
        for (std::size_t i = 0; i < Dim; ++i) {
            for (std::size_t j = 0; j < Dim; ++j) {
                if ((body.fixed[node] >> i & 1) != 0 || (columns >> j & 1) != 0) stencil[k][Dim * i + j] = 0;
            }
        }
    }
    return stencil;
}

/// Flags the coarse nodes whose stencil depends on a fixed node.
template <std::size_t Dim>
std::vector<std::uint8_t> near_fixed(const ElasticBody<Dim>& body, const NodeGrid<Dim>& coarse) {
    std::vector<std::uint8_t> near(coarse.size());
    const glm::ivec3 n = body.grid.nodes(), last = coarse.nodes() - 1;
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) {
                if (body.fixed[body.grid.number(x, y, z)] == 0) continue;
                const glm::ivec3 at(x, y, z), lo = glm::max((at - 1) / 2, glm::ivec3(0)),
                                              hi = glm::min((at + 2) / 2, last);
                for (int k = lo.z; k <= hi.z; ++k) {
                    for (int j = lo.y; j <= hi.y; ++j) {
                        for (int i = lo.x; i <= hi.x; ++i) near[coarse.number(i, j, k)] = 1;
                    }
                }
            }
        }
    }
    return near;
}

}  // namespace

template <std::size_t Dim>
std::vector<std::uint8_t> coarse_elements(const NodeGrid<Dim>& fine,
                                          const std::vector<std::uint8_t>& present) {
    const NodeGrid<Dim> coarse = coarser(fine);
    std::vector<std::uint8_t> parents(coarse.size());
    const glm::ivec3 n = fine.elements();
    for (int z = 0; z < n.z; ++z) {
        for (int y = 0; y < n.y; ++y) {
            for (int x = 0; x < n.x; ++x) {
                if (present[fine.number(x, y, z)] != 0) parents[coarse.number(x / 2, y / 2, z / 2)] = 1;
            }
        }
    }
    return parents;
}

template <std::size_t Dim>
void coarsen(const ElasticBody<Dim>& body, std::span<const float> moduli, const NodeRuns& runs,
             Stencils<Dim>& coarse) {
    constexpr std::size_t tile = NodeGrid<Dim>::tile, corners = GridElement<Dim>::corners,
                          entries = StencilForces<Dim>::entries;
    std::array<CoarseElement<Dim>, corners> kinds;
    for (unsigned c = 0; c < corners; ++c) kinds[c] = with_one_child(body.element, c);
    const auto octants = by_octant(body.grid, coarse.grid, moduli);
    const auto steps = coarse.grid.corner_steps();
    runs.for_each([&](std::size_t begin, std::size_t end) {
        for (std::size_t node = begin; node < end; node += tile) {
            float* to = &coarse.at(node, 0);
            std::fill(to, to + entries * tile, 0.0F);
            for (unsigned e = 0; e < corners; ++e) {
                const auto element = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) - steps[e]);
                for (unsigned child = 0; child < corners; ++child) {
                    const float* moduli_of = octants[child].data() + element;
                    if (std::all_of(moduli_of, moduli_of + tile, [](float m) { return m == 0; })) continue;
                    for (unsigned c = 0; c < corners; ++c) {
                        std::size_t k = 0;
                        for (std::size_t d = Dim; d-- > 0;) k = 3 * k + (1 + (c >> d & 1) - (e >> d & 1));
                        float* block = to + k * Dim * Dim * tile;
                        for (std::size_t i = 0; i < Dim * Dim; ++i, block += tile) {
                            const auto stiffness =
                                static_cast<float>(kinds[child][Dim * e + i / Dim][Dim * c + i % Dim]);
                            for (std::size_t l = 0; l < tile; ++l) block[l] += stiffness * moduli_of[l];
                        }
                    }
                }
            }
        }
    });
    const CoarseningWeights<Dim> weights;
    const auto fine_corners = body.grid.corner_steps();
    const auto fine_neighbours = body.grid.neighbour_steps();
    const std::vector<std::uint8_t> near = near_fixed(body, coarse.grid);
    for_each_node_of(coarse.grid, [&](glm::ivec3 at, std::size_t node) {
        if (near[node] == 0) return;
        store(coarse_stencil(weights, body.grid, at,
                             [&](std::size_t fine) {
                                 return body_stencil(body, moduli, fine_corners, fine_neighbours, fine);
                             }),
              node, coarse);
    });
}

template <std::size_t Dim>
void coarsen(const Stencils<Dim>& fine, Stencils<Dim>& coarse) {
    const CoarseningWeights<Dim> weights;
    for_each_node_of(coarse.grid, [&](glm::ivec3 at, std::size_t node) {
        store(coarse_stencil(weights, fine.grid, at,
                             [&](std::size_t from) {
                                 NodeStencilOf<Dim> stencil;
                                 for (std::size_t k = 0; k < stencil.size(); ++k) {
                                     for (std::size_t i = 0; i < Dim * Dim; ++i)
                                         stencil[k][i] =
                                             static_cast<double>(fine.at(from, k * Dim * Dim + i));
                                 }
                                 return stencil;
                             }),
              node, coarse);
    });
}

template std::vector<std::uint8_t> coarse_elements(const NodeGrid<2>&, const std::vector<std::uint8_t>&);
template std::vector<std::uint8_t> coarse_elements(const NodeGrid<3>&, const std::vector<std::uint8_t>&);
template void coarsen(const ElasticBody<2>&, std::span<const float>, const NodeRuns&, Stencils<2>&);
template void coarsen(const ElasticBody<3>&, std::span<const float>, const NodeRuns&, Stencils<3>&);
template void coarsen(const Stencils<2>&, Stencils<2>&);
template void coarsen(const Stencils<3>&, Stencils<3>&);

}  // namespace lamella
