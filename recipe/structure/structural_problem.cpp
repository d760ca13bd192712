// Finds the nodes of places, spreads forces over them, and checks that the body is held.
#include "recipe/structure/structural_problem.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <numeric>

#include "engine/base/error.h"
#include "procedural/optimization/density_shape.h"
#include "recipe/build/build_fields.h"

namespace lamella {

namespace {

constexpr double assumed_poisson = 0.3;

bool carries(ElementUse use) { return use != ElementUse::outside && use != ElementUse::empty; }

/// The elements and nodes of a domain, numbered as the solver does.
template <std::size_t Dim>
class DomainNodes {
  public:
    explicit DomainNodes(const ElementDomain& domain) : domain_(domain), grid_(domain.size) {}

    const NodeGrid<Dim>& grid() const { return grid_; }
    std::size_t number(glm::ivec3 node) const { return grid_.number(node.x, node.y, node.z); }
    bool carries_at(glm::ivec3 element) const {
        if (glm::clamp(element, glm::ivec3(0), domain_.size - 1) != element) return false;
        return carries(domain_.use[place(element)]);
    }
    std::size_t place(glm::ivec3 element) const {
        return static_cast<std::size_t>(element.x) +
               static_cast<std::size_t>(domain_.size.x) *
                   (static_cast<std::size_t>(element.y) +
                    static_cast<std::size_t>(domain_.size.y) * static_cast<std::size_t>(element.z));
    }
    /// Calls visit(element) for the elements around a node that carry.
    template <typename Visit>
    void for_each_element_at(glm::ivec3 node, const Visit& visit) const {
        for (int c = 0; c < 1 << Dim; ++c) {
            const glm::ivec3 element = node - glm::ivec3(c & 1, c >> 1 & 1, c >> 2 & 1);
            if (carries_at(element)) visit(element);
        }
    }
    int elements_at(glm::ivec3 node) const {
        int count = 0;
        for_each_element_at(node, [&](glm::ivec3) { ++count; });
        return count;
    }
    /// Calls visit(node) for the nodes of the body.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        const glm::ivec3 n = grid_.nodes();
        for (int z = 0; z < n.z; ++z) {
            for (int y = 0; y < n.y; ++y) {
                for (int x = 0; x < n.x; ++x) {
                    if (elements_at({x, y, z}) > 0) visit(glm::ivec3(x, y, z));
                }
            }
        }
    }

  private:
    const ElementDomain& domain_;
    NodeGrid<Dim> grid_;
};

/// Tells which positions lie in the place of a load or anchor.
class Place {
  public:
    Place(const PlaceRecipe& place, const ElementDomain& domain, Gradings& gradings)
        : place_(place), reach_(0.5 * (1 + 1e-9) * domain.edges) {
        if (domain.dimensions == 2) reach_.z = std::max(reach_.x, reach_.y);
        if (place.field.empty()) return;
        for (const FieldRecipe& field : gradings.recipe().fields) {
            if (field.name != place.field) continue;
            std::optional<MeshReport> mesh;
            field_ = build_field(field, gradings, grown(domain.box, domain.box.size().x), mesh);
        }
        if (!field_) throw InputError(place.where + ".field: no [[field]] is named \"" + place.field + "\"");
    }

    /// Faces are for the caller: they depend on the body's nodes.
    bool has_face() const { return !place_.face.empty(); }
    int face_axis() const { return place_.face[1] - 'x'; }
    bool face_is_upper() const { return place_.face[0] == '+'; }
    bool contains(dvec3 p) const {
        if (field_) return field_->value(p) <= std::max({reach_.x, reach_.y, reach_.z});
        if (!place_.box.empty()) {
            const Box box = box_of(place_.box);
            return glm::clamp(p, box.lo - reach_, box.hi + reach_) == p;
        }
        const dvec3 normal = glm::normalize(place_.normal);
        return glm::dot(normal, p - place_.at) >= -glm::length(normal * reach_);
    }

