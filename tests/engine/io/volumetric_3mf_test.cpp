// What is wrong in functions' graphs is said, with the node that it is about.
#include "engine/io/volumetric_3mf.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/engine/io/implicit_samples.h"

namespace volumetric_3mf_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

VolumetricPart read(const std::string& resources) {
    const std::string bytes =
        zip_of({{"3D/3dmodel.model", volumetric_xml(resources, "<item objectid=\"1\"/>")}});
    const MeshSource source{"a.3mf", bytes, 1.0};
    constexpr std::string_view supported[] = {"/volumetric/", "/implicit/"};
    Model3mf model(source, supported);
    return read_volumetric_part(model, model.root());
}

/// What is said of resources at once, or once a function of them is used.
std::string refusal(const std::string& resources) {
    try {
        const VolumetricPart part = read(resources);
        for (const auto& [id, function] : part.functions) require_sound(function);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing was refused";
}

const std::string shape = "<i:scalarref identifier=\"shape\" ref=\"last.result\"/>";

/// What is said of a function with these nodes.
std::string refused(const std::string& nodes, const std::string& outputs = shape) {
    return refusal(graph("5", "f", nodes, outputs));
}

const std::string length_of_place = node("length", "far", {"vectorref A inputs.pos"}, "scalar result");

}  // namespace

TEST_CASE("functions are read with their nodes in an order that can be evaluated", "[implicit]") {
    const VolumetricPart part = read(gyroid_function("5") + sphere_function("6", 1));
    REQUIRE(part.functions.size() == 2);
    const CheckedGraph& checked = part.functions.at(5).graph;
    CHECK(checked.order.size() == checked.nodes.size());
    std::vector<char> done(checked.nodes.size(), 0);
    for (const std::uint32_t i : checked.order) {
        for (const GraphSource& source : checked.nodes[i].sources)
            CHECK((source.node == GraphSource::function_inputs || done[source.node] == 1));
        done[i] = 1;
    }
    CHECK(part.functions.at(6).function.name == "sphere");
}

TEST_CASE("cycles and dangling references are refused", "[implicit]") {
    CHECK_THAT(refused(node("abs", "last", {"scalarref A other.result"}, "scalar result") +
                       node("sign", "other", {"scalarref A third.result"}, "scalar result") +
                       node("abs", "third", {"scalarref A last.result"}, "scalar result")),
               Catch::Contains("a.3mf: function 5 \"f\": node ") &&
                   Catch::Contains("it feeds itself, by way of node"));
    CHECK_THAT(refused(node("abs", "last", {"scalarref A last.result"}, "scalar result")),
               Catch::Contains("node \"last\" (abs): it feeds itself"));
    // A cycle that no output needs is one all the same.
    CHECK_THAT(refused(length_of_place + node("abs", "a", {"scalarref A a.result"}, "scalar result"),
                       "<i:scalarref identifier=\"shape\" ref=\"far.result\"/>"),
               Catch::Contains("node \"a\" (abs): it feeds itself"));
    CHECK_THAT(
        refused(node("abs", "last", {"scalarref A nowhere.result"}, "scalar result")),
        Catch::Contains("node \"last\" (abs): input \"A\": its ref is \"nowhere.result\", and there is no "
                        "node \"nowhere\""));
    CHECK_THAT(refused(length_of_place + node("abs", "last", {"scalarref A far.value"}, "scalar result")),
               Catch::Contains("its ref is \"far.value\", and that node has no such output; it has result"));
    CHECK_THAT(refused(node("abs", "last", {"scalarref A inputs.radius"}, "scalar result")),
               Catch::Contains("the function has no such input; it has pos"));
    CHECK_THAT(refused(length_of_place), Catch::Contains("function 5 \"f\": output \"shape\": its ref is "
                                                         "\"last.result\", and there is no node \"last\""));
    CHECK_THAT(refused(length_of_place, ""), Catch::Contains("it has no outputs"));
}

