// Builds formulas that map points from the platform to the object and on to the function.
#include "procedural/volume/volumetric_model.h"

#include <algorithm>
#include <map>

#include "engine/base/error.h"
#include "engine/base/whole_file.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_grading.h"
#include "engine/io/volumetric_3mf.h"
#include "engine/mesh/distance_grading.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/csg.h"
#include "procedural/volume/image_stack_3mf.h"
#include "procedural/volume/lattice_solid.h"
#include "procedural/volume/platform_formula.h"
#include "procedural/volume/tiled_volume.h"

namespace lamella {
namespace {

using Node = FormulaBuilder::Node;

constexpr std::string_view supported[] = {"/production/", "/material/", "/trianglesets/",
                                          "/volumetric/", "/implicit/", "/beamlattice/"};
constexpr std::size_t max_level_sets = 10'000;
constexpr std::size_t max_objects = 1'000'000;  // maximum number of objects that one name may lead to
constexpr std::size_t max_beams = 20'000'000;

/// Removes the component at the end of a name and returns it: 0 to 2 for .x to .z; negative for none.
int take_component(std::string_view& name) {
    for (int i = 0; i < 3; ++i) {
        const char ending[3] = {'.', "xyz"[i], '\0'};
        if (!name.ends_with(ending)) continue;
        name.remove_suffix(2);
        return i;
    }
    return -1;
}

std::string name_of_object(const PlacedObject& placed) {
    const std::string id = placed.object.attribute("id").value();
    const std::string name = placed.object.attribute("name").value();
    return id + (name.empty() ? "" : " " + excerpt(name));
}

}  // namespace

class VolumetricModel::Impl {
  public:
    Impl(const std::string& name, std::string bytes)
        : bytes_(std::move(bytes)), source_{name, bytes_, 1.0}, model_(source_, supported) {
        part(model_.root());
        model_.for_each_placed([this](const PlacedObject& placed) {
            part(placed.part);
            placed_.push_back(placed);
        });
    }

    FieldPtr built() {
        model_.require_items();
        return unite_all(placed_);
    }

    FieldPtr object(std::string_view which) { return unite_all(objects_named(which)); }

    PlacedFormula function(std::string_view which) {
        const auto [function, output, component] = function_named(which);
        FormulaBuilder builder;
        std::vector<GradingPtr> others;
        const GraphValue place = mapped(builder, platform(builder), scaled({}, 1 / model_.unit_mm()));
        const Node value =
            lower(part(model_.root()), model_.root(), *function, output, component, place, builder, others);
        return {builder.finish(value), std::move(others)};
    }

    GradingPtr property(std::string_view name, std::string_view object) {
        const std::vector<PlacedObject> candidates = object.empty() ? placed_ : objects_named(object);
        const PlacedObject* found = nullptr;
        const VolumeProperty* property = nullptr;
        int component = -1;
        std::string known;
        for (const PlacedObject& placed : candidates) {
            for (const VolumeProperty& other : properties_of(placed)) {
                const int matched = matches(other, name);
                if (known.size() < 500 && known.find(other.name) == known.npos)
                    known += (known.empty() ? "" : ", ") + other.name;
                if (matched < -1) continue;
                if (found != nullptr) {
                    reject(source_, "property " + excerpt(name) + " is that of object " +
                                        name_of_object(*found) + " and of object " + name_of_object(placed) +
                                        (object.empty() ? "; state which object is meant"
                                                        : "; an object that is placed once is needed"));
                }
                found = &placed;
                property = &other;
                component = matched;
            }
        }
        if (found == nullptr) {
            reject(source_, "no object that is built has a property " + excerpt(name) +
                                (known.empty() ? "; it has none at all" : "; it has " + known));
        }
        return property_grading(*found, *property, component);
    }

  private:
    struct Named {
        const CheckedFunction* function;
        std::string output;
        int component;
    };

    const VolumetricPart& part(const ModelPart& in) {
        const auto known = parts_.find(&in);
        if (known != parts_.end()) return known->second;
        return parts_.emplace(&in, read_volumetric_part(model_, in)).first->second;
    }

