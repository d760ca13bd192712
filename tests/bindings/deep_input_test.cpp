// Hostile nesting, in threads with little stack as hosts have them: refused or read, but survived.
#include <pthread.h>

#include <nlohmann/json.hpp>

#include "app/reports/section_server.h"
#include "engine/base/error.h"
#include "engine/formula/formula_parser.h"
#include "engine/formula/formula_vm.h"
#include "engine/io/mesh_reader.h"
#include "procedural/volume/volumetric_model.h"
#include "recipe/base_material.h"
#include "recipe/recipe_draft.h"
#include "tests/bindings/handles_by_call.h"
#include "tests/engine/io/implicit_samples.h"

namespace deep_input_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t stack_bytes = std::size_t{8} << 20U;  // sanitizers take ten times the stack
#else
constexpr std::size_t stack_bytes = std::size_t{512} << 10U;
#endif

/// What is said when `read` runs in a thread with little stack; empty if nothing is.
std::string said(const std::function<void()>& read) {
    struct Job {
        const std::function<void()>& read;
        std::string message;
    } job{read, ""};
    const auto run = [](void* given) -> void* {
        auto& own = *static_cast<Job*>(given);
        try {
            own.read();
        } catch (const InputError& error) {
            own.message = error.what();
        }
        return nullptr;
    };
    pthread_attr_t attributes;
    REQUIRE(pthread_attr_init(&attributes) == 0);
    REQUIRE(pthread_attr_setstacksize(&attributes, stack_bytes) == 0);
    pthread_t thread{};
    REQUIRE(pthread_create(&thread, &attributes, run, &job) == 0);
    REQUIRE(pthread_join(thread, nullptr) == 0);
    pthread_attr_destroy(&attributes);
    return job.message;
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

std::string deep_key(int parts) { return "a" + repeated(".a", parts - 1) + " = 1\n"; }

}  // namespace