TEST_CASE("inputs of the wrong number, name or type are refused", "[implicit]") {
    CHECK_THAT(refused(node("addition", "last", {"vectorref A inputs.pos"}, "vector result")),
               Catch::Contains("node \"last\" (addition): input \"B\" is missing; its inputs are A, B"));
    CHECK_THAT(
        refused(length_of_place +
                node("abs", "last", {"scalarref A far.result", "scalarref B far.result"}, "scalar result")),
        Catch::Contains("node \"last\" (abs): there is no input \"B\"; its inputs are A"));
    CHECK_THAT(refused(node("abs", "last", {"scalarref A inputs.pos"}, "scalar result")),
               Catch::Contains("input \"A\": it is a scalar fed by \"inputs.pos\", which is a vector"));
    CHECK_THAT(refused(length_of_place + node("addition", "last",
                                              {"vectorref A inputs.pos", "scalarref B far.result"},
                                              "vector result")),
               Catch::Contains(
                   "input \"B\" is a scalar and the one before a vector; all of them must be of one type"));
    CHECK_THAT(refused(length_of_place + node("length", "last", {"scalarref A far.result"}, "scalar result")),
               Catch::Contains("node \"last\" (length): input \"A\" is a scalar; it may be a vector"));
    CHECK_THAT(refused(node("length", "last", {"vectorref A inputs.pos"}, "vector result")),
               Catch::Contains("output \"result\" is said to be a vector, but is a scalar"));
    CHECK_THAT(refused(node("length", "last", {"vectorref A inputs.pos"}, "scalar value")),
               Catch::Contains("there is no output \"value\"; its outputs are result"));
    CHECK_THAT(refused(length_of_place + length_of_place),
               Catch::Contains("node \"far\" (length): another node has this identifier already"));
    CHECK_THAT(refused(node("length", "inputs", {"vectorref A inputs.pos"}, "scalar result")),
               Catch::Contains("the names inputs and outputs are kept"));
}

TEST_CASE("nodes that are not known are refused by name", "[implicit]") {
    CHECK_THAT(refused(node("beamlattice", "last", {"vectorref pos inputs.pos"}, "scalar distance")),
               Catch::Contains("node \"last\" (beamlattice): nodes of this kind are not supported"));
    CHECK_THAT(refused("<v:length identifier=\"far\"/>"),
               Catch::Contains("belongs to the namespace") && Catch::Contains("not supported"));
    CHECK_THAT(refused("<i:constant identifier=\"c\" value=\"many\"/>"),
               Catch::Contains("constant \"c\": value=\"many\" is no number"));
    CHECK_THAT(refused("<i:constmat identifier=\"c\" matrix=\"1 2 3\"/>"),
               Catch::Contains("is not 16 numbers"));
    CHECK(read("<v:scalarfield id=\"1\"/>").functions.at(1).fault.find("a.3mf: ") == 0);
    CHECK_THAT(refusal("<v:scalarfield id=\"1\"/>"),
               Catch::Contains("scalarfield: resources of this kind are not supported"));
    CHECK_THAT(refusal(sphere_function("5", 1) + sphere_function("5", 2)),
               Catch::Contains("two resources have the number 5"));
    CHECK_THAT(refusal("<v:volumedata id=\"8\"><v:property name=\"a\" functionid=\"0\" channel=\"b\"/>"
                       "</v:volumedata>"),
               Catch::Contains("property: functionid=\"0\" is no number of 1 or more"));
}