  private:
    const PlaceRecipe& place_;
    dvec3 reach_;  // half an element, mm
    FieldPtr field_;
};

/// Returns the nodes of the body in a place. Throws InputError when there are none.
template <std::size_t Dim>
std::vector<glm::ivec3> nodes_in(const Place& place, const DomainNodes<Dim>& nodes,
                                 const ElementDomain& domain, const std::string& where) {
    std::vector<glm::ivec3> found;
    if (place.has_face()) {
        const int axis = place.face_axis();
        if (axis >= static_cast<int>(Dim))
            throw InputError(where + ".face: a plate has no face along z; accepted: -x, +x, -y, +y");
        int outermost = place.face_is_upper() ? -1 : domain.size[axis] + 1;
        nodes.for_each([&](glm::ivec3 node) {
            outermost =
                place.face_is_upper() ? std::max(outermost, node[axis]) : std::min(outermost, node[axis]);
        });
        nodes.for_each([&](glm::ivec3 node) {
            if (node[axis] == outermost) found.push_back(node);
        });
    } else {
        nodes.for_each([&](glm::ivec3 node) {
            if (place.contains(domain.node(node))) found.push_back(node);
        });
    }
    if (found.empty())
        throw InputError(
            fmt::format("{}: its place holds nothing of the part; accepted: a place within half an "
                        "element ({:.3g} mm) of the part",
                        where, 0.5 * domain.longest_edge()));
    return found;
}

/// Spreads a force over nodes by the number of their filled elements, of all elements if none is filled.
template <std::size_t Dim>
void add_force(const std::vector<glm::ivec3>& places, const DomainNodes<Dim>& nodes,
               const FilledElements& filled, dvec3 force, NodalVector<Dim, double>& forces) {
    std::vector<int> weights, full_weights;
    for (const glm::ivec3 node : places) {
        int count = 0;
        nodes.for_each_element_at(node, [&](glm::ivec3 element) {
            count += !filled.empty() && filled[nodes.place(element)] != 0 ? 1 : 0;
        });
        weights.push_back(count);
        full_weights.push_back(nodes.elements_at(node));
    }
    if (std::ranges::all_of(weights, [](int count) { return count == 0; })) weights = full_weights;
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t d = 0; d < Dim; ++d)
            forces.along[d][nodes.number(places[i])] += weights[i] / total * force[static_cast<int>(d)];
    }
}

/// Pushes on the outer faces of elements whose four (in the plane: two) corners lie in the place.
template <std::size_t Dim>
void add_pressure(const std::vector<glm::ivec3>& places, const DomainNodes<Dim>& nodes,
                  const ElementDomain& domain, double pressure, const std::string& where,
                  NodalVector<Dim, double>& forces) {
    std::vector<std::uint8_t> in_place(nodes.grid().size());
    for (const glm::ivec3 node : places) in_place[nodes.number(node)] = 1;
    std::size_t faces = 0;
    for (int z = 0; z < domain.size.z; ++z) {
        for (int y = 0; y < domain.size.y; ++y) {
            for (int x = 0; x < domain.size.x; ++x) {
                const glm::ivec3 element(x, y, z);
                if (!nodes.carries_at(element)) continue;
                for (int axis = 0; axis < static_cast<int>(Dim); ++axis) {
                    for (const int side : {-1, 1}) {
                        glm::ivec3 beside = element;
                        beside[axis] += side;
                        if (nodes.carries_at(beside)) continue;
                        std::vector<std::size_t> corners;
                        for (int c = 0; c < 1 << Dim; ++c) {
                            const glm::ivec3 corner = element + glm::ivec3(c & 1, c >> 1 & 1, c >> 2 & 1);
                            if (corner[axis] == element[axis] + (side > 0 ? 1 : 0))
                                corners.push_back(nodes.number(corner));
                        }
                        if (!std::ranges::all_of(corners, [&](std::size_t n) { return in_place[n] != 0; }))
                            continue;
                        ++faces;
                        for (const std::size_t corner : corners) {
                            forces.along[static_cast<std::size_t>(axis)][corner] -=
                                side * pressure * domain.element_volume() / domain.edges[axis] /
                                static_cast<double>(corners.size());
                        }
                    }
                }
            }
        }
    }
    if (faces == 0)
        throw InputError(where +
                         ".pressure: its place holds nothing of the part's surface; accepted: a place that "
                         "surrounds some of the surface by half an element");
}

/// What holds and loads one piece of the body.
struct PieceHold {
    bool is_loaded = false;
    bool is_held = false;
    Eigen::Matrix<double, 6, 6> stiffness =
        Eigen::Matrix<double, 6, 6>::Zero();  // of anchors, to rigid motions
};

