// Functions of 3MF's volumetric and implicit extensions (1.0) as plain data: graphs of nodes, and images.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace lamella {

/// What a port of a node carries: a number, three, the 16 of a matrix, or the number of a resource.
enum class GraphType : std::uint8_t { scalar, vector, matrix, resource };

/// "scalar", "vector", "matrix", "resource id".
const char* name_of(GraphType type);
/// Numbers that a value of the type has: 1, 3, 16 or 0.
std::size_t components(GraphType type);

/// An input or output, by its identifier.
struct GraphPort {
    std::string name;
    GraphType type = GraphType::scalar;
    std::string from;  ///< what feeds it: "node.output", or "inputs.name" for the function's own
};

/// A node as its element says, whether that makes sense or not.
struct GraphNode {
    std::string identifier;
    std::string kind;  ///< name of the element: "addition", "functioncall"
    std::vector<GraphPort> inputs, outputs;
    std::vector<double> numbers;  ///< of constants: 1, 3, or 16 row by row
    std::int64_t resource = 0;    ///< of a constant resource id
};

/// An <implicitfunction>.
struct ImplicitGraph {
    std::vector<GraphPort> inputs;   ///< fed by nothing
    std::vector<GraphNode> nodes;    ///< in the order of the file
    std::vector<GraphPort> outputs;  ///< each fed by a node or an input
};

/// How a coordinate outside 0 to 1 is taken. `none`: there is nothing, so the result is undefined.
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

/// The inputs and outputs of a function, whichever it is.
std::vector<GraphPort> inputs_of(const GraphFunction& function);
std::vector<GraphPort> outputs_of(const GraphFunction& function);

}  // namespace lamella