    /// Returns -2 for another property, -1 for this one, 0 to 2 for a component of this one.
    static int matches(const VolumeProperty& property, std::string_view name) {
        const auto same = [&](std::string_view wanted) {
            const std::string_view whole = property.name;
            const std::size_t colon = whole.find(':');
            return wanted == whole || (colon != whole.npos && wanted == whole.substr(colon + 1));
        };
        if (same(name)) return -1;
        const int component = take_component(name);
        return component >= 0 && same(name) ? component : -2;
    }

    const std::vector<VolumeProperty>& properties_of(const PlacedObject& placed) {
        static const std::vector<VolumeProperty> none;
        const auto volume = volume_of(model_, placed);
        if (!volume) return none;
        const auto& volumes = part(placed.part).volumes;
        const auto found = volumes.find(*volume);
        if (found == volumes.end()) {
            reject(source_, "object " + name_of_object(placed) + " has volumedata " +
                                std::to_string(*volume) + ", which does not exist");
        }
        return found->second;
    }

    /// Returns the object and its components at all their placements, or unplaced if there is none.
    std::vector<PlacedObject> objects_named(std::string_view which) {
        const auto is_meant = [&](const pugi::xml_node& object) {
            return which == object.attribute("id").value() || which == object.attribute("name").value();
        };
        std::vector<PlacedObject> found;
        const auto take = [&](const PlacedObject& object) {
            model_.for_each_within(object, [&](const PlacedObject& placed) {
                if (found.size() == max_objects)
                    reject(source_, "object " + excerpt(which) + " is placed more than 1,000,000 times");
                part(placed.part);
                found.push_back(placed);
            });
        };
        for (const PlacedObject& placed : placed_) {
            if (is_meant(placed.object)) take(placed);
        }
        if (!found.empty()) return found;
        std::string known;
        for (const auto& [id, object] : model_.root().objects) {
            if (is_meant(object)) {
                take({model_.root(), object, Transform3mf()});
                return found;
            }
            if (known.size() < 500)
                known += (known.empty() ? "" : ", ") + name_of_object({model_.root(), object, {}});
        }
        reject(source_,
               "there is no object " + excerpt(which) + "; it has " + (known.empty() ? "none" : known));
    }

    Named function_named(std::string_view which) {
        const auto& functions = part(model_.root()).functions;
        const auto find = [&](std::string_view name) -> const CheckedFunction* {
            const CheckedFunction* found = nullptr;
            for (const auto& [id, function] : functions) {
                if (std::to_string(id) == name) return &function;
                if (function.function.name != name || name.empty()) continue;
                if (found != nullptr)
                    reject(source_, "two functions are named " + excerpt(name) + "; use their numbers");
                found = &function;
            }
            return found;
        };
        // Find the longest prefix that is a function's name; names may contain dots.
        for (std::size_t end = which.size(); end != which.npos && end > 0; end = which.rfind('.', end - 1)) {
            const CheckedFunction* found = find(which.substr(0, end));
            if (found == nullptr) continue;
            require_sound(*found);
            std::string_view rest = which.substr(std::min(end + 1, which.size()));
            const std::vector<GraphPort> outputs = outputs_of(found->function);
            const auto has = [&](std::string_view name) {
                return std::any_of(outputs.begin(), outputs.end(),
                                   [&](const GraphPort& output) { return output.name == name; });
            };
            const int component = has(rest) ? -1 : take_component(rest);
            if (!rest.empty()) return {found, std::string(rest), component};
            const auto is_scalar = [](const GraphPort& output) { return output.type == GraphType::scalar; };
            if (outputs.size() == 1) return {found, outputs.front().name, component};
            if (std::count_if(outputs.begin(), outputs.end(), is_scalar) == 1)
                return {found, std::find_if(outputs.begin(), outputs.end(), is_scalar)->name, -1};
            std::string known;
            for (const GraphPort& output : outputs) known += (known.empty() ? "" : ", ") + output.name;
            reject(source_, "function " + excerpt(which) + " has several outputs; add one of them: " + known);
        }
        std::string known;
        for (const auto& [id, function] : functions) {
            if (known.size() > 500) break;
            known += (known.empty() ? "" : ", ") + std::to_string(id);
            if (!function.function.name.empty()) known += " " + excerpt(function.function.name);
        }
        reject(source_,
               "there is no function " + excerpt(which) + "; it has " + (known.empty() ? "none" : known));
    }