TEST_CASE("a recipe or table nested without end is refused", "[depth]") {
    const auto recipe = [](const std::string& text) {
        return said([&] {
            RecipeDraft draft;
            draft.read_text(text, "deep.toml");
        });
    };
    CHECK_THAT(recipe(deep_key(100'000)), Catch::Contains("deep.toml:1:32: a key has more than 16 parts"));
    CHECK_THAT(recipe("[" + repeated("a.", 100'000) + "a]\n"), Catch::Contains("more than 16 parts"));
    CHECK_THAT(recipe("x = " + repeated("[", 100'000)), Catch::Contains("nested more than 16 deep"));
    CHECK_THAT(recipe("x = " + repeated("{a=", 100'000)), Catch::Contains("nested more than 16 deep"));
    CHECK_THAT(said([] { read_materials(deep_key(100'000), "deep.toml"); }),
               Catch::Contains("more than 16 parts"));
    CHECK_THAT(said([] {
                   RecipeDraft draft;
                   draft.read_profile(deep_key(100'000), "deep.toml");
               }),
               Catch::Contains("more than 16 parts"));
}

TEST_CASE("a recipe nested without end is bad input through C and through a server", "[depth][bindings]") {
    const std::string text = deep_key(100'000);
    std::int32_t status = LAMELLA_OK;
    said([&] {
        const Caller caller;
        lamella_recipe* recipe = nullptr;
        if (lamella_recipe_create(caller, &recipe) != LAMELLA_OK) return;
        status = lamella_recipe_add_text(caller, recipe, text.data(), text.size(), "deep.toml");
        lamella_recipe_destroy(recipe);
    });
    CHECK(status == LAMELLA_BAD_INPUT);
    const auto answer = [](const std::string& request) {
        nlohmann::ordered_json head;
        said([&] { head = SectionServer().answer(request).head; });
        return head;
    };
    const auto opened = answer(nlohmann::json{{"method", "open"}, {"text", text}, {"id", 7}}.dump());
    CHECK(opened["ok"] == false);
    CHECK(opened["id"] == 7);
    CHECK_THAT(opened["message"].get<std::string>(), Catch::Contains("more than 16 parts"));
    for (const std::string open : {"[", "{\"a\":"}) {
        const int depth = 1'000'000;
        const std::string close = repeated(open == "[" ? "]" : "}", depth);
        const auto deep =
            answer("{\"method\": \"open\", \"id\": " + repeated(open, depth) + "1" + close + "}");
        CHECK(deep["ok"] == false);
        CHECK_THAT(deep["message"].get<std::string>(), Catch::Contains("the request is nested too deep"));
    }
    CHECK(answer("")["ok"] == false);
}

TEST_CASE("a formula nested without end is refused, and a long one read", "[depth]") {
    const std::vector<std::string> names{"x"};
    for (const std::string open : {"(", "-", "!", "not ", "x^", "sin(", "x ? ", "x ? 1 : ", "max(x, "}) {
        INFO(open);
        CHECK_THAT(said([&] { parse_formula(repeated(open, 60'000) + "x", names); }),
                   Catch::Contains("nested more than 200 deep"));
    }
    CHECK(said([&] { parse_formula("x" + repeated(" + x*x", 50'000), names); }).empty());
    std::string chain = "_0 var-x\n";
    for (int i = 1; i <= 100'000; ++i)
        chain += "_" + std::to_string(i) + " sin _" + std::to_string(i - 1) + "\n";
    CHECK(said([&] {
              const Formula formula = read_vm(chain, "a.vm");
              const double at[] = {0.5, 0, 0};
              if (!(formula.at(at) < 0.5)) throw InputError("the chain of sines is not computed");
          }).empty());
}

TEST_CASE("3MF nested without end is refused, in its XML, components, graphs and calls", "[depth]") {
    const std::string box = object_xml("1", box_mesh(dvec3(0), dvec3(1)));
    const auto mesh = [](const std::string& bytes) { return said([&] { from_memory("a.3mf", bytes); }); };
    const std::string wrapped = repeated("<a>", 300'000) + repeated("</a>", 300'000);
    CHECK(mesh(threemf(wrapped + box, "<item objectid=\"1\"/>")).empty());
    CHECK_THAT(mesh(zip_of({{"3D/3dmodel.model", repeated("<a>", 300'000)}})),
               Catch::Contains("not well-formed XML"));
    std::string objects = box;
    for (int i = 2; i <= 2000; ++i) {
        objects += "<object id=\"" + std::to_string(i) + "\"><components><component objectid=\"" +
                   std::to_string(i - 1) + "\"/></components></object>";
    }
    CHECK_THAT(mesh(threemf(objects, "<item objectid=\"2000\"/>")),
               Catch::Contains("nested more than 32 deep"));

    const auto model = [](const std::string& resources, const char* function) {
        return said([&] {
            VolumetricModel(
                "a.3mf", zip_of({{"3D/3dmodel.model", volumetric_xml(resources, "<item objectid=\"1\"/>")}}))
                .function(function);
        });
    };
    std::string nodes = node("length", "n0", {"vectorref A inputs.pos"}, "scalar result");
    for (int i = 1; i <= 50'000; ++i) {
        nodes += node("sin", "n" + std::to_string(i), {"scalarref A n" + std::to_string(i - 1) + ".result"},
                      "scalar result");
    }
    CHECK(model(box + graph("5", "chain", nodes, "<i:scalarref identifier=\"s\" ref=\"n50000.result\"/>"),
                "chain")
              .empty());
    const auto calls = [&](int depth) {
        std::string functions = box + sphere_function("100", 1);
        for (int i = 101; i <= 100 + depth; ++i) {
            functions += graph(
                std::to_string(i), "",
                "<i:constresourceid identifier=\"which\" value=\"" + std::to_string(i - 1) +
                    "\"><i:out><i:resourceid identifier=\"value\"/></i:out></i:constresourceid>" +
                    node("functioncall", "call",
                         {"resourceref functionID which.value", "vectorref pos inputs.pos"}, "scalar shape"),
                "<i:scalarref identifier=\"shape\" ref=\"call.shape\"/>");
        }
        return model(functions, std::to_string(100 + depth).c_str());
    };
    CHECK(calls(99).empty());
    CHECK_THAT(calls(100), Catch::Contains("calls are nested more than 100 deep"));
    CHECK_THAT(calls(5000), Catch::Contains("calls are nested more than 100 deep"));
}

}  // namespace deep_input_test
