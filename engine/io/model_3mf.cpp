// Parts, placements and meshes of the core specification, with the paths of the production extension.
#include "engine/io/model_3mf.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lamella {

namespace {

constexpr std::size_t max_instances = 1'000'000;
constexpr std::size_t max_looked_at = 30'000'000;  // a million instances of usual objects have ten million
constexpr std::size_t max_placed = 50'000'000;     // vertices, and triangles
constexpr int deepest_component = 32;
constexpr std::array<std::string_view, 3> field_extensions{"/volumetric/", "/implicit/", "/beamlattice/"};

std::string_view prefix(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == name.npos ? std::string_view() : name.substr(0, colon);
}

/// Returns the next element of that name from `node` on, `node` included, in the namespace of `like`.
pugi::xml_node element(pugi::xml_node node, std::string_view name, const pugi::xml_node& like) {
    while (node && !(local_name(node) == name && prefix(node) == prefix(like))) node = node.next_sibling();
    return node;
}

double millimetres_of(const MeshSource& source, std::string_view unit) {
    if (unit.empty() || unit == "millimeter") return 1.0;
    if (unit == "micron") return 0.001;
    if (unit == "centimeter") return 10.0;
    if (unit == "inch") return 25.4;
    if (unit == "foot") return 304.8;
    if (unit == "meter") return 1000.0;
    reject(source, "unknown unit " + excerpt(unit) +
                       "; 3MF knows micron, millimeter, centimeter, inch, foot and meter");
}

std::string where(const ModelPart& in, const pugi::xml_node& node) {
    return "part " + excerpt(in.name) + ", byte " + std::to_string(node.offset_debug());
}

double coordinate(const Model3mf& model, const ModelPart& in, const pugi::xml_node& vertex,
                  const char* axis) {
    const char* const text = vertex.attribute(axis).value();
    const auto number = parse_double(text);
    if (!number)
        model.reject_at(in, vertex, std::string(axis) + "=" + excerpt(text) + " of a vertex is not a number");
    return *number;
}

std::uint32_t corner(const Model3mf& model, const ModelPart& in, const pugi::xml_node& triangle,
                     const char* key) {
    const char* const text = triangle.attribute(key).value();
    const auto index = parse_integer(text);
    if (!index)
        model.reject_at(in, triangle,
                        std::string(key) + "=" + excerpt(text) + " of a triangle is not a vertex number");
    return *index < 0 || *index >= MeshWelder::unusable ? MeshWelder::unusable
                                                        : static_cast<std::uint32_t>(*index);
}

}  // namespace

dvec3 Transform3mf::operator()(dvec3 p) const {
    return {p.x * m[0] + p.y * m[3] + p.z * m[6] + m[9], p.x * m[1] + p.y * m[4] + p.z * m[7] + m[10],
            p.x * m[2] + p.y * m[5] + p.z * m[8] + m[11]};
}

double Transform3mf::determinant() const {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
           m[2] * (m[3] * m[7] - m[4] * m[6]);
}

Transform3mf Transform3mf::then(const Transform3mf& outer) const {
    const Transform3mf linear{{outer.m[0], outer.m[1], outer.m[2], outer.m[3], outer.m[4], outer.m[5],
                               outer.m[6], outer.m[7], outer.m[8], 0, 0, 0}};
    Transform3mf out;
    for (std::size_t row = 0; row < 4; ++row) {
        const dvec3 from(m[3 * row], m[3 * row + 1], m[3 * row + 2]);
        const dvec3 to = row < 3 ? linear(from) : outer(from);
        out.m[3 * row] = to.x;
        out.m[3 * row + 1] = to.y;
        out.m[3 * row + 2] = to.z;
    }
    return out;
}

Transform3mf Transform3mf::inverse() const {
    const double d = determinant();
    Transform3mf out;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            // The cofactor of (column, row); cyclic order of the remaining rows and columns gives it the
            // right sign.
            const std::size_t r1 = (column + 1) % 3, r2 = (column + 2) % 3;
            const std::size_t c1 = (row + 1) % 3, c2 = (row + 2) % 3;
            const double cofactor = m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
            out.m[3 * row + column] = cofactor == 0 ? 0 : cofactor / d;
        }
    }
    const Transform3mf linear{
        {out.m[0], out.m[1], out.m[2], out.m[3], out.m[4], out.m[5], out.m[6], out.m[7], out.m[8], 0, 0, 0}};
    const dvec3 back = linear({m[9], m[10], m[11]});
    for (std::size_t i = 0; i < 3; ++i) {
        const double shift = back[static_cast<int>(i)];
        out.m[9 + i] = shift == 0 ? 0 : -shift;
    }
    return out;
}

std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == name.npos ? name : name.substr(colon + 1);
}

pugi::xml_node core_child(const pugi::xml_node& parent, std::string_view name) {
    return element(parent.first_child(), name, parent);
}

pugi::xml_node next_alike(const pugi::xml_node& node) {
    return element(node.next_sibling(), local_name(node), node);
}

