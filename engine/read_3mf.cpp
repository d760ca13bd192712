// 3MF: the core specification with build items, components and transforms, and the production extension's
// paths.
#include <zip.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <set>

#include "engine/mesh_source.h"

namespace lamella {

namespace {

constexpr std::size_t most_part_bytes = std::size_t{512} << 20U;
constexpr std::size_t most_triangles = 50'000'000;
constexpr std::size_t most_instances = 1'000'000;
constexpr int deepest_component = 32;

/// The ZIP package, open for reading from memory.
class Package {
  public:
    explicit Package(const MeshSource& source) : source_(source) {
        zip_error_t error;
        zip_error_init(&error);
        zip_source_t* bytes = zip_source_buffer_create(source.bytes.data(), source.bytes.size(), 0, &error);
        if (bytes != nullptr) zip_.reset(zip_open_from_source(bytes, ZIP_RDONLY, &error));
        const std::string why = zip_error_strerror(&error);
        zip_error_fini(&error);
        if (!zip_) {
            if (bytes != nullptr) zip_source_free(bytes);
            reject(source, "a 3MF file is a ZIP archive, and this one cannot be opened (" + why +
                               "); the file is damaged or cut off");
        }
    }

    bool has(const std::string& part) const {
        return zip_name_locate(zip_.get(), part.c_str(), ZIP_FL_NOCASE) >= 0;
    }

    /// A part's content, its size bounded: a small archive can unpack to more than any memory.
    std::string read(const std::string& part) {
        const zip_int64_t index = zip_name_locate(zip_.get(), part.c_str(), ZIP_FL_NOCASE);
        if (index < 0) reject(source_, "the archive has no part " + quoted(part));
        std::unique_ptr<zip_file_t, void (*)(zip_file_t*)> file(
            zip_fopen_index(zip_.get(), static_cast<zip_uint64_t>(index), 0), [](zip_file_t* f) {
                if (f != nullptr) zip_fclose(f);
            });
        if (!file)
            reject(source_,
                   "part " + quoted(part) + " cannot be unpacked (" + zip_strerror(zip_.get()) + ")");
        std::string text;
        constexpr std::size_t step = std::size_t{1} << 20U;
        for (std::size_t used = 0;; used = text.size()) {
            text.resize(used + step);
            const zip_int64_t got = zip_fread(file.get(), text.data() + used, step);
            if (got < 0)
                reject(source_, "part " + quoted(part) + " cannot be unpacked (" +
                                    zip_file_strerror(file.get()) + "); the file is damaged or cut off");
            text.resize(used + static_cast<std::size_t>(got));
            if (got == 0) return text;
            if (text.size() > unpacked_left_) {
                reject(source_, "it unpacks to more than 512 MiB, the most that is read from one 3MF file");
            }
        }
    }

    void account(std::size_t bytes) { unpacked_left_ -= std::min(bytes, unpacked_left_); }

  private:
    struct Discard {
        void operator()(zip_t* zip) const { zip_discard(zip); }
    };
    const MeshSource& source_;
    std::unique_ptr<zip_t, Discard> zip_;
    std::size_t unpacked_left_ = most_part_bytes;
};

/// p' = p M with the last row as translation, as 3MF writes it.
struct Transform {
    std::array<double, 12> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

    dvec3 operator()(dvec3 p) const {
        return {p.x * m[0] + p.y * m[3] + p.z * m[6] + m[9], p.x * m[1] + p.y * m[4] + p.z * m[7] + m[10],
                p.x * m[2] + p.y * m[5] + p.z * m[8] + m[11]};
    }
    double determinant() const {
        return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
               m[2] * (m[3] * m[7] - m[4] * m[6]);
    }
    /// First this, then `outer`.
    Transform then(const Transform& outer) const {
        const Transform linear{{outer.m[0], outer.m[1], outer.m[2], outer.m[3], outer.m[4], outer.m[5],
                                outer.m[6], outer.m[7], outer.m[8], 0, 0, 0}};
        Transform out;
        for (std::size_t row = 0; row < 4; ++row) {
            const dvec3 from(m[3 * row], m[3 * row + 1], m[3 * row + 2]);
            const dvec3 to = row < 3 ? linear(from) : outer(from);
            out.m[3 * row] = to.x;
            out.m[3 * row + 1] = to.y;
            out.m[3 * row + 2] = to.z;
        }
        return out;
    }
};

std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == name.npos ? name : name.substr(colon + 1);
}

std::string_view prefix(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == name.npos ? std::string_view() : name.substr(0, colon);
}

/// The next element of that name from `node` on, `node` included, in the namespace of `like`.
pugi::xml_node element(pugi::xml_node node, std::string_view name, const pugi::xml_node& like) {
    while (node && !(local_name(node) == name && prefix(node) == prefix(like))) node = node.next_sibling();
    return node;
}

pugi::xml_node child(const pugi::xml_node& parent, std::string_view name) {
    return element(parent.first_child(), name, parent);
}
pugi::xml_node next(const pugi::xml_node& node) {
    return element(node.next_sibling(), local_name(node), node);
}

/// The value of the production extension's path attribute, whatever its prefix.
std::string_view path_attribute(const pugi::xml_node& node) {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
        const std::string_view name = attribute.name();
        if (name == "path" || name.ends_with(":path")) return attribute.value();
    }
    return {};
}