    /// Adds one number of a function's output at a point to the formula.
    Node lower(const VolumetricPart& resources, const ModelPart& in, const CheckedFunction& function,
               const std::string& output, int component, const GraphValue& place, FormulaBuilder& builder,
               std::vector<GradingPtr>& others) {
        const GraphResources given{
            [&](std::int64_t id) -> const CheckedFunction* {
                const auto found = resources.functions.find(id);
                return found == resources.functions.end() ? nullptr : &found->second;
            },
            [&](std::int64_t id, bool with_sign) { return distance_to(in, id, with_sign); },
            [&](const ImageFunction& image, int channel) { return sampler(in, resources, image, channel); }};
        GraphLowering lowering(builder, others, given);
        const std::string wanted[] = {output};
        const GraphLowering::Values values = lowering.call(function, {{"pos", place}}, wanted);
        const GraphValue& value = values.begin()->second;
        const std::string what =
            function.where + ": its output " + excerpt(output) + " is a " + name_of(value.type);
        if (value.type == GraphType::scalar) {
            if (component >= 0) throw InputError(what + ", which has no .x, .y or .z");
            return value.parts[0];
        }
        if (value.type != GraphType::vector)
            throw InputError(what + "; a scalar, or a component of a vector, is needed");
        if (component < 0) throw InputError(what + "; add .x, .y or .z, or use an output that is a scalar");
        return value.parts[static_cast<std::size_t>(component)];
    }

    const CheckedFunction& function_of(const PlacedObject& placed, const FunctionUse& use,
                                       const std::string& user) {
        const auto& functions = part(placed.part).functions;
        const auto found = functions.find(use.function);
        if (found == functions.end()) {
            reject(source_, "object " + name_of_object(placed) + ": its " + user + " uses function " +
                                std::to_string(use.function) + ", which does not exist");
        }
        return found->second;
    }

    GradingPtr property_grading(const PlacedObject& placed, const VolumeProperty& property, int component) {
        const CheckedFunction& function =
            function_of(placed, property.use, "property " + excerpt(property.name));
        FormulaBuilder builder;
        std::vector<GradingPtr> others;
        const Transform3mf back = scaled(placed.transform, model_.unit_mm()).inverse();
        const GraphValue place =
            mapped(builder, mapped(builder, platform(builder), back), property.use.transform);
        Node value = lower(part(placed.part), placed.part, function, property.use.channel, component, place,
                           builder, others);
        if (maybe_undefined(builder.finish(value), others))
            value = or_else(builder, value, property.use.fallback);
        return make_formula_grading(builder.finish(value), std::move(others));
    }

    FieldPtr level_set_field(const PlacedObject& placed, const LevelSet& level_set) {
        const CheckedFunction& function = function_of(placed, level_set.use, "level set");
        const Transform3mf to_platform = scaled(placed.transform, model_.unit_mm());
        FormulaBuilder builder;
        std::vector<GradingPtr> others;
        const GraphValue own = mapped(builder, platform(builder), to_platform.inverse());
        const GraphValue place = mapped(builder, own, level_set.use.transform);
        Node value = lower(part(placed.part), placed.part, function, level_set.use.channel, -1, place,
                           builder, others);
        value = builder.binary(FormulaOp::mul, value, builder.constant(model_.unit_mm()));
        // Undefined values are outside, which a fallback of 0 or more also makes them.
        if (level_set.use.fallback < 0) value = or_else(builder, value, level_set.use.fallback);
        const TriangleMesh hull = mesh_of(placed.part, level_set.mesh, Transform3mf());
        const Box box = hull.bounds();
        const bool aligned = keeps_axes(to_platform);
        if (!aligned) value = within_box(builder, value, own, box);
        FieldPtr solid = make_formula_field(builder.finish(value), std::move(others),
                                            image_of(box, to_platform), Metric::sign);
        if (level_set.box_only) return solid;
        SolidMesh closed = close_mesh(mesh_of(placed.part, level_set.mesh, to_platform), source_.name);
        if (is_box(close_mesh(hull, source_.name).mesh, box)) return solid;
        return make_intersection({solid, make_mesh_field(std::move(closed))});
    }

