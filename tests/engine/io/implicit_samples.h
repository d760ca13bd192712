// Functions and level sets written down by hand, for the tests of what reads them.
#pragma once

#include <sstream>

#include "tests/engine/io/package_samples.h"
#include "tests/engine/mesh/mesh_samples.h"

namespace lamella::samples {

/// A model part with the volumetric (v) and the implicit (i) extension.
inline std::string volumetric_xml(const std::string& resources, const std::string& items,
                                  const std::string& attributes = "") {
    return model_xml(resources, items,
                     "xmlns:v=\"http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01\" "
                     "xmlns:i=\"http://schemas.3mf.io/3dmanufacturing/implicit/2023/12\" "
                     "xmlns:n=\"http://example.org/names\" requiredextensions=\"v i\" " +
                         attributes);
}

/// A node: inputs are "scalarref A from.output", outputs "scalar x scalar y".
inline std::string node(const std::string& kind, const std::string& identifier,
                        const std::vector<std::string>& inputs, const std::string& outputs) {
    std::string xml = "<i:" + kind + " identifier=\"" + identifier + "\"><i:in>";
    for (const std::string& input : inputs) {
        std::istringstream words(input);
        std::string type, name, from;
        words >> type >> name >> from;
        xml += "<i:" + type + " identifier=\"" + name + "\" ref=\"" + from + "\"/>";
    }
    xml += "</i:in><i:out>";
    std::istringstream words(outputs);
    for (std::string type, name; words >> type >> name;)
        xml += "<i:" + type + " identifier=\"" + name + "\"/>";
    return xml + "</i:out></i:" + kind + ">";
}

/// A function of a vector pos.
inline std::string graph(const std::string& id, const std::string& name, const std::string& nodes,
                         const std::string& outputs) {
    return "<i:implicitfunction id=\"" + id + "\" displayname=\"" + name +
           "\"><i:in><i:vector identifier=\"pos\"/></i:in>" + nodes + "<i:out>" + outputs +
           "</i:out></i:implicitfunction>";
}

inline std::string constant_node(const std::string& identifier, double value) {
    return "<i:constant identifier=\"" + identifier + "\" value=\"" + number(value) +
           "\"><i:out><i:scalar identifier=\"value\"/></i:out></i:constant>";
}

/// length(pos) - radius, as the output shape; the place itself as place.
inline std::string sphere_function(const std::string& id, double radius) {
    return graph(id, "sphere",
                 constant_node("radius", radius) +
                     node("length", "far", {"vectorref A inputs.pos"}, "scalar result") +
                     node("subtraction", "shape", {"scalarref A far.result", "scalarref B radius.value"},
                          "scalar result"),
                 "<i:scalarref identifier=\"shape\" ref=\"shape.result\"/>"
                 "<i:vectorref identifier=\"place\" ref=\"inputs.pos\"/>");
}

/// |sin x cos y + sin y cos z + sin z cos x| - 0.3, its nodes in no order.
inline std::string gyroid_function(const std::string& id) {
    const auto product = [](const std::string& name, const std::string& s, const std::string& c) {
        return node("multiplication", name, {"scalarref A sines." + s, "scalarref B cosines." + c},
                    "scalar result");
    };
    return graph(
        id, "gyroid",
        node("subtraction", "shape", {"scalarref A size.result", "scalarref B wall.value"}, "scalar result") +
            node("abs", "size", {"scalarref A sum.result"}, "scalar result") +
            node("addition", "sum", {"scalarref A first.result", "scalarref B c.result"}, "scalar result") +
            node("addition", "first", {"scalarref A a.result", "scalarref B b.result"}, "scalar result") +
            product("a", "x", "y") + product("b", "y", "z") + product("c", "z", "x") +
            node("decomposevector", "sines", {"vectorref A sine.result"}, "scalar x scalar y scalar z") +
            node("decomposevector", "cosines", {"vectorref A cosine.result"}, "scalar x scalar y scalar z") +
            node("sin", "sine", {"vectorref A inputs.pos"}, "vector result") +
            node("cos", "cosine", {"vectorref A inputs.pos"}, "vector result") + constant_node("wall", 0.3),
        "<i:scalarref identifier=\"shape\" ref=\"shape.result\"/>");
}

/// The cube from -half to half.
inline std::string box_object(const std::string& id, double half, const std::string& mesh_attributes = "") {
    std::string xml = object_xml(id, box_mesh(dvec3(-half), dvec3(half)));
    xml.insert(xml.find("<mesh") + 5, " " + mesh_attributes);
    return xml;
}

inline std::string level_set_object(const std::string& id, const std::string& attributes) {
    return "<object id=\"" + id + "\" name=\"solid " + id + "\"><v:levelset " + attributes + "/></object>";
}

}  // namespace lamella::samples
