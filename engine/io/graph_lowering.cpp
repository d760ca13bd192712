// Evaluates nodes in the order of the check, and calls by recursion.
#include "engine/io/graph_lowering.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/formula/mapped_grading.h"
#include "engine/io/mesh_source.h"

namespace lamella {
namespace {

using Node = FormulaBuilder::Node;

constexpr std::size_t max_evaluated = 1'000'000;
constexpr std::size_t deepest_call = 100;
constexpr int deepest_sample = 8;

constexpr std::array channel_names{"red", "green", "blue", "alpha"};

[[noreturn]] void reject_node(const CheckedFunction& in, const GraphNode& node, const std::string& what) {
    throw InputError(in.where + ": node " + excerpt(node.identifier) + " (" + node.kind + "): " + what);
}

std::string names_of(const std::vector<GraphPort>& ports) {
    std::string text;
    for (const GraphPort& port : ports) text += (text.empty() ? "" : ", ") + port.name;
    return text.empty() ? "none" : text;
}

bool has(const std::vector<GraphPort>& ports, std::string_view name) {
    return std::any_of(ports.begin(), ports.end(), [&](const GraphPort& port) { return port.name == name; });
}

/// Returns a flag per node: 1 if a wanted output depends on it.
std::vector<char> needed(const CheckedGraph& graph, std::span<const std::string> wanted) {
    std::vector<char> need(graph.nodes.size(), 0);
    const auto mark = [&](const GraphSource& source) {
        if (source.is_node()) need[source.node] = 1;
    };
    for (std::size_t i = 0; i < graph.outputs.size(); ++i) {
        if (std::find(wanted.begin(), wanted.end(), graph.graph.outputs[i].name) != wanted.end())
            mark(graph.outputs[i]);
    }
    for (std::size_t i = graph.order.size(); i-- > 0;) {
        if (need[graph.order[i]] == 0) continue;
        for (const GraphSource& source : graph.nodes[graph.order[i]].sources) mark(source);
    }
    return need;
}

}  // namespace

void require_sound(const CheckedFunction& function) {
    if (!function.fault.empty()) throw InputError(function.fault);
}

GraphLowering::Values GraphLowering::call(const CheckedFunction& function, const Values& arguments,
                                          std::span<const std::string> wanted) {
    require_sound(function);
    const std::vector<GraphPort> inputs = inputs_of(function.function);
    const std::vector<GraphPort> outputs = outputs_of(function.function);
    for (const GraphPort& input : inputs) {
        const auto given = arguments.find(input.name);
        if (given == arguments.end()) {
            throw InputError(function.where + ": its input " + excerpt(input.name) +
                             " is not given; it takes " + names_of(inputs));
        }
        if (given->second.type != input.type) {
            throw InputError(function.where + ": its input " + excerpt(input.name) + " is a " +
                             name_of(input.type) + ", and a " + name_of(given->second.type) + " is given");
        }
    }
    for (const auto& argument : arguments) {
        if (!has(inputs, argument.first))
            throw InputError(function.where + ": it has no input " + excerpt(argument.first) + "; it takes " +
                             names_of(inputs));
    }
    for (const std::string& name : wanted) {
        if (!has(outputs, name))
            throw InputError(function.where + ": it has no output " + excerpt(name) + "; it gives " +
                             names_of(outputs));
    }
    if (const auto* image = std::get_if<ImageFunction>(&function.function.body)) {
        try {
            return call_image(*image, arguments.find("pos")->second, wanted);
        } catch (const InputError& error) {
            throw InputError(function.where + ": " + error.what());
        }
    }
    if (open_.size() >= deepest_call)
        throw InputError(function.where + ": calls are nested more than 100 deep");
    if (!open_.insert(function.function.id).second)
        throw InputError(function.where + ": it calls itself; calls must be free of cycles");
    Values out = call_graph(function, arguments, wanted);
    open_.erase(function.function.id);
    return out;
}

GraphLowering::Values GraphLowering::call_graph(const CheckedFunction& function, const Values& arguments,
                                                std::span<const std::string> wanted) {
    const CheckedGraph& graph = function.graph;
    const std::vector<char> need = needed(graph, wanted);
    std::vector<std::vector<GraphValue>> values(graph.nodes.size());
    const auto value_of = [&](const GraphSource& source) -> const GraphValue& {
        if (source.is_node()) return values[source.node][source.port];
        return arguments.find(graph.graph.inputs[source.port].name)->second;
    };
    for (const std::uint32_t i : graph.order) {
        if (need[i] == 0) continue;
        if (++evaluated_ > max_evaluated) {
            throw InputError(function.where +
                             ": with every call written out there are more than 1,000,000 nodes");
        }
        std::vector<GraphValue> inputs;
        for (const GraphSource& source : graph.nodes[i].sources) {
            if (source.node == GraphSource::nothing) {
                const GraphNode& node = graph.graph.nodes[i];
                reject_node(function, node,
                            "input " + excerpt(node.inputs[inputs.size()].name) + ": " + nothing_feeds_it);
            }
            inputs.push_back(value_of(source));
        }
        values[i] = evaluate(function, i, inputs);
    }
    Values out;
    for (std::size_t i = 0; i < graph.outputs.size(); ++i) {
        const std::string& name = graph.graph.outputs[i].name;
        if (std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
        if (graph.outputs[i].node == GraphSource::nothing)
            throw InputError(function.where + ": output " + excerpt(name) + ": " + nothing_feeds_it);
        out.emplace(name, value_of(graph.outputs[i]));
    }
    return out;
}

std::vector<GraphValue> GraphLowering::evaluate(const CheckedFunction& in, std::uint32_t i,
                                                std::span<const GraphValue> inputs) {
    const GraphNode& node = in.graph.graph.nodes[i];
    const NodeKind& kind = *in.graph.nodes[i].kind;
    if (kind.make != nullptr) return kind.make(builder_, node, inputs);
    if (kind.name == "functioncall") return call_node(in, node, inputs);
    GraphValue value;
    if (kind.outputs.front().types == "r") {
        value.type = GraphType::resource;
        value.resource = node.resource;
        return {value};
    }
    const bool with_sign = kind.name == "mesh";
    const std::int64_t object = inputs[1].resource;
    try {
        value.parts[0] = sample(
            std::string(kind.name) + std::to_string(object),
            [&] { return resources_.mesh(object, with_sign); }, inputs[0]);
    } catch (const InputError& error) {
        reject_node(in, node, error.what());
    }
    return {value};
}

std::vector<GraphValue> GraphLowering::call_node(const CheckedFunction& in, const GraphNode& node,
                                                 std::span<const GraphValue> inputs) {
    const std::int64_t id = inputs[0].resource;
    const CheckedFunction* callee = resources_.function(id);
    if (callee == nullptr)
        reject_node(in, node, "it calls function " + std::to_string(id) + ", which does not exist");
    Values arguments;
    for (std::size_t i = 1; i < inputs.size(); ++i) arguments.emplace(node.inputs[i].name, inputs[i]);
    std::vector<std::string> wanted;
    for (const GraphPort& output : node.outputs) wanted.push_back(output.name);
    const Values results = call(*callee, arguments, wanted);
    std::vector<GraphValue> out;
    for (const GraphPort& output : node.outputs) {
        const GraphValue& value = results.find(output.name)->second;
        if (value.type != output.type) {
            reject_node(in, node,
                        "output " + excerpt(output.name) + " is said to be a " + name_of(output.type) +
                            ", but function " + std::to_string(id) + " gives a " + name_of(value.type));
        }
        out.push_back(value);
    }
    return out;
}

GraphLowering::Values GraphLowering::call_image(const ImageFunction& image, const GraphValue& place,
                                                std::span<const std::string> wanted) {
    using Op = FormulaOp;
    std::string settings = "image" + std::to_string(image.image) +
                           (image.filter == ImageFilter::nearest ? " nearest" : " linear");
    for (const TileStyle tile : image.tiles) settings += ' ' + std::to_string(static_cast<int>(tile));
    const auto channel = [&](int number) {
        Node node = sample(
            settings + ' ' + std::to_string(number), [&] { return resources_.image(image, number); }, place);
        node = builder_.binary(Op::mul, node, builder_.constant(image.scale));
        if (image.offset != 0) node = builder_.binary(Op::add, node, builder_.constant(image.offset));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (image.tiles[axis] != TileStyle::none) continue;
            const Node s = place.parts[axis];
            const Node inside =
                builder_.binary(Op::logic_and, builder_.binary(Op::less_equal, builder_.constant(0), s),
                                builder_.binary(Op::less_equal, s, builder_.constant(1)));
            node = builder_.select(inside, node, builder_.constant(std::nan("")));
        }
        return node;
    };
    Values out;
    for (const std::string& name : wanted) {
        GraphValue value;
        if (name == "color") {
            value.type = GraphType::vector;
            for (std::size_t i = 0; i < 3; ++i) value.parts[i] = channel(static_cast<int>(i));
        } else {
            const auto* const found = std::find(channel_names.begin(), channel_names.end(), name);
            value.parts[0] = channel(static_cast<int>(found - channel_names.begin()));
        }
        out.emplace(name, value);
    }
    return out;
}

/// Returns the node that holds the samples of a source at a position.
Node GraphLowering::sample(const std::string& name, const std::function<GradingPtr()>& make,
                           const GraphValue& place) {
    const std::array<Node, 3> parts{place.parts[0], place.parts[1], place.parts[2]};
    if (const auto known = samples_.find({name, parts}); known != samples_.end()) return known->second;
    GradingPtr& source = sources_[name];
    if (!source) source = make();
    std::array<Formula, 3> formulas{builder_.finish(parts[0]), builder_.finish(parts[1]),
                                    builder_.finish(parts[2])};
    int depth = 1;
    for (const Formula& formula : formulas) {
        for (int i = 3; i < formula.input_count(); ++i) {
            if (formula.reads(i)) depth = std::max(depth, depth_[static_cast<std::size_t>(i) - 3] + 1);
        }
    }
    if (depth > deepest_sample)
        throw InputError("it is looked up at a place that itself is looked up, more than 8 deep");
    const Node node = builder_.input(3 + static_cast<int>(others_.size()));
    others_.push_back(make_mapped_grading(source, std::move(formulas), others_));
    depth_.push_back(depth);
    samples_.emplace(std::pair(name, parts), node);
    return node;
}

}  // namespace lamella