std::string part_name(std::string_view target) {
    while (!target.empty() && target.front() == '/') target.remove_prefix(1);
    return std::string(target);
}

double unit_mm(const MeshSource& source, std::string_view unit) {
    if (unit.empty() || unit == "millimeter") return 1.0;
    if (unit == "micron") return 0.001;
    if (unit == "centimeter") return 10.0;
    if (unit == "inch") return 25.4;
    if (unit == "foot") return 304.8;
    if (unit == "meter") return 1000.0;
    reject(source, "unknown unit " + quoted(unit) +
                       "; 3MF knows micron, millimeter, centimeter, inch, foot and meter");
}

/// One model part: its XML, and its objects by id.
struct ModelPart {
    std::string name;
    std::string text;  // parsed in place
    pugi::xml_document xml;
    pugi::xml_node model;
    std::map<std::string, pugi::xml_node, std::less<>> objects;
};

/// An object's own triangles, as they stand in the file.
struct ObjectMesh {
    std::vector<dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

class Reader3mf {
  public:
    explicit Reader3mf(const MeshSource& source) : source_(source), package_(source) {}

    MeshFile read() {
        ModelPart& root = part(root_part());
        unit_mm_ = unit_mm(source_, root.model.attribute("unit").value());
        refuse_unknown_extensions(root.model);
        std::size_t items = 0;
        for (pugi::xml_node item = child(child(root.model, "build"), "item"); item;
             item = next(item), ++items) {
            const std::string_view printable = item.attribute("printable").value();
            if (printable == "0" || printable == "false") {
                ++not_printable_;
            } else {
                place(root, item, Transform(), 0);
            }
        }
        if (items == 0) reject(source_, "its build section lists no items, so there is nothing to print");
        note(not_printable_, "build item", "marked as not to be printed");
        note(other_types_, "object", "support or of another type that is not a part");
        note(outside_, "triangle", "pointing to vertices that do not exist");
        return welder_.finish(source_, std::move(notes_));
    }

