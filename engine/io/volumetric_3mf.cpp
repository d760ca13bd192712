// Reads resources and functions, element by element. Namespace prefixes are the file's choice.
#include "engine/io/volumetric_3mf.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"

namespace lamella {
namespace {

bool is_volumetric(const pugi::xml_node& node) {
    return namespace_of(node).find("/volumetric/") != std::string_view::npos;
}
bool is_implicit(const pugi::xml_node& node) {
    return namespace_of(node).find("/implicit/") != std::string_view::npos;
}

/// Reads the resources of one part.
class PartReader {
  public:
    PartReader(const Model3mf& model, const ModelPart& part) : model_(model), part_(part) {}

    VolumetricPart read() {
        for (const pugi::xml_node& node : core_child(part_.model, "resources").children()) {
            if (is_implicit(node) && local_name(node) == "implicitfunction") {
                add_function(node, [&] { return read_graph(node); });
            } else if (!is_volumetric(node)) {
                continue;
            } else if (local_name(node) == "functionfromimage3d") {
                add_function(node, [&] { return read_image_function(node); });
            } else if (local_name(node) == "image3d") {
                add(out_.images, node, read_stack(node));
            } else if (local_name(node) == "volumedata") {
                add(out_.volumes, node, read_properties(node));
            } else {
                add_function(node, [&]() -> ImplicitGraph {
                    reject(node, "resources of this kind are not supported");
                });
            }
        }
        for (auto& [id, function] : out_.functions) check_image(function);
        return std::move(out_);
    }

    LevelSet read_level_set(const pugi::xml_node& node) const {
        LevelSet level_set{read_use(node), integer(node, "meshid"), false};
        level_set.box_only = boolean(node, "meshbboxonly");
        return level_set;
    }

    std::int64_t integer(const pugi::xml_node& node, std::string_view name) const {
        constexpr std::int64_t most = 2147483647;  // resource numbers are below 2^31
        const std::string_view text = attribute_of(node, name);
        const auto number = parse_integer(text);
        if (!number || *number < 1 || *number > most) {
            reject(node, std::string(name) + "=" + excerpt(text) + " is no number of 1 or more");
        }
        return *number;
    }

  private:
    [[noreturn]] void reject(const pugi::xml_node& node, const std::string& what) const {
        const std::string_view identifier = attribute_of(node, "identifier");
        model_.reject_at(part_, node,
                         std::string(local_name(node)) +
                             (identifier.empty() ? "" : " " + excerpt(identifier)) + ": " + what);
    }

    double number(const pugi::xml_node& node, std::string_view name, std::optional<double> fallback) const {
        const std::string_view text = attribute_of(node, name);
        if (text.empty() && fallback) return *fallback;
        const auto found = parse_double(text);
        if (!found || !std::isfinite(*found))
            reject(node, std::string(name) + "=" + excerpt(text) + " is no number");
        return *found;
    }

    bool boolean(const pugi::xml_node& node, std::string_view name) const {
        const std::string_view text = attribute_of(node, name);
        if (text.empty() || text == "false" || text == "0") return false;
        if (text != "true" && text != "1")
            reject(node, std::string(name) + "=" + excerpt(text) + " is neither true nor false");
        return true;
    }

    template <typename Enum>
    Enum word(const pugi::xml_node& node, std::string_view name,
              std::initializer_list<std::pair<std::string_view, Enum>> words) const {
        const std::string_view text = attribute_of(node, name);
        if (text.empty()) return words.begin()->second;
        std::string known;
        for (const auto& [key, value] : words) {
            if (text == key) return value;
            known += (known.empty() ? "" : ", ") + std::string(key);
        }
        reject(node, std::string(name) + "=" + excerpt(text) + " is unknown; known: " + known);
    }

    template <typename Resource>
    void add(std::map<std::int64_t, Resource>& to, const pugi::xml_node& node, Resource resource) {
        const std::int64_t id = integer(node, "id");
        if (!to.emplace(id, std::move(resource)).second)
            reject(node, "two resources have the number " + std::to_string(id));
    }