std::string_view namespace_of(const pugi::xml_node& node) {
    const std::string_view own = prefix(node);
    const std::string declaration = own.empty() ? "xmlns" : "xmlns:" + std::string(own);
    for (pugi::xml_node at = node; at; at = at.parent()) {
        if (const pugi::xml_attribute found = at.attribute(declaration.c_str())) return found.value();
    }
    return {};
}

std::string_view attribute_of(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
        std::string_view key = attribute.name();
        if (const std::size_t colon = key.find(':'); colon != key.npos) key.remove_prefix(colon + 1);
        if (key == name) return attribute.value();
    }
    return {};
}

Model3mf::Model3mf(const MeshSource& source, std::span<const std::string_view> supported)
    : source_(source), package_(source), root_(root_part()) {
    const ModelPart& model = part(root_);
    unit_mm_ = millimetres_of(source_, model.model.attribute("unit").value());
    require_extensions(model.model, supported);
}

std::string Model3mf::root_part() {
    std::string fallback = "3D/3dmodel.model";
    if (!package_.has("_rels/.rels")) return fallback;
    std::string text = package_.read("_rels/.rels");
    pugi::xml_document xml;
    if (!xml.load_buffer_inplace(text.data(), text.size())) return fallback;
    for (const pugi::xml_node& relation : xml.document_element().children()) {
        const std::string_view type = relation.attribute("Type").value();
        if (type.ends_with("/3dmodel")) return part_name(relation.attribute("Target").value());
    }
    return fallback;
}

const ModelPart& Model3mf::part(const std::string& name) {
    const auto known = parts_.find(name);
    if (known != parts_.end()) return *known->second;
    auto fresh = std::make_unique<ModelPart>();
    fresh->name = name;
    fresh->text = package_.read(name);
    package_.account(fresh->text.size());
    const pugi::xml_parse_result parsed =
        fresh->xml.load_buffer_inplace(fresh->text.data(), fresh->text.size());
    if (!parsed) {
        reject(source_, "part " + excerpt(name) + ", byte " + std::to_string(parsed.offset) +
                            ": not well-formed XML (" + parsed.description() + ")");
    }
    fresh->model = fresh->xml.document_element();
    if (local_name(fresh->model) != "model")
        reject(source_, "part " + excerpt(name) + " is no 3MF model: its first element is " +
                            excerpt(fresh->model.name()));
    for (pugi::xml_node object = core_child(core_child(fresh->model, "resources"), "object"); object;
         object = next_alike(object)) {
        fresh->objects.emplace(object.attribute("id").value(), object);
    }
    return *parts_.emplace(name, std::move(fresh)).first->second;
}

/// Throws InputError when the file requires an extension whose namespace contains none of `supported`.
void Model3mf::require_extensions(const pugi::xml_node& model,
                                  std::span<const std::string_view> supported) const {
    TextCursor wanted(model.attribute("requiredextensions").value());
    for (std::string_view name = wanted.token(); !name.empty(); name = wanted.token()) {
        const std::string_view uri = model.attribute(("xmlns:" + std::string(name)).c_str()).value();
        const bool known = std::any_of(supported.begin(), supported.end(), [&](std::string_view part_of) {
            return uri.find(part_of) != uri.npos;
        });
        if (known) continue;
        const bool field =
            std::any_of(field_extensions.begin(), field_extensions.end(),
                        [&](std::string_view part_of) { return uri.find(part_of) != uri.npos; });
        reject(source_, "it requires the 3MF extension " + excerpt(name) + " (" +
                            std::string(uri.substr(0, 100)) + "), which " +
                            (field ? "is no mesh; a [[field]] of kind 3mf reads it"
                                   : "is not supported; export it as plain triangles"));
    }
}

void Model3mf::require_items() {
    if (!core_child(core_child(root().model, "build"), "item"))
        reject(source_, "its build section lists no items, so there is nothing to print");
}

void Model3mf::for_each_placed(const std::function<void(const PlacedObject&)>& visit) {
    not_printable_ = other_types_ = instances_ = looked_at_ = 0;
    open_.clear();
    const ModelPart& from = root();
    for (pugi::xml_node item = core_child(core_child(from.model, "build"), "item"); item;
         item = next_alike(item)) {
        const std::string_view printable = item.attribute("printable").value();
        if (printable == "0" || printable == "false") {
            ++not_printable_;
        } else {
            place(from, item, Transform3mf(), 0, visit);
        }
    }
}

std::vector<std::string> Model3mf::left_out() const {
    std::vector<std::string> notes;
    note_left_out(notes, not_printable_, "build item", "marked as not to be printed");
    note_left_out(notes, other_types_, "object", "support or of another type that is not a part");
    return notes;
}