    FieldPtr unite_all(const std::vector<PlacedObject>& objects) {
        std::vector<FieldPtr> solids;
        MeshWelder meshes;
        beams_ = 0;
        size_ = {};
        bool has_mesh = false;
        for (const PlacedObject& placed : objects) {
            if (const auto level_set = read_level_set(model_, placed)) {
                if (solids.size() == max_level_sets) reject(source_, "it places more than 10,000 level sets");
                solids.push_back(level_set_field(placed, *level_set));
            } else if (const pugi::xml_node mesh = core_child(placed.object, "mesh")) {
                const pugi::xml_node lattice = lattice_node(mesh);
                if (lattice) solids.push_back(lattice_field(placed, mesh, lattice));
                if (lattice && mesh_at(placed.part, mesh).triangles.empty()) continue;
                add(meshes, placed.part, mesh, scaled(placed.transform, model_.unit_mm()));
                has_mesh = true;
            }
        }
        if (has_mesh) {
            solids.push_back(
                make_mesh_field(close_mesh(meshes.finish(source_, model_.left_out()).mesh, source_.name)));
        }
        if (solids.empty())
            reject(source_, "what is asked for has no level set, mesh or beams, so there is no solid");
        return solids.size() == 1 ? solids.front() : make_union(std::move(solids));
    }

    /// Makes a lattice at its place. Only maps that keep angles keep beams round: others move the whole
    /// solid.
    FieldPtr lattice_field(const PlacedObject& placed, const pugi::xml_node& mesh,
                           const pugi::xml_node& node) {
        const ObjectMesh& nodes = mesh_at(placed.part, mesh);
        size_.add(source_, nodes);
        const auto [entry, fresh] = lattices_.try_emplace(node.internal_object());
        if (fresh) entry->second = read_lattice(model_, placed.part, node, nodes.vertices.size());
        const LatticeOfMesh& lattice = entry->second;
        beams_ += lattice.beams.size() + lattice.balls.size();
        if (beams_ > max_beams) reject(source_, "it places more than 20,000,000 beams");
        const Transform3mf whole = scaled(placed.transform, model_.unit_mm());
        const auto scale = scale_of(whole);
        const Transform3mf first = scale ? whole : Transform3mf();
        std::vector<dvec3> vertices;
        vertices.reserve(nodes.vertices.size());
        for (const dvec3& p : nodes.vertices) {
            vertices.push_back(first(p));
            if (!(length(vertices.back()) <= max_coordinate))
                model_.reject_at(placed.part, node, "a vertex of it is NaN, infinite or absurdly far away");
        }
        LatticePieces pieces;
        append_pieces(pieces, lattice, vertices, scale.value_or(1.0));
        FieldPtr solid = make_lattice_solid(std::move(pieces));
        if (lattice.clipping != LatticeClipping::none)
            solid = clipped(std::move(solid), lattice, placed, node, first);
        if (scale) return solid;
        const auto& m = whole.m;
        return make_transform(std::move(solid),
                              glm::dmat3(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]),
                              {m[9], m[10], m[11]});
    }

    FieldPtr clipped(FieldPtr solid, const LatticeOfMesh& lattice, const PlacedObject& placed,
                     const pugi::xml_node& node, const Transform3mf& transform) {
        const auto found = placed.part.objects.find(std::to_string(lattice.clipping_mesh));
        if (found != placed.part.objects.end() && lattice_node(core_child(found->second, "mesh"))) {
            model_.reject_at(placed.part, node,
                             "its clippingmesh is object " + std::to_string(lattice.clipping_mesh) +
                                 ", which has beams itself; accepted: an object of triangles only");
        }
        FieldPtr mesh =
            make_mesh_field(close_mesh(mesh_of(placed.part, lattice.clipping_mesh, transform), source_.name));
        return lattice.clipping == LatticeClipping::inside
                   ? make_intersection({std::move(solid), std::move(mesh)})
                   : make_difference(std::move(solid), std::move(mesh));
    }

    const ObjectMesh& mesh_at(const ModelPart& in, const pugi::xml_node& node) {
        const auto [entry, fresh] = meshes_.try_emplace(node.internal_object());
        if (fresh) entry->second = read_object_mesh(model_, in, node);
        return entry->second;
    }

