// Model3mf: the XML of a 3MF file, with its model parts and the objects that its build section places.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/opc_package.h"

namespace lamella {

/// Affine map p' = p M with the last row as translation, as 3MF writes it.
struct Transform3mf {
    std::array<double, 12> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

    dvec3 operator()(dvec3 p) const;
    double determinant() const;
    /// Returns the composition: first this map, then `outer`.
    Transform3mf then(const Transform3mf& outer) const;
    /// Returns the inverse; the determinant must not be zero.
    Transform3mf inverse() const;
    friend bool operator==(const Transform3mf&, const Transform3mf&) = default;
};

/// A model part: its XML, and its objects by id.
struct ModelPart {
    std::string name;
    std::string text;  // parsed in place
    pugi::xml_document xml;
    pugi::xml_node model;
    std::map<std::string, pugi::xml_node, std::less<>> objects;
};

/// An object that the build section places, directly or as a component of others.
struct PlacedObject {
    const ModelPart& part;
    pugi::xml_node object;
    Transform3mf transform;  ///< from the object to the build platform, in the model's unit
};

/// Reads a package's model parts on demand. Throws InputError for every error, with the file, the part and
/// the byte.
class Model3mf {
  public:
    /// A file may require extensions. Throws InputError unless the namespace of each contains one of
    /// `supported` ("/production/").
    Model3mf(const MeshSource& source, std::span<const std::string_view> supported);

    const MeshSource& source() const { return source_; }
    OpcPackage& package() { return package_; }
    const ModelPart& root() { return part(root_); }
    double unit_mm() const { return unit_mm_; }
    const ModelPart& part(const std::string& name);

    /// Throws InputError when the build section has no items.
    void require_items();
    /// Calls visit for every printable object of the build section, in order, and after it for every
    /// component of it.
    void for_each_placed(const std::function<void(const PlacedObject&)>& visit);
    /// Calls visit for one object and its components.
    void for_each_within(const PlacedObject& object, const std::function<void(const PlacedObject&)>& visit);
    /// Returns notes for the user about skipped objects: items that are not to be printed, supports.
    std::vector<std::string> left_out() const;

    /// Returns the transform of an attribute; the identity without one. Throws InputError if it is singular.
    Transform3mf transform_of(const ModelPart& in, const pugi::xml_node& node) const;
    /// Throws InputError("file: part, byte: what").
    [[noreturn]] void reject_at(const ModelPart& in, const pugi::xml_node& node,
                                const std::string& what) const;

  private:
    std::string root_part();
    void require_extensions(const pugi::xml_node& model, std::span<const std::string_view> supported) const;
    void place(const ModelPart& from, const pugi::xml_node& reference, const Transform3mf& outer, int depth,
               const std::function<void(const PlacedObject&)>& visit);
    void visit_object(const PlacedObject& placed, int depth,
                      const std::function<void(const PlacedObject&)>& visit);
    std::size_t elements_of(const pugi::xml_node& object);

    const MeshSource& source_;
    OpcPackage package_;
    std::string root_;
    double unit_mm_ = 1.0;
    std::map<std::string, std::unique_ptr<ModelPart>> parts_;
    std::set<const void*> open_;
    std::map<const void*, std::size_t> elements_;  ///< of objects that were visited
    std::size_t instances_ = 0;
    std::size_t looked_at_ = 0;  ///< elements, once for every instance
    std::size_t not_printable_ = 0;
    std::size_t other_types_ = 0;
};

/// Returns an element's name without its prefix.
std::string_view local_name(const pugi::xml_node& node);
/// Return the first child of that name in the parent's namespace, and the next sibling with a node's own
/// name.
pugi::xml_node core_child(const pugi::xml_node& parent, std::string_view name);
pugi::xml_node next_alike(const pugi::xml_node& node);
/// Returns the namespace of an element; empty when it is not declared.
std::string_view namespace_of(const pugi::xml_node& node);
/// Returns the value of an attribute, found by its name without prefix; empty when there is none.
std::string_view attribute_of(const pugi::xml_node& node, std::string_view name);

/// The vertices and triangles of a <mesh> as stored in the file.
struct ObjectMesh {
    std::vector<dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices may be out of range
};
ObjectMesh read_object_mesh(const Model3mf& model, const ModelPart& in, const pugi::xml_node& mesh);

/// Counts the vertices and triangles that a file places. Components multiply them: a small file may place
/// more than fits in memory.
class PlacedSize {
  public:
    /// Throws InputError when there are more than 50 million of either.
    void add(const MeshSource& source, const ObjectMesh& mesh);

  private:
    std::size_t vertices_ = 0, triangles_ = 0;
};

/// Appends the note "1 triangle is ... and was left out"; nothing when the count is 0.
void note_left_out(std::vector<std::string>& notes, std::size_t count, const std::string& noun,
                   const std::string& why);

}  // namespace lamella