  private:
    std::string root_part() {
        const std::string fallback = "3D/3dmodel.model";
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

    ModelPart& part(const std::string& name) {
        const auto known = parts_.find(name);
        if (known != parts_.end()) return *known->second;
        auto fresh = std::make_unique<ModelPart>();
        fresh->name = name;
        fresh->text = package_.read(name);
        package_.account(fresh->text.size());
        const pugi::xml_parse_result parsed =
            fresh->xml.load_buffer_inplace(fresh->text.data(), fresh->text.size());
        if (!parsed) {
            reject(source_, "part " + quoted(name) + ", byte " + std::to_string(parsed.offset) +
                                ": not well-formed XML (" + parsed.description() + ")");
        }
        fresh->model = fresh->xml.document_element();
        if (local_name(fresh->model) != "model")
            reject(source_, "part " + quoted(name) + " is no 3MF model: its first element is " +
                                quoted(fresh->model.name()));
        for (pugi::xml_node object = child(child(fresh->model, "resources"), "object"); object;
             object = next(object)) {
            fresh->objects.emplace(object.attribute("id").value(), object);
        }
        return *parts_.emplace(name, std::move(fresh)).first->second;
    }

    /// A file may demand extensions. Some do not change the shape; of the rest only production is known here.
    void refuse_unknown_extensions(const pugi::xml_node& model) const {
        TextCursor wanted(model.attribute("requiredextensions").value());
        for (std::string_view name = wanted.token(); !name.empty(); name = wanted.token()) {
            const std::string_view uri = model.attribute(("xmlns:" + std::string(name)).c_str()).value();
            const bool harmless = uri.find("/production/") != uri.npos ||
                                  uri.find("/material/") != uri.npos ||
                                  uri.find("/trianglesets/") != uri.npos;
            if (!harmless)
                reject(source_, "it requires the 3MF extension " + quoted(name) + " (" +
                                    std::string(uri.substr(0, 100)) +
                                    "), which is not supported; export it as plain triangles");
        }
    }

    /// Adds what a build item or a component refers to.
    void place(ModelPart& from, const pugi::xml_node& reference, const Transform& outer, int depth) {
        if (depth > deepest_component) reject(source_, "components are nested more than 32 deep");
        if (++instances_ > most_instances) reject(source_, "it places more than 1,000,000 components");
        const std::string_view path = path_attribute(reference);
        ModelPart& in = path.empty() ? from : part(part_name(path));
        const std::string_view id = reference.attribute("objectid").value();
        const auto found = in.objects.find(id);
        if (found == in.objects.end()) {
            reject(source_,
                   where(from, reference) + ": object " + quoted(id) + " is referred to but does not exist");
        }
        const pugi::xml_node object = found->second;
        const std::string_view type = object.attribute("type").value();
        if (!type.empty() && type != "model" && type != "surface") {
            ++other_types_;
            return;
        }
        const Transform transform = transform_of(from, reference).then(outer);
        if (const pugi::xml_node mesh = child(object, "mesh")) add(in, mesh, transform);
        const pugi::xml_node components = child(object, "components");
        if (!components) return;
        if (!open_.insert(object.internal_object()).second) {
            reject(source_, where(from, reference) + ": object " + quoted(id) + " contains itself");
        }
        for (pugi::xml_node part_of = child(components, "component"); part_of; part_of = next(part_of)) {
            place(in, part_of, transform, depth + 1);
        }
        open_.erase(object.internal_object());
    }

    Transform transform_of(const ModelPart& in, const pugi::xml_node& reference) const {
        Transform transform;
        const std::string_view text = reference.attribute("transform").value();
        if (text.empty()) return transform;
        TextCursor numbers(text);
        for (double& m : transform.m) {
            const auto number = parse_double(numbers.token());
            if (!number)
                reject(source_, where(in, reference) + ": a transform is 12 numbers, not " + quoted(text));
            m = *number;
        }
        const double determinant = transform.determinant();
        if (determinant == 0.0 || !std::isfinite(determinant)) {
            reject(source_,
                   where(in, reference) + ": the transform " + quoted(text) + " flattens the object");
        }
        return transform;
    }

    void add(const ModelPart& in, const pugi::xml_node& node, const Transform& transform) {
        const ObjectMesh& mesh = mesh_of(in, node);
        if (welder_.offered() + mesh.triangles.size() > most_triangles)
            reject(source_, "it places more than 50,000,000 triangles");
        std::vector<std::uint32_t> welded;
        welded.reserve(mesh.vertices.size());
        for (const dvec3& p : mesh.vertices) welded.push_back(welder_.vertex(transform(p) * unit_mm_));
        const bool mirrored = transform.determinant() < 0.0;
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

    const ObjectMesh& mesh_of(const ModelPart& in, const pugi::xml_node& node) {
        const auto [entry, fresh] = meshes_.try_emplace(node.internal_object());
        ObjectMesh& mesh = entry->second;
        if (!fresh) return mesh;
        for (pugi::xml_node v = child(child(node, "vertices"), "vertex"); v; v = next(v)) {
            mesh.vertices.emplace_back(coordinate(in, v, "x"), coordinate(in, v, "y"),
                                       coordinate(in, v, "z"));
        }
        for (pugi::xml_node t = child(child(node, "triangles"), "triangle"); t; t = next(t)) {
            mesh.triangles.push_back({corner(in, t, "v1"), corner(in, t, "v2"), corner(in, t, "v3")});
        }
        return mesh;
    }

    double coordinate(const ModelPart& in, const pugi::xml_node& vertex, const char* axis) const {
        const char* const text = vertex.attribute(axis).value();
        const auto number = parse_double(text);
        if (!number)
            reject(source_,
                   where(in, vertex) + ": " + axis + "=" + quoted(text) + " of a vertex is not a number");
        return *number;
    }

    std::uint32_t corner(const ModelPart& in, const pugi::xml_node& triangle, const char* key) const {
        const char* const text = triangle.attribute(key).value();
        const auto index = parse_integer(text);
        if (!index)
            reject(source_, where(in, triangle) + ": " + key + "=" + quoted(text) +
                                " of a triangle is not a vertex number");
        return *index < 0 || *index >= MeshWelder::unusable ? MeshWelder::unusable
                                                            : static_cast<std::uint32_t>(*index);
    }

    static std::string where(const ModelPart& in, const pugi::xml_node& node) {
        return "part " + quoted(in.name) + ", byte " + std::to_string(node.offset_debug());
    }

    void note(std::size_t count, const std::string& noun, const std::string& why) {
        if (count == 0) return;
        notes_.push_back(counted(count, noun) + (count == 1 ? " is " : " are ") + why + " and " +
                         (count == 1 ? "was" : "were") + " left out");
    }

    const MeshSource& source_;
    Package package_;
    double unit_mm_ = 1.0;
    std::map<std::string, std::unique_ptr<ModelPart>> parts_;
    std::map<const void*, ObjectMesh> meshes_;
    std::set<const void*> open_;
    MeshWelder welder_;
    std::vector<std::string> notes_;
    std::size_t instances_ = 0;
    std::size_t not_printable_ = 0;
    std::size_t other_types_ = 0;
    std::size_t outside_ = 0;
};

}  // namespace

MeshFile read_3mf(const MeshSource& source) { return Reader3mf(source).read(); }

}  // namespace lamella