    /// Files hold functions that nothing uses, of other programs and unfinished: what is wrong with one is
    /// kept until it is used.
    template <typename ReadBody>
    void add_function(const pugi::xml_node& node, const ReadBody& read_body) {
        CheckedFunction checked;
        checked.function.id = integer(node, "id");
        checked.function.name = attribute_of(node, "displayname");
        checked.where = model_.source().name + ": function " + std::to_string(checked.function.id);
        if (!checked.function.name.empty()) checked.where += " " + excerpt(checked.function.name);
        try {
            checked.function.body = read_body();
            if (const auto* graph = std::get_if<ImplicitGraph>(&checked.function.body))
                checked.graph = check_graph(*graph, checked.where);
        } catch (const InputError& error) {
            checked.fault = error.what();
        }
        add(out_.functions, node, std::move(checked));
    }

    /// Checked at the end, because references to images may come before the images.
    void check_image(CheckedFunction& function) const {
        const auto* image = std::get_if<ImageFunction>(&function.function.body);
        if (image != nullptr && out_.images.find(image->image) == out_.images.end()) {
            function.fault = function.where + ": it samples image3d " + std::to_string(image->image) +
                             ", which does not exist";
        }
    }

    ImageStack read_stack(const pugi::xml_node& node) const {
        pugi::xml_node stack = node.first_child();
        while (stack && !(is_volumetric(stack) && local_name(stack) == "imagestack"))
            stack = stack.next_sibling();
        if (!stack) reject(node, "it has no imagestack; images of other kinds are not supported");
        ImageStack out{integer(stack, "rowcount"), integer(stack, "columncount"), {}};
        const std::int64_t announced = integer(stack, "sheetcount");
        for (const pugi::xml_node& sheet : stack.children()) {
            if (local_name(sheet) != "imagesheet") continue;
            const std::string_view path = attribute_of(sheet, "path");
            if (path.empty()) reject(sheet, "it has no path");
            if (out.sheets.size() == max_sheets) reject(stack, "it has more than 1,000,000 sheets");
            out.sheets.push_back(part_name(path));
        }
        if (static_cast<std::int64_t>(out.sheets.size()) != announced) {
            reject(stack, "sheetcount is " + std::to_string(announced) + ", and it has " +
                              counted(out.sheets.size(), "sheet"));
        }
        return out;
    }

    ImageFunction read_image_function(const pugi::xml_node& node) const {
        ImageFunction out;
        out.image = integer(node, "image3did");
        out.filter = word<ImageFilter>(node, "filter",
                                       {{"linear", ImageFilter::linear}, {"nearest", ImageFilter::nearest}});
        constexpr std::array names{"tilestyleu", "tilestylev", "tilestylew"};
        for (std::size_t i = 0; i < 3; ++i) {
            out.tiles[i] = word<TileStyle>(node, names[i],
                                           {{"wrap", TileStyle::wrap},
                                            {"mirror", TileStyle::mirror},
                                            {"clamp", TileStyle::clamp},
                                            {"none", TileStyle::none}});
        }
        out.offset = number(node, "valueoffset", 0.0);
        out.scale = number(node, "valuescale", 1.0);
        return out;
    }

    FunctionUse read_use(const pugi::xml_node& node) const {
        FunctionUse use{integer(node, "functionid"), std::string(attribute_of(node, "channel")),
                        model_.transform_of(part_, node), number(node, "fallbackvalue", 0.0)};
        if (use.channel.empty()) reject(node, "it has no channel");
        return use;
    }

