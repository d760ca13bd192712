// Resolves names, compares types along every link, then sorts the nodes topologically.
#include "engine/io/graph_check.h"

#include <algorithm>
#include <map>
#include <optional>

#include "engine/base/error.h"
#include "engine/io/mesh_source.h"

namespace lamella {
namespace {

constexpr std::string_view inputs_name = "inputs";

template <typename Ports>
std::string names_of(const Ports& ports) {
    std::string text;
    for (const auto& port : ports) text += (text.empty() ? "" : ", ") + std::string(port.name);
    return text.empty() ? "none" : text;
}

GraphType type_of(char letter) {
    for (const GraphType type : {GraphType::scalar, GraphType::vector, GraphType::matrix}) {
        if (letter_of(type) == letter) return type;
    }
    return GraphType::resource;
}

std::string types_text(std::string_view letters) {
    std::string text;
    for (const char letter : letters)
        text += (text.empty() ? "" : " or ") + std::string(name_of(type_of(letter)));
    return text;
}

class GraphCheck {
  public:
    GraphCheck(ImplicitGraph graph, const std::string& where) : where_(where) {
        out_.graph = std::move(graph);
    }

    CheckedGraph run() {
        for (std::size_t i = 0; i < out_.graph.nodes.size(); ++i) add_node(i);
        check_names(out_.graph.inputs, "input");
        check_names(out_.graph.outputs, "output");
        if (out_.graph.outputs.empty()) reject("it has no outputs");
        out_.nodes.resize(out_.graph.nodes.size());
        for (std::size_t i = 0; i < out_.nodes.size(); ++i) shape_node(i);
        for (std::size_t i = 0; i < out_.nodes.size(); ++i) link_node(i);
        for (const GraphPort& output : out_.graph.outputs) {
            out_.outputs.push_back(source_of(output, [&](const std::string& what) {
                reject("output " + excerpt(output.name) + ": " + what);
            }));
        }
        put_in_order();
        return std::move(out_);
    }

  private:
    [[noreturn]] void reject(const std::string& what) const { throw InputError(where_ + ": " + what); }
    [[noreturn]] void reject(const GraphNode& node, const std::string& what) const {
        reject("node " + excerpt(node.identifier) + " (" + node.kind + "): " + what);
    }

    void add_node(std::size_t i) {
        const GraphNode& node = out_.graph.nodes[i];
        if (node.identifier.empty()) reject(node, "it has no identifier");
        if (node.identifier == inputs_name || node.identifier == "outputs")
            reject(node, "the names inputs and outputs are kept for those of the function");
        if (!places_.try_emplace(node.identifier, static_cast<std::uint32_t>(i)).second)
            reject(node, "another node has this identifier already");
    }

    void check_names(const std::vector<GraphPort>& ports, const std::string& noun) const {
        std::map<std::string_view, int> seen;
        for (const GraphPort& port : ports) {
            if (port.name.empty()) reject("an " + noun + " has no identifier");
            if (++seen[port.name] > 1) reject("two " + noun + "s are named " + excerpt(port.name));
        }
    }

    /// Puts a node's ports in the order of its kind.
    void shape_node(std::size_t i) {
        GraphNode& node = out_.graph.nodes[i];
        const NodeKind* kind = out_.nodes[i].kind = find_node_kind(node.kind);
        if (kind == nullptr)
            reject(node,
                   "nodes of this kind are not supported; supported: the native nodes of the implicit "
                   "extension 1.0");
        check_ports(node, node.inputs, "input");
        check_ports(node, node.outputs, "output");
        std::vector<GraphPort> inputs;
        for (const NodePort& port : kind->inputs) {
            const auto found = find(node.inputs, port);
            if (found == node.inputs.end()) {
                reject(node, "input " + excerpt(port.name) + " is missing; its inputs are " +
                                 names_of(kind->inputs));
            }
            inputs.push_back(std::move(*found));
            node.inputs.erase(found);
        }
        if (kind->name == "functioncall") {
            for (GraphPort& more : node.inputs) inputs.push_back(std::move(more));
        } else if (!node.inputs.empty()) {
            reject(node, "there is no input " + excerpt(node.inputs.front().name) + "; its inputs are " +
                             names_of(kind->inputs));
        }
        node.inputs = std::move(inputs);
        check_types(node, *kind);
    }

    void check_ports(const GraphNode& node, const std::vector<GraphPort>& ports,
                     const std::string& noun) const {
        for (std::size_t i = 0; i < ports.size(); ++i) {
            if (ports[i].name.empty()) reject(node, "an " + noun + " has no identifier");
            for (std::size_t j = 0; j < i && ports.size() <= 64; ++j) {
                if (ports[i].name == ports[j].name)
                    reject(node, "two " + noun + "s are named " + excerpt(ports[i].name));
            }
        }
        if (ports.size() > 64) reject(node, "it has more than 64 " + noun + "s");
    }

    static std::vector<GraphPort>::iterator find(std::vector<GraphPort>& ports, const NodePort& wanted) {
        return std::find_if(ports.begin(), ports.end(), [&](const GraphPort& port) {
            return port.name == wanted.name || (!wanted.also.empty() && port.name == wanted.also);
        });
    }