    /// Adds an object's triangles under a transform, without those that refer to missing vertices.
    void add(MeshWelder& welder, const ModelPart& in, const pugi::xml_node& node,
             const Transform3mf& transform) {
        const ObjectMesh& mesh = mesh_at(in, node);
        size_.add(source_, mesh);
        std::vector<std::uint32_t> welded;
        welded.reserve(mesh.vertices.size());
        for (const dvec3& p : mesh.vertices) welded.push_back(welder.vertex(transform(p)));
        const bool mirrored = transform.determinant() < 0;
        for (auto [a, b, c] : mesh.triangles) {
            if (std::max({a, b, c}) >= welded.size()) continue;
            if (mirrored) std::swap(b, c);
            welder.triangle(welded[a], welded[b], welded[c]);
        }
    }

    TriangleMesh mesh_of(const ModelPart& in, std::int64_t id, const Transform3mf& transform) {
        const auto found = in.objects.find(std::to_string(id));
        if (found == in.objects.end())
            reject(source_, "object " + std::to_string(id) + " is referred to but does not exist");
        const pugi::xml_node node = core_child(found->second, "mesh");
        if (!node) reject(source_, "object " + std::to_string(id) + " is needed as a mesh, and is none");
        MeshWelder welder;
        add(welder, in, node, transform);
        return welder.finish(source_, {}).mesh;
    }

    /// Returns the distance to a mesh, in the model's unit.
    GradingPtr distance_to(const ModelPart& in, std::int64_t id, bool with_sign) {
        GradingPtr& known = distances_[{&in, id, with_sign}];
        if (known) return known;
        TriangleMesh mesh = mesh_of(in, id, Transform3mf());
        known = with_sign ? make_value_grading(make_mesh_field(close_mesh(std::move(mesh), source_.name)))
                          : make_surface_distance_grading(std::move(mesh));
        return known;
    }

    GradingPtr sampler(const ModelPart& in, const VolumetricPart& resources, const ImageFunction& image,
                       int channel) {
        GradingPtr& known = samplers_[{&in, image.image, channel, image.filter, image.tiles}];
        if (known) return known;
        const std::string where = source_.name + ": image3d " + std::to_string(image.image);
        auto volume = read_image_stack(model_.package(), resources.images.at(image.image), channel, where);
        known = volume ? make_tiled_volume(std::move(*volume), image.filter, image.tiles)
                       : make_constant_grading(1);
        return known;
    }

    using DistanceKey = std::tuple<const ModelPart*, std::int64_t, bool>;
    using SamplerKey = std::tuple<const ModelPart*, std::int64_t, int, ImageFilter, std::array<TileStyle, 3>>;

    std::string bytes_;
    MeshSource source_;
    Model3mf model_;
    std::map<const ModelPart*, VolumetricPart> parts_;
    std::vector<PlacedObject> placed_;
    std::map<const void*, ObjectMesh> meshes_;  ///< by XML element
    std::map<const void*, LatticeOfMesh> lattices_;
    std::size_t beams_ = 0;  ///< placed so far, with balls
    PlacedSize size_;        ///< of all that was placed so far
    std::map<DistanceKey, GradingPtr> distances_;
    std::map<SamplerKey, GradingPtr> samplers_;
};

VolumetricModel::VolumetricModel(const std::string& path)
    : VolumetricModel(path, whole_file(path, "a 3MF file")) {}
VolumetricModel::VolumetricModel(const std::string& name, std::string bytes)
    : impl_(std::make_unique<Impl>(name, std::move(bytes))) {}
VolumetricModel::~VolumetricModel() = default;
VolumetricModel::VolumetricModel(VolumetricModel&&) noexcept = default;

FieldPtr VolumetricModel::built() { return impl_->built(); }
FieldPtr VolumetricModel::object(std::string_view which) { return impl_->object(which); }
PlacedFormula VolumetricModel::function(std::string_view which) { return impl_->function(which); }
GradingPtr VolumetricModel::property(std::string_view name, std::string_view object) {
    return impl_->property(name, object);
}

}  // namespace lamella