    std::vector<VolumeProperty> read_properties(const pugi::xml_node& node) const {
        std::vector<VolumeProperty> out;
        for (const pugi::xml_node& child : node.children()) {
            if (!is_volumetric(child) || local_name(child) != "property") continue;
            VolumeProperty property{std::string(attribute_of(child, "name")), read_use(child)};
            if (property.name.empty()) reject(child, "it has no name");
            const bool taken = std::any_of(out.begin(), out.end(), [&](const VolumeProperty& other) {
                return other.name == property.name;
            });
            if (taken) reject(child, "two properties are named " + excerpt(property.name));
            if (out.size() == 10'000) reject(node, "it has more than 10,000 properties");
            out.push_back(std::move(property));
        }
        return out;
    }

    ImplicitGraph read_graph(const pugi::xml_node& function) {
        ImplicitGraph graph;
        bool has_in = false, has_out = false;
        for (const pugi::xml_node& node : function.children()) {
            if (node.type() != pugi::node_element) continue;
            const std::string_view name = local_name(node);
            if (name == "in" || name == "out") {
                if (std::exchange(name == "in" ? has_in : has_out, true))
                    reject(function, "it has two elements " + std::string(name));
                (name == "in" ? graph.inputs : graph.outputs) = read_ports(node, name == "out");
                continue;
            }
            if (++nodes_ > max_graph_nodes) reject(function, "the functions have more than 200,000 nodes");
            graph.nodes.push_back(read_node(node));
        }
        return graph;
    }

    GraphNode read_node(const pugi::xml_node& node) const {
        GraphNode out;
        out.identifier = attribute_of(node, "identifier");
        out.kind = local_name(node);
        if (!is_implicit(node))
            reject(node, "it belongs to the namespace " + excerpt(namespace_of(node)) +
                             ", whose nodes are not supported");
        for (const pugi::xml_node& ports : node.children()) {
            if (local_name(ports) == "in") append(out.inputs, read_ports(ports, true));
            if (local_name(ports) == "out") append(out.outputs, read_ports(ports, false));
        }
        if (out.kind == "constant") {
            out.numbers = {number(node, "value", {})};
        } else if (out.kind == "constvec") {
            out.numbers = {number(node, "x", {}), number(node, "y", {}), number(node, "z", {})};
        } else if (out.kind == "constmat") {
            out.numbers = sixteen(node);
        } else if (out.kind == "constresourceid" || out.kind == "resourceid") {
            // The specification's text calls it `value`, its example of a call `resourceid`.
            out.resource = integer(node, attribute_of(node, "value").empty() ? "resourceid" : "value");
        }
        return out;
    }

    static void append(std::vector<GraphPort>& to, std::vector<GraphPort> ports) {
        for (GraphPort& port : ports) to.push_back(std::move(port));
    }

    std::vector<double> sixteen(const pugi::xml_node& node) const {
        const std::string_view text = attribute_of(node, "matrix");
        TextCursor cursor(text);
        std::vector<double> out;
        for (std::string_view token = cursor.token(); !token.empty() && out.size() <= 16;
             token = cursor.token()) {
            const auto found = parse_double(token);
            if (!found || !std::isfinite(*found)) reject(node, excerpt(token) + " in matrix is no number");
            out.push_back(*found);
        }
        if (out.size() != 16) reject(node, "matrix=" + excerpt(text) + " is not 16 numbers");
        return out;
    }

    std::vector<GraphPort> read_ports(const pugi::xml_node& list, bool references) const {
        std::vector<GraphPort> ports;
        for (const pugi::xml_node& node : list.children()) {
            if (node.type() != pugi::node_element) continue;
            std::string_view name = local_name(node);
            if (references && name.ends_with("ref")) name.remove_suffix(3);
            const bool of_resource = name == (references ? "resource" : "resourceid");
            const GraphType type = name == "scalar"   ? GraphType::scalar
                                   : name == "vector" ? GraphType::vector
                                   : name == "matrix" ? GraphType::matrix
                                                      : GraphType::resource;
            if ((type == GraphType::resource && !of_resource) ||
                (references && !local_name(node).ends_with("ref"))) {
                reject(node, references ? "expected scalarref, vectorref, matrixref or resourceref"
                                        : "expected scalar, vector, matrix or resourceid");
            }
            ports.push_back({std::string(attribute_of(node, "identifier")), type,
                             std::string(references ? attribute_of(node, "ref") : std::string_view())});
        }
        return ports;
    }

    const Model3mf& model_;
    const ModelPart& part_;
    VolumetricPart out_;
    std::size_t nodes_ = 0;
};

}  // namespace

VolumetricPart read_volumetric_part(const Model3mf& model, const ModelPart& part) {
    return PartReader(model, part).read();
}

std::optional<LevelSet> read_level_set(const Model3mf& model, const PlacedObject& object) {
    for (const pugi::xml_node& node : object.object.children()) {
        if (is_volumetric(node) && local_name(node) == "levelset")
            return PartReader(model, object.part).read_level_set(node);
    }
    return std::nullopt;
}

std::optional<std::int64_t> volume_of(const Model3mf& model, const PlacedObject& object) {
    for (const pugi::xml_node& node : object.object.children()) {
        if (local_name(node) != "levelset" && local_name(node) != "mesh") continue;
        if (attribute_of(node, "volumeid").empty()) continue;
        return PartReader(model, object.part).integer(node, "volumeid");
    }
    return std::nullopt;
}

}  // namespace lamella
