// Names and signatures of functions.
#include "engine/io/implicit_graph.h"

namespace lamella {

const char* name_of(GraphType type) {
    switch (type) {
        case GraphType::scalar:
            return "scalar";
        case GraphType::vector:
            return "vector";
        case GraphType::matrix:
            return "matrix";
        default:
            return "resource id";
    }
}

std::size_t components(GraphType type) {
    switch (type) {
        case GraphType::scalar:
            return 1;
        case GraphType::vector:
            return 3;
        case GraphType::matrix:
            return 16;
        default:
            return 0;
    }
}

std::vector<GraphPort> inputs_of(const GraphFunction& function) {
    if (const auto* graph = std::get_if<ImplicitGraph>(&function.body)) return graph->inputs;
    return {{"pos", GraphType::vector, ""}};
}

std::vector<GraphPort> outputs_of(const GraphFunction& function) {
    if (const auto* graph = std::get_if<ImplicitGraph>(&function.body)) return graph->outputs;
    return {{"color", GraphType::vector, ""},
            {"red", GraphType::scalar, ""},
            {"green", GraphType::scalar, ""},
            {"blue", GraphType::scalar, ""},
            {"alpha", GraphType::scalar, ""}};
}

}  // namespace lamella
