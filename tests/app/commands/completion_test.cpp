// Completion scripts and manual pages: they name what the help names.
#include <catch2/catch.hpp>
#include <sstream>
#include <vector>

#include "recipe/machine_profiles.h"
#include "recipe/settings.h"
#include "tests/app/commands/command_run.h"

namespace completion_test {

using namespace lamella;

namespace {

/// The first words of the lines that a help has between two headings.
std::vector<std::string> listed_commands() {
    std::vector<std::string> names;
    std::istringstream lines(run_lamella("--help").out);
    bool inside = false;
    for (std::string line; std::getline(lines, line) && !(inside && line.empty());) {
        if (inside) names.push_back(line.substr(2, line.find(' ', 2) - 2));
        inside = inside || line.starts_with("Subcommands:");
    }
    return names;
}

/// The options that --help-all shows of a command: "-o", "--output", ...
std::vector<std::string> listed_options(const std::string& command) {
    std::vector<std::string> names;
    std::istringstream lines(run_lamella(command + " --help-all").out);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  -")) continue;
        std::istringstream words(line.substr(2, line.find(' ', 2) - 2));
        for (std::string name; std::getline(words, name, ',');) names.push_back(name);
    }
    return names;
}

/// A text's part that begins behind `from` and ends before `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from);
    return begin == std::string::npos ? "" : text.substr(begin, text.find(to, begin) - begin);
}

/// An option as roff has it.
std::string in_roff(const std::string& name) {
    std::string text;
    for (const char c : name) text += c == '-' ? std::string("\\-") : std::string(1, c);
    return "\\fB" + text + "\\fR";
}

bool has_word(std::string text, const std::string& word) {
    for (char& c : text) c = std::string_view("'\"{},=[()*").find(c) == std::string_view::npos ? c : ' ';
    std::istringstream words(text);
    for (std::string each; words >> each;) {
        if (each == word) return true;
    }
    return false;
}

/// The lines of the script for fish that hold for a command.
std::string fish_lines_of(const std::string& script, const std::string& command) {
    std::istringstream lines(script);
    std::string found;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("-n '__lamella_in ") == std::string::npos) continue;
        if (has_word(between(line, "__lamella_in ", "'"), command)) found += line + " \n";
    }
    return found;
}

/// "--output" as ` -l output `.
std::string in_fish(const std::string& option) {
    return option.starts_with("--") ? " -l " + option.substr(2) + " " : " -s " + option.substr(1) + " ";
}

}  // namespace

TEST_CASE("completion and manual pages name every command and every option that the help knows") {
    const std::string bash = run_lamella("completion bash").out, zsh = run_lamella("completion zsh").out;
    const std::string fish = run_lamella("completion fish").out;
    const std::string overview = run_lamella("man").out;
    const std::string bash_recipe = between(bash, "local recipe=", "\n");
    const std::string zsh_recipe = between(zsh, "local -a recipe=", "\n    )\n");
    const auto commands = listed_commands();
    REQUIRE(commands.size() > 15);
    for (const std::string& command : commands) {
        CAPTURE(command);
        CHECK(has_word(between(bash, "_lamella_commands=", "\n"), command));
        CHECK(mentions(zsh, "'" + command + ":"));
        CHECK(mentions(fish, " -n __lamella_first -a " + command + " "));
        CHECK(mentions(overview, "\\fBlamella\\-" + command + "\\fR(1)"));
        const Outcome page = run_lamella("man " + command);
        CHECK(page.code == 0);
        std::string bash_options = between(bash, "        " + command + ") words=", ";;");
        std::string zsh_options = between(zsh, "        " + command + ")\n", ";;");
        if (has_word(bash_options, "$recipe")) bash_options += bash_recipe;
        if (has_word(zsh_options, "$recipe")) zsh_options += zsh_recipe;
        const auto options = listed_options(command);
        REQUIRE(options.size() >= 3);
        for (const std::string& option : options) {
            CAPTURE(option);
            CHECK(has_word(bash_options, option));
            CHECK(has_word(zsh_options, option));
            CHECK(fish_lines_of(fish, command).find(in_fish(option)) != std::string::npos);
            CHECK(page.out.find(in_roff(option)) != std::string::npos);
        }
    }
}

TEST_CASE("completion offers the words that a choice accepts, and the machines") {
    const std::string bash = run_lamella("completion bash").out, zsh = run_lamella("completion zsh").out;
    for (const Setting& setting : settings()) {
        if (setting.type != ValueType::choice || setting.flag.empty()) continue;
        std::string words;
        for (const std::string& word : setting.choices) words += (words.empty() ? "" : " ") + word;
        INFO(setting.name());
        CHECK(bash.find("words='" + words + "'") != std::string::npos);
        CHECK(between(zsh, "'" + setting.flag + "=[", "\n").find(":(" + words + ")") != std::string::npos);
    }
    for (const std::string& machine : MachineProfiles().names()) {
        CHECK(has_word(between(bash, "_lamella_machines=", "\n"), machine));
        CHECK(has_word(between(zsh, "_lamella_machine_list=", "\n)"), machine));
    }
}

TEST_CASE("manual pages have no line that roff would take for a request of its own") {
    for (const std::string& command : {std::string(), std::string("slice"), std::string("check")}) {
        const Outcome page = run_lamella("man " + command);
        CHECK(page.out.starts_with(".TH LAMELLA"));
        std::istringstream lines(page.out);
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with('.') && !line.starts_with('\'')) continue;
            const std::string macro = line.substr(0, line.find(' '));
            INFO(line);
            CHECK(has_word(".TH .SH .SS .TP .PP .br .nf .fi", macro));
        }
    }
}

TEST_CASE("an unknown shell or command is bad input") {
    const Outcome shell = run_lamella("completion tcsh");
    CHECK(shell.code == 2);
    CHECK(mentions(shell.err, "tcsh not in {bash,zsh,fish}"));
    CHECK(run_lamella("completion").code == 2);
    const Outcome page = run_lamella("man slcie");
    CHECK(page.code == 2);
    CHECK(mentions(page.err, "did you mean `slice`?"));
    CHECK(run_lamella("man slice -o pages").code == 2);
}

TEST_CASE("all manual pages are written into a folder") {
    const Folder folder;
    REQUIRE(run_lamella("man -o " + folder / "man1").code == 0);
    CHECK(contents(folder / "man1/lamella.1") == run_lamella("man").out);
    for (const std::string& command : listed_commands())
        CHECK(contents(folder / ("man1/lamella-" + command + ".1")) == run_lamella("man " + command).out);
}

}  // namespace completion_test
