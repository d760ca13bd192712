// 3MF: triangles of the core specification's objects, placed by build items and components.
#include <algorithm>
#include <map>
#include <optional>

#include "engine/io/beam_lattice_3mf.h"
#include "engine/io/model_3mf.h"

namespace lamella {

namespace {

constexpr std::string_view harmless[] = {"/production/", "/material/", "/trianglesets/"};

class Reader3mf {
  public:
    explicit Reader3mf(const MeshSource& source) : source_(source), model_(source, harmless) {}

    MeshFile read() {
        model_.require_items();
        model_.for_each_placed([this](const PlacedObject& placed) {
            const Shapes& shapes = shapes_of(placed);
            beams_ += shapes.beams;
            if (other_shapes_ == 0) other_shape_ = shapes.other;
            other_shapes_ += shapes.others;
            if (shapes.mesh) add(placed, *shapes.mesh);
        });
        std::vector<std::string> notes = model_.left_out();
        note_left_out(notes, outside_, "triangle", "pointing to vertices that do not exist");
        if (beams_ > 0) {
            notes.push_back("its lattice of " + counted(beams_, "beam") +
                            " is no mesh and was left out; a [[field]] of kind 3mf reads it");
        }
        if (other_shapes_ > 0) {
            notes.push_back(counted(other_shapes_, "shape") + " of a kind that is not read (" + other_shape_ +
                            ") " + (other_shapes_ == 1 ? "was" : "were") + " left out");
        }
        return welder_.finish(source_, std::move(notes));
    }

  private:
    /// What an object has, read at its first instance.
    struct Shapes {
        std::optional<ObjectMesh> mesh;
        std::size_t beams = 0;   ///< of a lattice
        std::size_t others = 0;  ///< elements of extensions that are not known
        std::string other;       ///< name of the first one
    };

    const Shapes& shapes_of(const PlacedObject& placed) {
        const auto [entry, fresh] = shapes_.try_emplace(placed.object.internal_object());
        Shapes& shapes = entry->second;
        if (!fresh) return shapes;
        look_for_other_shapes(placed, shapes);
        if (const pugi::xml_node mesh = core_child(placed.object, "mesh"))
            shapes.mesh = read_object_mesh(model_, placed.part, mesh);
        return shapes;
    }

    /// An object may have shapes of extensions, beside its mesh or instead of it.
    void look_for_other_shapes(const PlacedObject& placed, Shapes& shapes) const {
        for (const pugi::xml_node& child : placed.object.children()) {
            if (local_name(child) == "levelset" &&
                namespace_of(child).find("/volumetric/") != std::string::npos)
                model_.reject_at(placed.part, child,
                                 "a level set is no mesh; a [[field]] of kind 3mf reads it");
        }
        const pugi::xml_node mesh = core_child(placed.object, "mesh");
        if (const pugi::xml_node lattice = lattice_node(mesh)) shapes.beams = count_beams(lattice);
        count_others(placed.object, {"mesh", "components", "metadatagroup"}, shapes);
        count_others(mesh, {"vertices", "triangles", "trianglesets", "beamlattice", "metadatagroup"}, shapes);
    }

    static void count_others(const pugi::xml_node& parent, std::initializer_list<std::string_view> known,
                             Shapes& shapes) {
        for (const pugi::xml_node& child : parent.children()) {
            if (child.type() != pugi::node_element) continue;
            if (std::find(known.begin(), known.end(), local_name(child)) != known.end()) continue;
            if (shapes.others++ == 0) shapes.other = excerpt(local_name(child));
        }
    }

    void add(const PlacedObject& placed, const ObjectMesh& mesh) {
        size_.add(source_, mesh);
        std::vector<std::uint32_t> welded;
        welded.reserve(mesh.vertices.size());
        for (const dvec3& p : mesh.vertices)
            welded.push_back(welder_.vertex(placed.transform(p) * model_.unit_mm()));
        const bool mirrored = placed.transform.determinant() < 0.0;
        for (const auto& [a, b, c] : mesh.triangles) {
            if (std::max({a, b, c}) >= welded.size()) {
                ++outside_;
            } else if (mirrored) {
                welder_.triangle(welded[a], welded[c], welded[b]);
            } else {
                welder_.triangle(welded[a], welded[b], welded[c]);
            }
        }
    }

    const MeshSource& source_;
    Model3mf model_;
    std::map<const void*, Shapes> shapes_;  ///< of objects
    PlacedSize size_;
    MeshWelder welder_;
    std::size_t outside_ = 0;
    std::size_t beams_ = 0;         ///< of lattices
    std::size_t other_shapes_ = 0;  ///< elements of extensions that are not known
    std::string other_shape_;       ///< name of the first one
};

}  // namespace

MeshFile read_3mf(const MeshSource& source) { return Reader3mf(source).read(); }

}  // namespace lamella