/// Adds a fixed direction of a node: its displacement under a unit motion along and about each axis.
void add_anchor(PieceHold& hold, dvec3 at, int axis) {
    Eigen::Matrix<double, 6, 1> moved = Eigen::Matrix<double, 6, 1>::Zero();
    moved[axis] = 1;
    for (int about = 0; about < 3; ++about) {
        dvec3 turn(0);
        turn[about] = 1;
        moved[3 + about] = glm::cross(turn, at)[axis];
    }
    hold.stiffness += moved * moved.transpose();
}

/// Returns how many rigid motions the anchors of a piece leave.
int free_motions(const PieceHold& hold, std::size_t dimensions) {
    constexpr double negligible = 1e-9;
    std::vector<int> motions{0, 1, 2, 3, 4, 5};
    if (dimensions == 2) motions = {0, 1, 5};
    const auto size = static_cast<Eigen::Index>(motions.size());
    Eigen::MatrixXd stiffness(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j)
            stiffness(i, j) =
                hold.stiffness(motions[static_cast<std::size_t>(i)], motions[static_cast<std::size_t>(j)]);
    }
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
    int free = 0;
    for (Eigen::Index i = 0; i < size; ++i) free += values[i] <= negligible * values.maxCoeff() ? 1 : 0;
    return free;
}

/// Checks piece by piece that what is loaded is held, and leaves out what is not held.
template <std::size_t Dim>
void check_pieces(const DomainNodes<Dim>& nodes, ElementDomain& domain, bool is_heavy,
                  StructuralProblem<Dim>& problem) {
    const std::vector<std::int32_t> piece =
        pieces_by_faces(domain.size, [&](std::size_t i) { return carries(domain.use[i]); });
    std::vector<PieceHold> holds(static_cast<std::size_t>(*std::ranges::max_element(piece) + 1));
    const dvec3 middle = dvec3(domain.size) * 0.5;
    const double reach = std::max({domain.size.x, domain.size.y, domain.size.z});
    const ElasticBody<Dim>& body = problem.topology.body;
    nodes.for_each([&](glm::ivec3 node) {
        const std::size_t number = nodes.number(node);
        bool is_loaded = false;
        for (const LoadCase<Dim>& load : problem.topology.cases) {
            for (const auto& along : load.forces.along) is_loaded = is_loaded || along[number] != 0;
        }
        nodes.for_each_element_at(node, [&](glm::ivec3 element) {
            PieceHold& hold = holds[static_cast<std::size_t>(piece[nodes.place(element)])];
            hold.is_loaded = hold.is_loaded || is_loaded;
            for (int axis = 0; axis < static_cast<int>(Dim); ++axis) {
                if ((body.fixed[number] >> axis & 1) == 0) continue;
                hold.is_held = true;
                add_anchor(hold, (dvec3(node) - middle) / reach, axis);
            }
        });
    });
    const auto is_used = [&](const PieceHold& hold) { return hold.is_held && (hold.is_loaded || is_heavy); };
    std::size_t left_out = 0;
    for (const PieceHold& hold : holds) {
        if (hold.is_loaded && !hold.is_held)
            throw InputError(
                "load: a piece of the part is loaded that no [[anchor]] holds; accepted: anchors on "
                "every loaded piece, or smaller elements if the part is one piece");
        if (is_used(hold) && free_motions(hold, Dim) > 0)
            throw InputError(
                fmt::format("anchor: {} of the part's {} rigid motions are free; accepted: anchors that "
                            "keep it from moving and turning, for instance a second place",
                            free_motions(hold, Dim), Dim == 2 ? 3 : 6));
        left_out += is_used(hold) ? 0 : 1;
    }
    if (left_out == holds.size())
        throw InputError(
            "load: no piece of the part is both loaded and held; accepted: an [[anchor]] and a [[load]] "
            "on one piece");
    for (std::size_t i = 0; i < piece.size(); ++i) {
        if (piece[i] < 0) continue;
        if (!is_used(holds[static_cast<std::size_t>(piece[i])])) domain.use[i] = ElementUse::outside;
    }
    if (left_out > 0)
        problem.notes.push_back(
            fmt::format("{} piece{} of the part that no load reaches, or that nothing holds, {} "
                        "left out",
                        left_out, left_out == 1 ? "" : "s", left_out == 1 ? "is" : "are"));
}

/// Flags the elements that touch one of the nodes for which `is_marked` returns true.
template <std::size_t Dim, typename IsMarked>
std::vector<std::uint8_t> elements_touching(const DomainNodes<Dim>& nodes, const ElementDomain& domain,
                                            const IsMarked& is_marked) {
    std::vector<std::uint8_t> flags(domain.use.size());
    nodes.for_each([&](glm::ivec3 node) {
        if (!is_marked(nodes.number(node))) return;
        nodes.for_each_element_at(node, [&](glm::ivec3 element) { flags[nodes.place(element)] = 1; });
    });
    return flags;
}

