// Printing by HTTP to a simulated machine: what it gets, what is told meanwhile, and how it is left.
#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/app/commands/child_process.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/server/described_form.h"
#include "tests/app/server/printing_server.h"

namespace print_routes_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json, const char* name) { return json.at(name).get<std::string>(); }

/// All messages of the print, a line each.
std::string messages_of(const RunningServer& server) {
    std::string text;
    for (const Json& message : server.json("GET", "/api/print/messages"))
        text += text_of(message, "text") + "\n";
    return text;
}

/// Lines behind the first of several runs.
std::vector<std::string> behind(const std::vector<std::string>& all, const std::vector<std::string>& first) {
    REQUIRE(first.size() <= all.size());
    return {all.begin() + static_cast<std::ptrdiff_t>(first.size()), all.end()};
}

/// Checks that a resumed run prints the file from the beginning of a layer to its end.
void check_rest(const std::vector<std::string>& rest, const std::vector<std::string>& file) {
    const auto is_layer = [](const std::string& line) { return line.starts_with("M73 P"); };
    const auto layer = std::find_if(rest.begin(), rest.end(), is_layer);
    REQUIRE(layer != rest.end());
    const auto in_file = std::find(file.begin(), file.end(), *layer);
    REQUIRE(in_file != file.end());
    CHECK(in_file > std::find_if(file.begin(), file.end(), is_layer));
    CHECK(first_difference({layer, rest.end()}, {in_file, file.end()}) == "");
}

}  // namespace

TEST_CASE("a job is printed by HTTP line by line as its file says", "[server]") {
    PrintingServer server;
    const auto file = server.file_lines();
    const auto outlook = server.json("GET", "/api/jobs/" + server.job + "/print");
    CHECK(outlook["accepted"] == true);
    CHECK(outlook["left"].is_null());
    CHECK(server.print() == Json{{"state", "none"}});
    const auto listener = server.state().events.listen("page");
    const auto begun = std::chrono::steady_clock::now();
    const Json first = server.start({{"park", {7, 190}}});
    CHECK(first["state"] == "connecting");
    const Json document = server.json("GET", "/api/openapi.json");
    std::set<std::string> states;
    int layer = -1, most_ahead = 0;
    Json now;
    REQUIRE(wait_for(60, [&] {
        now = server.print();
        CHECK(misfit(document, document["components"]["schemas"]["Print"], now, "print").empty());
        states.insert(text_of(now, "state"));
        if (now["layer"].is_number()) {
            CHECK(now["layer"] >= layer);
            layer = now["layer"];
            CHECK(now["layers_computed"] > layer);
            most_ahead = std::max(most_ahead, now["layers_computed"].get<int>() - layer);
        }
        return now["state"] == "done" || now["state"] == "failed";
    }));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    CHECK(states.contains("printing"));
    CHECK(now["state"] == "done");
    CHECK(mentions(text_of(now, "message"), "0 resends"));
    CHECK(now["layers_computed"] == now["layers"]);
    CHECK(most_ahead > 1);
    CHECK(now["resumable"] == false);
    CHECK(mentions(text_of(now, "firmware"), "Marlin 2.1.2.1"));
    CHECK(now["lines"] == static_cast<int>(file.size()));
    CHECK(first_difference(job_lines(server.machine.executed()), file) == "");
    CHECK(!fs::exists(server.journal()));
    CHECK(mentions(messages_of(server), "the printer is Marlin"));
    // Not more than two a second, and the last one tells the end.
    std::vector<Json> told;
    for (std::string text = listener->next(1); text.front() != ':'; text = listener->next(1)) {
        const std::string front = "event: print\ndata: ";
        if (text.starts_with(front)) told.push_back(Json::parse(text.substr(front.size())));
    }
    REQUIRE(!told.empty());
    CHECK(static_cast<double>(told.size()) <= 2 * seconds + 2);
    CHECK(told.back() == server.print());
}