TEST_CASE("calls that do not fit, or go round, are refused when they are written out", "[implicit]") {
    const auto calling = [](const std::string& id, const std::string& callee,
                            const std::vector<std::string>& inputs, const std::string& outputs) {
        std::vector<std::string> all{"resourceref functionID which.value"};
        all.insert(all.end(), inputs.begin(), inputs.end());
        return graph(id, "",
                     "<i:constresourceid identifier=\"which\" resourceid=\"" + callee +
                         "\"><i:out><i:resourceid identifier=\"value\"/></i:out></i:constresourceid>" +
                         node("functioncall", "call", all, outputs),
                     "<i:scalarref identifier=\"shape\" ref=\"call.shape\"/>");
    };
    const auto lowered = [](const std::string& resources) -> std::string {
        const VolumetricPart part = read(resources);
        FormulaBuilder builder;
        std::vector<GradingPtr> others;
        const GraphResources given{[&](std::int64_t id) -> const CheckedFunction* {
                                       const auto found = part.functions.find(id);
                                       return found == part.functions.end() ? nullptr : &found->second;
                                   },
                                   {},
                                   {}};
        GraphValue place;
        place.type = GraphType::vector;
        for (int i = 0; i < 3; ++i) place.parts[static_cast<std::size_t>(i)] = builder.input(i);
        const std::string wanted[] = {"shape"};
        try {
            GraphLowering(builder, others, given).call(part.functions.at(9), {{"pos", place}}, wanted);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing was refused";
    };
    const std::string sphere = sphere_function("5", 1);
    CHECK(lowered(sphere + calling("9", "5", {"vectorref pos inputs.pos"}, "scalar shape")) ==
          "nothing was refused");
    CHECK_THAT(lowered(calling("9", "9", {"vectorref pos inputs.pos"}, "scalar shape")),
               Catch::Contains("a.3mf: function 9: it calls itself"));
    CHECK_THAT(lowered(calling("9", "8", {"vectorref pos inputs.pos"}, "scalar shape") +
                       calling("8", "9", {"vectorref pos inputs.pos"}, "scalar shape")),
               Catch::Contains("it calls itself; calls must be free of cycles"));
    CHECK_THAT(lowered(calling("9", "7", {"vectorref pos inputs.pos"}, "scalar shape")),
               Catch::Contains(
                   "function 9: node \"call\" (functioncall): it calls function 7, which does not exist"));
    CHECK_THAT(lowered(sphere + calling("9", "5", {}, "scalar shape")),
               Catch::Contains("function 5 \"sphere\": its input \"pos\" is not given; it takes pos"));
    CHECK_THAT(lowered(sphere + calling("9", "5", {"vectorref pos inputs.pos", "vectorref more inputs.pos"},
                                        "scalar shape")),
               Catch::Contains("it has no input \"more\"; it takes pos"));
    CHECK_THAT(
        lowered(sphere + calling("9", "5", {"vectorref pos inputs.pos"}, "scalar shape scalar colour")),
        Catch::Contains("it has no output \"colour\"; it gives shape, place"));
    CHECK_THAT(lowered(sphere + calling("9", "5", {"vectorref pos inputs.pos"}, "scalar shape scalar place")),
               Catch::Contains("output \"place\" is said to be a scalar, but function 5 gives a vector"));
}

TEST_CASE("calls that multiply are given up, long chains are not", "[implicit]") {
    // Each function calls the next one twice, with different places: 2^40 calls.
    std::string resources = sphere_function("50", 1);
    for (int i = 9; i < 50; ++i) {
        const std::string twice =
            "<i:constresourceid identifier=\"which\" value=\"" + std::to_string(i + 1) +
            "\"/><i:constvec identifier=\"shift\" x=\"" + std::to_string(i) + "\" y=\"0\" z=\"0\"/>" +
            node("addition", "there", {"vectorref A inputs.pos", "vectorref B shift.vector"},
                 "vector result") +
            node("functioncall", "a", {"resourceref functionID which.value", "vectorref pos inputs.pos"},
                 "scalar shape") +
            node("functioncall", "b", {"resourceref functionID which.value", "vectorref pos there.result"},
                 "scalar shape") +
            node("min", "both", {"scalarref A a.shape", "scalarref B b.shape"}, "scalar result");
        resources +=
            graph(std::to_string(i), "", twice, "<i:scalarref identifier=\"shape\" ref=\"both.result\"/>");
    }
    const VolumetricPart part = read(resources);
    FormulaBuilder builder;
    std::vector<GradingPtr> others;
    const GraphResources given{[&](std::int64_t id) { return &part.functions.at(id); }, {}, {}};
    GraphValue place;
    place.type = GraphType::vector;
    for (int i = 0; i < 3; ++i) place.parts[static_cast<std::size_t>(i)] = builder.input(i);
    const std::string wanted[] = {"shape"};
    GraphLowering lowering(builder, others, given);
    CHECK_THROWS_WITH(lowering.call(part.functions.at(9), {{"pos", place}}, wanted),
                      Catch::Contains("more than 1,000,000"));
    // A chain of 50,000 nodes.
    std::string chain = node("length", "n0", {"vectorref A inputs.pos"}, "scalar result");
    for (int i = 1; i < 50'000; ++i)
        chain += node("cos", "n" + std::to_string(i), {"scalarref A n" + std::to_string(i - 1) + ".result"},
                      "scalar result");
    CHECK(read(graph("5", "", chain, "<i:scalarref identifier=\"shape\" ref=\"n49999.result\"/>"))
              .functions.size() == 1);
}

}  // namespace volumetric_3mf_test
