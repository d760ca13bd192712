// Functions of 3MF's volumetric and implicit extensions (1.0) as plain data: graphs of nodes, and images.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace lamella {

/// Type of a node's port: a scalar, a vector of three, a matrix of 16 numbers, or the number of a resource.
enum class GraphType : std::uint8_t { scalar, vector, matrix, resource };

/// Returns "scalar", "vector", "matrix" or "resource id".
const char* name_of(GraphType type);
/// Returns how many numbers a value of the type has: 1, 3, 16 or 0.
std::size_t components(GraphType type);

/// An input or output, identified by name.
struct GraphPort {
    std::string name;
    GraphType type = GraphType::scalar;
    std::string from;  ///< its source: "node.output", or "inputs.name" for an input of the function
};

/// A node as its element states it, not yet checked.
struct GraphNode {
    std::string identifier;
    std::string kind;  ///< name of the element: "addition", "functioncall"
    std::vector<GraphPort> inputs, outputs;
    std::vector<double> numbers;  ///< value of a constant: 1, 3, or 16 numbers row by row
    std::int64_t resource = 0;    ///< value of a constant resource id
};

/// An <implicitfunction>.
struct ImplicitGraph {
    std::vector<GraphPort> inputs;   ///< without a source
    std::vector<GraphNode> nodes;    ///< in the order of the file
    std::vector<GraphPort> outputs;  ///< the source of each is a node or an input
};

/// Treatment of a coordinate outside 0 to 1. `none`: the image ends there, so the result is undefined.
enum class TileStyle : std::uint8_t { wrap, mirror, clamp, none };
enum class ImageFilter : std::uint8_t { linear, nearest };

/// A <functionfromimage3d>: input pos (uvw), outputs color, red, green, blue and alpha.
struct ImageFunction {
    std::int64_t image = 0;  ///< the image3d
    ImageFilter filter = ImageFilter::linear;
    std::array<TileStyle, 3> tiles{TileStyle::wrap, TileStyle::wrap, TileStyle::wrap};  ///< along u, v, w
    double offset = 0;  ///< added to a sample, after the scale
    double scale = 1;
};

struct GraphFunction {
    std::int64_t id = 0;
    std::string name;  ///< displayname; may be empty
    std::variant<ImplicitGraph, ImageFunction> body;
};

/// Return the inputs, or outputs, of a function of either kind.
std::vector<GraphPort> inputs_of(const GraphFunction& function);
std::vector<GraphPort> outputs_of(const GraphFunction& function);

}  // namespace lamella