TEST_CASE("a print is paused, goes on, is stopped with its heaters off, and is resumed", "[server]") {
    PrintingServer server({}, 15);
    const auto file = server.file_lines();
    server.start({{"park", {7, 190}}});
    REQUIRE(server.prints_layer(2));
    CHECK(server.print()["temperatures"]["nozzle_target"] == 210);
    CHECK(server.print()["lines_a_second"] > 0);
    server.order("pause");
    REQUIRE(server.reaches("paused"));
    REQUIRE(wait_for(20, [&] { return server.machine.executed().back() == "G0 X7 Y190 F6000"; }));
    server.order("resume");
    REQUIRE(server.reaches("printing"));
    REQUIRE(server.prints_layer(4));
    CHECK(server.is_hot());
    CHECK(server.order("stop")["state"] == "stopping");
    REQUIRE(server.reaches("stopped"));
    CHECK(server.machine.executed().back() == "M84");
    CHECK(!server.is_hot());
    CHECK(server.print()["resumable"] == true);
    CHECK(mentions(messages_of(server), "heaters and motors were switched off"));
    CHECK(mentions(text_of(server.start({}, 409), "message"), "is left from a print that was stopped"));
    const Json left = server.json("GET", "/api/jobs/" + server.job + "/print")["left"];
    CHECK(left["is_of_job"] == true);
    CHECK(left["next_layer"] >= 4);
    const auto first = job_lines(server.machine.executed());
    SECTION("from the page") {
        server.start({{"resume", true}});
        REQUIRE(server.reaches("done"));
    }
    SECTION("by the command") {
        write(server.folder() / "part.toml", marlin_ball);
        const Outcome outcome =
            run_lamella("print --resume " + server.folder() / "part.toml" + " --greeting 0.2 --port " +
                        server.machine.path() + " --journal " + server.journal());
        REQUIRE(outcome.code == 0);
    }
    check_rest(behind(job_lines(server.machine.executed()), first), file);
    CHECK(!fs::exists(server.journal()));
}

TEST_CASE("a halt acts at once where the machine can, and says so where it cannot", "[server]") {
    FirmwareOptions firmware;
    firmware.emergency_parser = GENERATE(true, false);
    PrintingServer server(firmware, 15);
    server.start();
    REQUIRE(server.prints_layer(1));
    CHECK(server.print()["halts_at_once"] == firmware.emergency_parser);
    server.order("halt");
    const bool killed = wait_for(20, [&] {
        return server.machine.with([](SimulatedMarlin& printer, double) { return printer.killed(); });
    });
    if (firmware.emergency_parser) {
        CHECK(killed);
        REQUIRE(server.reaches("stopped"));
        CHECK(mentions(text_of(server.print(), "message"), "M112"));
    } else {
        CHECK(!killed);
        REQUIRE(server.reaches("failed"));
        CHECK(mentions(text_of(server.print(), "message"), "switch the printer off"));
    }
}

TEST_CASE("a machine that fails ends the print with its own words", "[server]") {
    PrintingServer server({}, 15);
    server.start();
    REQUIRE(server.prints_layer(1));
    server.machine.with([](SimulatedMarlin& printer, double) {
        printer.say("echo:fan 2 stands still\nError:Thermal Runaway, system stopped! Heater_ID: 0");
    });
    REQUIRE(server.reaches("failed"));
    CHECK(mentions(text_of(server.print(), "message"), "Thermal Runaway"));
    CHECK(server.print()["resumable"] == true);
    CHECK(mentions(messages_of(server), "fan 2 stands still\n"));
    server.order("stop", 409);
}

TEST_CASE("what a printer asks of a person is told and answered", "[server]") {
    FirmwareOptions firmware;
    firmware.host_prompts = firmware.emergency_parser = true;
    PrintingServer server(firmware, 15);
    const std::string with_stop = marlin_ball + "layer_script = \"M0\"\n";
    server.job = server.build(with_stop);
    server.start();
    REQUIRE(wait_for(60, [&] {
        const Json now = server.print();
        return now.contains("question") && now["question"].is_object() && !now["question"]["buttons"].empty();
    }));
    CHECK(server.print()["question"]["buttons"][0] == "Continue");
    CHECK(wait_for(5, [&] { return mentions(messages_of(server), "the printer waits for you"); }));
    CHECK(server.json("POST", "/api/print/choose", {{"button", 0}})["print"] == 1);
    CHECK(wait_for(20, [&] {
        return server.machine.with(
            [](SimulatedMarlin& printer, double) { return !printer.waits_for_user(); });
    }));
    server.order("stop");
    REQUIRE(server.reaches("stopped"));
}

