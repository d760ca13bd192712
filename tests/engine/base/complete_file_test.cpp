// Files that are complete or not there: contents, failures, and several writers at a time.
#include "engine/base/complete_file.h"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/error.h"
#include "tests/app/commands/folder.h"

namespace complete_file_test {

using namespace lamella;

TEST_CASE("a file is written, and replaced, as a whole") {
    const Folder folder;
    const std::string path = folder / "numbers";
    write_complete_file(path, [](std::ostream& out) { out << "one"; });
    CHECK(contents(path) == "one");
    write_complete_file(path, [](std::ostream& out) { out << "two"; });
    CHECK(contents(path) == "two");
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("what fails while writing leaves the older file and nothing else") {
    const Folder folder;
    const std::string path = folder / "numbers";
    write_complete_file(path, [](std::ostream& out) { out << "one"; });
    CHECK_THROWS_AS(write_complete_file(path,
                                        [](std::ostream& out) {
                                            out << "half";
                                            throw std::runtime_error("enough");
                                        }),
                    std::runtime_error);
    CHECK_THROWS_AS(write_complete_file(path, [](std::ostream& out) { out.setstate(std::ios::failbit); }),
                    FaultError);
    CHECK(contents(path) == "one");
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
    CHECK_THROWS_AS(write_complete_file(folder / "none" + "/x", [](std::ostream&) {}), FaultError);
}

TEST_CASE("writers of one file do not mix") {
    const Folder folder;
    const std::string path = folder / "letters";
    std::vector<std::thread> writers;
    for (const char letter : {'a', 'b', 'c', 'd'}) {
        writers.emplace_back([&path, letter] {
            for (int i = 0; i < 20; ++i)
                write_complete_file(path, [&](std::ostream& out) { out << std::string(50'000, letter); });
        });
    }
    for (std::thread& writer : writers) writer.join();
    const std::string found = contents(path);
    CHECK(found == std::string(50'000, found.at(0)));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

}  // namespace complete_file_test