    /// Checks the types of the inputs, and of the outputs that follow from them.
    void check_types(GraphNode& node, const NodeKind& kind) const {
        std::optional<GraphType> common;
        for (std::size_t i = 0; i < kind.inputs.size(); ++i) {
            const GraphPort& input = node.inputs[i];
            const std::string_view types = kind.inputs[i].types;
            if (types.find(letter_of(input.type)) == types.npos) {
                reject(node, "input " + excerpt(input.name) + " is a " + name_of(input.type) +
                                 "; it may be a " + types_text(types));
            }
            if (types.size() == 1) continue;
            if (!common) common = input.type;
            if (input.type != *common) {
                reject(node, "input " + excerpt(input.name) + " is a " + name_of(input.type) +
                                 " and the one before a " + name_of(*common) +
                                 "; all of them must be of one type");
            }
        }
        if (kind.name == "functioncall") return;
        std::vector<GraphPort> outputs;
        for (const NodePort& port : kind.outputs) {
            const GraphType type = port.types.size() == 1 ? type_of(port.types[0]) : *common;
            outputs.push_back({std::string(port.name), type, ""});
            // Some programs declare an output by both of its names.
            for (auto stated = find(node.outputs, port); stated != node.outputs.end();
                 stated = find(node.outputs, port)) {
                if (stated->type != type) {
                    reject(node, "output " + excerpt(stated->name) + " is said to be a " +
                                     name_of(stated->type) + ", but is a " + name_of(type));
                }
                node.outputs.erase(stated);
            }
        }
        if (!node.outputs.empty()) {
            reject(node, "there is no output " + excerpt(node.outputs.front().name) + "; its outputs are " +
                             names_of(kind.outputs));
        }
        node.outputs = std::move(outputs);
    }

    void link_node(std::size_t i) {
        const GraphNode& node = out_.graph.nodes[i];
        for (const GraphPort& input : node.inputs) {
            out_.nodes[i].sources.push_back(source_of(input, [&](const std::string& what) {
                reject(node, "input " + excerpt(input.name) + ": " + what);
            }));
        }
    }

    /// Resolves a port's reference and compares its type.
    template <typename Fail>
    GraphSource source_of(const GraphPort& port, const Fail& fail) const {
        if (port.from.empty()) return {GraphSource::nothing, 0};
        const std::size_t dot = port.from.find('.');
        const std::string node_name = port.from.substr(0, dot);
        const std::string output = dot == std::string::npos ? "" : port.from.substr(dot + 1);
        GraphSource source;
        const std::vector<GraphPort>* ports = &out_.graph.inputs;
        const NodeKind* kind = nullptr;
        if (node_name != inputs_name) {
            const auto place = places_.find(node_name);
            if (place == places_.end())
                fail("its ref is " + excerpt(port.from) + ", and there is no node " + excerpt(node_name));
            source.node = place->second;
            ports = &out_.graph.nodes[source.node].outputs;
            kind = out_.nodes[source.node].kind;
        }
        if (output.empty() && ports->size() != 1)
            fail("its ref is " + excerpt(port.from) + "; it must have the form node.output");
        for (; source.port < ports->size(); ++source.port) {
            const bool also = kind != nullptr && source.port < kind->outputs.size() && !output.empty() &&
                              kind->outputs[source.port].also == output;
            if (output.empty() || (*ports)[source.port].name == output || also) break;
        }
        if (source.port == ports->size()) {
            fail("its ref is " + excerpt(port.from) + ", and " +
                 (kind == nullptr ? "the function has no such input; it has "
                                  : "that node has no such output; it has ") +
                 names_of(*ports));
        }
        const GraphType type = (*ports)[source.port].type;
        if (type != port.type) {
            fail("it is a " + std::string(name_of(port.type)) + " fed by " + excerpt(port.from) +
                 ", which is a " + name_of(type));
        }
        return source;
    }

    /// Depth-first search with an explicit stack, because graphs may be long chains.
    void put_in_order() {
        enum : char { fresh, open, done };
        std::vector<char> state(out_.nodes.size(), fresh);
        std::vector<std::pair<std::uint32_t, std::size_t>> stack;
        for (std::uint32_t root = 0; root < out_.nodes.size(); ++root) {
            if (state[root] == fresh) stack.emplace_back(root, 0);
            while (!stack.empty()) {
                const std::uint32_t at = stack.back().first;
                state[at] = open;
                const auto& sources = out_.nodes[at].sources;
                if (stack.back().second == sources.size()) {
                    state[at] = done;
                    out_.order.push_back(at);
                    stack.pop_back();
                    continue;
                }
                const GraphSource& source = sources[stack.back().second++];
                if (!source.is_node() || state[source.node] == done) continue;
                if (state[source.node] == open) {
                    reject(out_.graph.nodes[source.node], "it feeds itself, by way of node " +
                                                              excerpt(out_.graph.nodes[at].identifier) +
                                                              "; a function's graph must be free of cycles");
                }
                stack.emplace_back(source.node, 0);
            }
        }
    }

    const std::string& where_;
    CheckedGraph out_;
    std::map<std::string, std::uint32_t, std::less<>> places_;
};

}  // namespace

CheckedGraph check_graph(ImplicitGraph graph, const std::string& where) {
    return GraphCheck(std::move(graph), where).run();
}

}  // namespace lamella