GridElement<2> element_of(const IsotropicMaterial& material, dvec3 edges,
                          std::integral_constant<std::size_t, 2>) {
    return make_plane_stress_element(material, edges);
}
GridElement<3> element_of(const IsotropicMaterial& material, dvec3 edges,
                          std::integral_constant<std::size_t, 3>) {
    return make_solid_element(material, edges);
}

}  // namespace

template <std::size_t Dim>
StructuralProblem<Dim> structural_problem(const Recipe& recipe, ElementDomain& domain, Gradings& gradings,
                                          double element_poisson, const FilledElements& filled) {
    BaseMaterial material;
    const bool known = recipe.material && has_modulus(*recipe.material);
    if (recipe.material) material = base_material(*recipe.material);
    if (!known) material.elastic.young = 1;
    if (!material.has_poisson) material.elastic.poisson = assumed_poisson;
    const double poisson = element_poisson != material_poisson ? element_poisson : material.elastic.poisson;
    const NodeGrid<Dim> grid(domain.size);
    StructuralProblem<Dim> problem{
        .topology = {.body = ElasticBody<Dim>(grid, element_of({1, poisson}, domain.edges / domain.edges.x,
                                                               std::integral_constant<std::size_t, Dim>()))}};
    problem.material = material;
    problem.material_is_assumed = !known;
    problem.displacement_unit = 1 / (material.elastic.young * (Dim == 2 ? domain.edges.z : domain.edges.x));

    const DomainNodes<Dim> nodes(domain);
    TopologyProblem<Dim>& topology = problem.topology;
    for (const AnchorRecipe& anchor : recipe.anchors) {
        for (const glm::ivec3 node : nodes_in(Place(anchor, domain, gradings), nodes, domain, anchor.where)) {
            for (const char axis : anchor.fix) {
                if (axis - 'x' < static_cast<int>(Dim))
                    topology.body.fixed[nodes.number(node)] = static_cast<std::uint8_t>(
                        topology.body.fixed[nodes.number(node)] | 1 << (axis - 'x'));
            }
        }
    }
    std::map<std::string, std::size_t> case_of;
    for (const LoadRecipe& load : recipe.loads) {
        const auto [found, is_new] = case_of.emplace(load.load_case, topology.cases.size());
        if (is_new)
            topology.cases.push_back({load.load_case, load.weight, NodalVector<Dim, double>(grid.size())});
        NodalVector<Dim, double>& forces = topology.cases[found->second].forces;
        const std::vector<glm::ivec3> at = nodes_in(Place(load, domain, gradings), nodes, domain, load.where);
        if (load.pressure > 0) {
            add_pressure(at, nodes, domain, load.pressure, load.where, forces);
        } else {
            add_force(at, nodes, filled, load.force, forces);
        }
    }
    const dvec3 gravity = recipe.optimize ? recipe.optimize->gravity : dvec3(0);
    const bool is_heavy = gravity != dvec3(0);
    if (is_heavy) {
        // g/cm^3 times mm^3 are milligrams; N = kg m/s^2.
        const double mass = 1e-6 * material.density * domain.element_volume();
        for (std::size_t d = 0; d < Dim; ++d) topology.weight[d] = mass * gravity[static_cast<int>(d)];
        if (topology.cases.empty())
            topology.cases.push_back({"weight", 1, NodalVector<Dim, double>(grid.size())});
    }
    problem.loaded = elements_touching(nodes, domain, [&](std::size_t node) {
        return std::ranges::any_of(topology.cases, [&](const LoadCase<Dim>& load) {
            return std::ranges::any_of(load.forces.along,
                                       [&](const auto& along) { return along[node] != 0; });
        });
    });
    problem.anchored =
        elements_touching(nodes, domain, [&](std::size_t node) { return topology.body.fixed[node] != 0; });
    check_pieces(nodes, domain, is_heavy, problem);
    topology.use = domain.use;
    return problem;
}

template StructuralProblem<2> structural_problem<2>(const Recipe&, ElementDomain&, Gradings&, double,
                                                    const FilledElements&);
template StructuralProblem<3> structural_problem<3>(const Recipe&, ElementDomain&, Gradings&, double,
                                                    const FilledElements&);

}  // namespace lamella
