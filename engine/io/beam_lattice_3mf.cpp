// Reads attributes by their local names: balls have a namespace of their own.
#include "engine/io/beam_lattice_3mf.h"

#include <algorithm>
#include <optional>

#include "engine/mesh/mesh.h"

namespace lamella {
namespace {

constexpr std::string_view extension = "/beamlattice/";

bool is_of_lattice(const pugi::xml_node& node) {
    return namespace_of(node).find(extension) != std::string_view::npos;
}

/// Returns the first child of that name that belongs to the extension.
pugi::xml_node lattice_child(const pugi::xml_node& parent, std::string_view name) {
    for (const pugi::xml_node& child : parent.children()) {
        if (local_name(child) == name && is_of_lattice(child)) return child;
    }
    return {};
}

class LatticeReader {
  public:
    LatticeReader(const Model3mf& model, const ModelPart& in, const pugi::xml_node& lattice,
                  std::size_t vertex_count)
        : model_(model), in_(in), lattice_(lattice), vertex_count_(vertex_count) {}

    LatticeOfMesh read() {
        radius_ = radius(lattice_, "radius");
        cap_ = cap(lattice_, "cap", BeamCap::sphere);
        for (const pugi::xml_node& beam : lattice_child(lattice_, "beams").children()) {
            if (local_name(beam) == "beam") out_.beams.push_back(read_beam(beam));
        }
        if (out_.beams.empty()) reject(lattice_, "it has no beams");
        read_balls();
        read_clipping();
        return std::move(out_);
    }

  private:
    [[noreturn]] void reject(const pugi::xml_node& node, const std::string& what) const {
        model_.reject_at(in_, node, std::string(local_name(node)) + ": " + what);
    }

    template <typename Enum>
    Enum word(const pugi::xml_node& node, std::string_view name, Enum fallback,
              std::initializer_list<std::pair<std::string_view, Enum>> words) const {
        const std::string_view text = attribute_of(node, name);
        if (text.empty()) return fallback;
        std::string known;
        for (const auto& [key, value] : words) {
            if (text == key) return value;
            known += (known.empty() ? "" : ", ") + std::string(key);
        }
        reject(node, std::string(name) + "=" + excerpt(text) + " is unknown; known: " + known);
    }

    BeamCap cap(const pugi::xml_node& node, std::string_view name, BeamCap fallback) const {
        return word<BeamCap>(
            node, name, fallback,
            {{"sphere", BeamCap::sphere}, {"hemisphere", BeamCap::hemisphere}, {"butt", BeamCap::butt}});
    }

    /// Returns a positive number; `fallback` if there is no such attribute.
    double radius(const pugi::xml_node& node, std::string_view name,
                  std::optional<double> fallback = {}) const {
        const std::string_view text = attribute_of(node, name);
        if (text.empty() && fallback) return *fallback;
        const auto number = parse_double(text);
        if (!number || !(*number > 0 && *number <= max_coordinate))
            reject(node, std::string(name) + "=" + excerpt(text) + " is no radius; it must be above 0");
        return *number;
    }

    std::uint32_t vertex(const pugi::xml_node& node, std::string_view name) const {
        const std::string_view text = attribute_of(node, name);
        const auto index = parse_integer(text);
        if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= vertex_count_) {
            reject(node, std::string(name) + "=" + excerpt(text) + " is no vertex of its mesh, which has " +
                             grouped(vertex_count_));
        }
        return static_cast<std::uint32_t>(*index);
    }

    LatticeBeam read_beam(const pugi::xml_node& node) const {
        LatticeBeam beam;
        beam.vertices = {vertex(node, "v1"), vertex(node, "v2")};
        if (beam.vertices[0] == beam.vertices[1]) reject(node, "both of its ends are one vertex");
        const bool first = !attribute_of(node, "r1").empty();
        if (!first && !attribute_of(node, "r2").empty()) reject(node, "it has r2 without r1");
        beam.radii[0] = radius(node, "r1", radius_);
        beam.radii[1] = radius(node, "r2", beam.radii[0]);
        beam.caps = {cap(node, "cap1", cap_), cap(node, "cap2", cap_)};
        return beam;
    }

    /// Mode `all` puts a ball at every end of a beam, `mixed` only where a <ball> says so.
    void read_balls() {
        enum class Mode : std::uint8_t { none, mixed, all };
        const Mode mode = word<Mode>(lattice_, "ballmode", Mode::none,
                                     {{"none", Mode::none}, {"mixed", Mode::mixed}, {"all", Mode::all}});
        if (mode == Mode::none) return;
        const double common = radius(lattice_, "ballradius");
        std::vector<double> radii(vertex_count_, 0.0);
        if (mode == Mode::all) {
            for (const LatticeBeam& beam : out_.beams) {
                for (const std::uint32_t end : beam.vertices) radii[end] = common;
            }
        }
        for (const pugi::xml_node& ball : lattice_child(lattice_, "balls").children()) {
            if (local_name(ball) == "ball") radii[vertex(ball, "vindex")] = radius(ball, "r", common);
        }
        for (std::uint32_t i = 0; i < radii.size(); ++i) {
            if (radii[i] > 0) out_.balls.push_back({i, radii[i]});
        }
    }

    void read_clipping() {
        out_.clipping = word<LatticeClipping>(lattice_, "clippingmode", LatticeClipping::none,
                                              {{"none", LatticeClipping::none},
                                               {"inside", LatticeClipping::inside},
                                               {"outside", LatticeClipping::outside}});
        if (out_.clipping == LatticeClipping::none) return;
        const std::string_view text = attribute_of(lattice_, "clippingmesh");
        const auto object = parse_integer(text);
        if (!object || *object < 1)
            reject(lattice_, "clippingmesh=" + excerpt(text) + " is no object, and clippingmode needs one");
        out_.clipping_mesh = *object;
    }

    const Model3mf& model_;
    const ModelPart& in_;
    pugi::xml_node lattice_;
    std::size_t vertex_count_;
    double radius_ = 0;
    BeamCap cap_ = BeamCap::sphere;
    LatticeOfMesh out_;
};

}  // namespace

pugi::xml_node lattice_node(const pugi::xml_node& mesh) { return lattice_child(mesh, "beamlattice"); }

std::size_t count_beams(const pugi::xml_node& lattice) {
    const auto beams = lattice_child(lattice, "beams").children();
    return static_cast<std::size_t>(std::count_if(
        beams.begin(), beams.end(), [](const pugi::xml_node& beam) { return local_name(beam) == "beam"; }));
}

LatticeOfMesh read_lattice(const Model3mf& model, const ModelPart& in, const pugi::xml_node& lattice,
                           std::size_t vertex_count) {
    return LatticeReader(model, in, lattice, vertex_count).read();
}

}  // namespace lamella