TEST_CASE("what cannot be printed is refused before anything is opened", "[server]") {
    PrintingServer server({}, 5);
    const auto refused = [&](const Json& body, int status) {
        return text_of(server.json("POST", "/api/jobs/" + server.job + "/print", body, status), "message");
    };
    const auto port = [](const std::string& path) { return Json{{"to", {{"serial", path}}}}; };
    const std::string file = server.folder() / "precious.txt";
    write(file, "as it was");
    fs::create_symlink(server.machine.path(), server.folder() / "link");
    CHECK(mentions(refused(port("/dev/ttyNone0"), 404), "there is no port"));
    for (const std::string& path :
         {file, server.folder() / "link", std::string("/dev/.." + file), std::string("/dev/null"),
          std::string("/dev/tty"), std::string("/dev"), std::string("relative"), std::string()}) {
        INFO(path);
        CHECK(mentions(refused(port(path), 400), "accepted: the path of a serial port"));
    }
    CHECK(contents(file) == "as it was");
    CHECK(mentions(refused(Json::object(), 400), "to: accepted"));
    CHECK(mentions(refused({{"to", {{"http", "printer"}}}}, 400), "to.http: unknown"));
    const auto with = [&](const Json& more) {
        Json body = server.request();
        body["to"].update(more);
        return body;
    };
    CHECK(mentions(refused(with({{"baud", 12}}), 400), "to.baud"));
    CHECK(mentions(refused(with({{"ping_pong", 1}}), 400), "to.ping_pong: accepted: true or false"));
    CHECK(mentions(refused(server.request({{"park", {1}}}), 400), "park: accepted"));
    CHECK(mentions(refused(server.request({{"resume", true}}), 400), "there is no journal"));
    CHECK(mentions(refused(server.request({{"resume_z", 3}}), 400), "resume_z"));
    CHECK(mentions(refused(server.request({{"speed", 3}}), 400), "speed: unknown; accepted: to, park"));
    for (const char* what : {"pause", "resume", "stop", "halt"}) server.order(what, 409);
    const std::string marlin = server.job;
    server.job = server.build(
        "[part]\nshape = \"sphere\"\nradius = 5\n[layers]\nheight = 0.1\n[printer]\nprofile = "
        "\"prusa-sl1s\"\n");
    CHECK(mentions(refused(server.request(), 400), "does not use G-code"));
    const Json outlook = server.json("GET", "/api/jobs/" + server.job + "/print");
    CHECK(outlook["accepted"] == false);
    CHECK(mentions(text_of(outlook, "message"), "accepted: a machine that does"));
    CHECK(server.machine.executed().empty());
    server.job = marlin;
    server.start();
    CHECK(mentions(refused(server.request(), 409), "a print runs already"));
    httplib::Client stranger = server.client();
    for (const char* address : {"/api/print", "/api/ports", "/api/print/messages"})
        CHECK(stranger.Get(address)->status == 401);
    CHECK(stranger.Post("/api/print/halt", "", "application/json")->status == 401);
    CHECK(server.print()["state"] != "stopping");
}

TEST_CASE("a server that is interrupted stops its print and leaves the heaters off", "[server]") {
    const Folder folder;
    PtyMachine machine({}, 15);
    const pid_t child =
        start_lamella("serve --http --token " + test_token + " --folder " + folder.path().string(), folder);
    const std::string front = "http://127.0.0.1:";
    REQUIRE(wait_for(60, [&] { return contents(folder / "out").find('\n') != std::string::npos; }));
    const std::string address = contents(folder / "out");
    REQUIRE(address.starts_with(front));
    httplib::Client client("127.0.0.1", std::stoi(address.substr(front.size())));
    const httplib::Headers token{{"Authorization", "Bearer " + test_token}};
    const auto post = [&](const std::string& path, const Json& body) {
        const auto reply = client.Post(path.c_str(), token, body.dump(), "application/json");
        REQUIRE(reply);
        return Json::parse(reply->body);
    };
    const std::string job = post("/api/jobs", {{"text", marlin_ball}}).at("job");
    post("/api/jobs/" + job + "/print", {{"to", {{"serial", machine.path()}, {"greeting", 0.2}}}});
    REQUIRE(wait_for(60, [&] { return count_of(machine.executed(), "M73 P25") > 0; }));
    kill(child, SIGTSTP);
    int status = 0;
    CHECK(!wait_for(0.3, [&] { return waitpid(child, &status, WNOHANG | WUNTRACED) == child; }));
    kill(child, SIGINT);
    CHECK(exit_code(child) == 0);
    CHECK(mentions(contents(folder / "err"), "stopping the print"));
    CHECK(machine.executed().back() == "M84");
    CHECK(!machine.with([](SimulatedMarlin& printer, double) { return printer.heating(); }));
    CHECK(fs::exists(folder / "sphere.print.journal"));
}

}  // namespace print_routes_test