/// Visits the object that a build item or a component refers to.
void Model3mf::place(const ModelPart& from, const pugi::xml_node& reference, const Transform3mf& outer,
                     int depth, const std::function<void(const PlacedObject&)>& visit) {
    if (depth > deepest_component) reject(source_, "components are nested more than 32 deep");
    if (++instances_ > max_instances) reject(source_, "it places more than 1,000,000 components");
    const std::string_view path = attribute_of(reference, "path");
    const ModelPart& in = path.empty() ? from : part(part_name(path));
    const std::string_view id = reference.attribute("objectid").value();
    const auto found = in.objects.find(id);
    if (found == in.objects.end())
        reject_at(from, reference, "object " + excerpt(id) + " is referred to but does not exist");
    const pugi::xml_node object = found->second;
    const std::string_view type = object.attribute("type").value();
    if (!type.empty() && type != "model" && type != "surface") {
        ++other_types_;
        return;
    }
    visit_object({in, object, transform_of(from, reference).then(outer)}, depth, visit);
}

void Model3mf::visit_object(const PlacedObject& placed, int depth,
                            const std::function<void(const PlacedObject&)>& visit) {
    looked_at_ += elements_of(placed.object);
    if (looked_at_ > max_looked_at) {
        reject(source_,
               "with every component written out, its objects have more than 30,000,000 elements beside "
               "vertices and triangles");
    }
    visit(placed);
    const pugi::xml_node components = core_child(placed.object, "components");
    if (!components) return;
    if (!open_.insert(placed.object.internal_object()).second) {
        reject_at(placed.part, placed.object,
                  "object " + excerpt(placed.object.attribute("id").value()) + " contains itself");
    }
    for (pugi::xml_node part_of = core_child(components, "component"); part_of; part_of = next_alike(part_of))
        place(placed.part, part_of, placed.transform, depth + 1, visit);
    open_.erase(placed.object.internal_object());
}

/// Returns how many elements and attributes are looked through at a visit of an object: its own, and those
/// one level below.
std::size_t Model3mf::elements_of(const pugi::xml_node& object) {
    const auto attributes = [](const pugi::xml_node& node) {
        return static_cast<std::size_t>(std::distance(node.attributes_begin(), node.attributes_end()));
    };
    const auto [entry, fresh] = elements_.try_emplace(object.internal_object(), 1);
    if (!fresh) return entry->second;
    entry->second += attributes(object);
    for (const pugi::xml_node& child : object.children()) {
        entry->second += 1 + attributes(child);
        for (const pugi::xml_node& below : child.children()) entry->second += 1 + attributes(below);
    }
    return entry->second;
}

void Model3mf::for_each_within(const PlacedObject& object,
                               const std::function<void(const PlacedObject&)>& visit) {
    instances_ = looked_at_ = 0;
    open_.clear();
    visit_object(object, 0, visit);
}

Transform3mf Model3mf::transform_of(const ModelPart& in, const pugi::xml_node& node) const {
    Transform3mf transform;
    const std::string_view text = attribute_of(node, "transform");
    if (text.empty()) return transform;
    TextCursor numbers(text);
    for (double& m : transform.m) {
        const auto number = parse_double(numbers.token());
        if (!number) reject_at(in, node, "a transform is 12 numbers, not " + excerpt(text));
        m = *number;
    }
    const double determinant = transform.determinant();
    if (determinant == 0.0 || !std::isfinite(determinant))
        reject_at(in, node, "the transform " + excerpt(text) + " flattens the object");
    return transform;
}

void Model3mf::reject_at(const ModelPart& in, const pugi::xml_node& node, const std::string& what) const {
    reject(source_, where(in, node) + ": " + what);
}

ObjectMesh read_object_mesh(const Model3mf& model, const ModelPart& in, const pugi::xml_node& mesh) {
    ObjectMesh out;
    for (pugi::xml_node v = core_child(core_child(mesh, "vertices"), "vertex"); v; v = next_alike(v)) {
        out.vertices.emplace_back(coordinate(model, in, v, "x"), coordinate(model, in, v, "y"),
                                  coordinate(model, in, v, "z"));
    }
    for (pugi::xml_node t = core_child(core_child(mesh, "triangles"), "triangle"); t; t = next_alike(t))
        out.triangles.push_back(
            {corner(model, in, t, "v1"), corner(model, in, t, "v2"), corner(model, in, t, "v3")});
    return out;
}

void PlacedSize::add(const MeshSource& source, const ObjectMesh& mesh) {
    vertices_ += mesh.vertices.size();
    triangles_ += mesh.triangles.size();
    if (triangles_ > max_placed) reject(source, "it places more than 50,000,000 triangles");
    if (vertices_ > max_placed) reject(source, "it places more than 50,000,000 vertices");
}

void note_left_out(std::vector<std::string>& notes, std::size_t count, const std::string& noun,
                   const std::string& why) {
    if (count == 0) return;
    notes.push_back(counted(count, noun) + (count == 1 ? " is " : " are ") + why + " and " +
                    (count == 1 ? "was" : "were") + " left out");
}

}  // namespace lamella
