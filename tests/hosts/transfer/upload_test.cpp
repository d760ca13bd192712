// Bytes on their way: digests against published values, pipes, forms, and sources that open the same bytes
// again.
#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <thread>

#include "hosts/transfer/byte_pipe.h"
#include "hosts/transfer/multipart_body.h"
#include "hosts/transfer/upload_source.h"
#include "tests/app/commands/folder.h"

namespace upload_test {

using namespace lamella;

namespace {

/// Returns all bytes, asking again while none are there.
std::string all_of(UploadBytes& bytes, std::size_t step) {
    std::string text;
    std::string room(step, '\0');
    while (const auto count = bytes.take(room)) {
        text.append(room, 0, *count);
        if (*count == 0) std::this_thread::yield();
    }
    return text;
}

std::unique_ptr<UploadSource> counting_source(int lines) {
    return make_computed_source([lines](const auto& write, const CancelToken& cancel) {
        for (int i = 0; i < lines; ++i) {
            stop_if_cancelled(&cancel);
            write("line " + std::to_string(i) + "\n");
        }
    });
}

}  // namespace

TEST_CASE("digests are those of the standards' examples", "[hosts]") {
    UploadDigest digest;
    const std::string abc = "abc";
    digest.add(std::span(abc).first(1));
    digest.add(std::span(abc).subspan(1));
    const UploadFacts facts = digest.facts();
    CHECK(facts.size == 3);
    CHECK(facts.sha256 == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-2
    CHECK(facts.sha1 == "a9993e364706816aba3e25717850c26c9cd0d89d");                            // FIPS 180-2
    CHECK(facts.md5 == "900150983cd24fb0d6963f7d28e17f72");                                     // RFC 1321
    CHECK(facts.crc32 == 0x352441c2);
}

TEST_CASE("a pipe keeps order, holds no more than it may, and stops its writer", "[hosts]") {
    BytePipe pipe(100);
    std::atomic<std::size_t> written{0};
    std::thread writer([&] {
        try {
            for (int i = 0; i < 1000; ++i) {
                pipe.write("0123456789");
                written += 10;
            }
            pipe.end();
        } catch (const PipeClosed&) {
            written = 1;
        }
    });
    std::string taken, room(7, '\0');
    while (taken.size() < 5000) {
        const auto count = pipe.take(room);
        REQUIRE(count);
        taken.append(room, 0, *count);
        CHECK(written <= taken.size() + 100 + 10);
    }
    for (std::size_t i = 0; i < taken.size(); ++i) REQUIRE(taken[i] == static_cast<char>('0' + i % 10));
    pipe.close();
    writer.join();
    CHECK(written == 1);
}

TEST_CASE("a computed source gives the same bytes each time, and its failure at the end", "[hosts]") {
    const auto source = counting_source(20000);
    const std::string once = all_of(*source->open(), 1000);
    CHECK(all_of(*source->open(), 17) == once);
    CHECK(!source->facts());
    source->count(nullptr);
    UploadDigest digest;
    digest.add(once);
    CHECK(source->facts()->sha256 == digest.facts().sha256);
    CHECK(source->facts()->size == once.size());

    const auto failing = make_computed_source([](const auto& write, const CancelToken&) {
        write("half");
        throw InputError("the part is empty");
    });
    CHECK_THROWS_AS(all_of(*failing->open(), 10), InputError);
    // What is not read to its end is stopped.
    const auto endless = make_computed_source([](const auto& write, const CancelToken& cancel) {
        for (;;) {
            stop_if_cancelled(&cancel);
            write("more");
        }
    });
    std::string room(10, '\0');
    const auto bytes = endless->open();
    while (bytes->take(room) == std::size_t{0}) std::this_thread::yield();
}

TEST_CASE("a form is as long as it says, and what comes last knows the file", "[hosts]") {
    for (const std::size_t size : {0, 1, 5000}) {
        const Folder folder;
        const std::string content(size, 'x');
        std::ofstream(folder / "a.gcode") << content;
        UploadForm form;
        form.before = {{"root", "gcodes"}};
        form.file_name = "a.gcode";
        form.after = [](const UploadFacts& sent) {
            return std::vector<FormField>{{"checksum", sent.sha256}};
        };
        MultipartBody body(form, make_file_source(folder / "a.gcode")->open());
        const std::uint64_t told = body.size_with(size);
        const std::string text = all_of(body, 333);
        CHECK(text.size() == told);
        UploadDigest digest;
        digest.add(content);
        const std::string head = "filename=\"a.gcode\"\r\nContent-Type: application/octet-stream\r\n\r\n";
        const std::size_t at = text.find(head);
        REQUIRE(at != std::string::npos);
        CHECK(text.substr(at + head.size(), size + 2) == content + "\r\n");
        CHECK(text.find("name=\"root\"\r\n\r\ngcodes\r\n") < at);
        CHECK(text.find("name=\"checksum\"\r\n\r\n" + digest.facts().sha256 + "\r\n") > at);
        CHECK(text.ends_with("--\r\n"));
    }
}

TEST_CASE("a file that is gone is told", "[hosts]") {
    CHECK_THROWS_WITH(make_file_source("/nowhere/a.gcode")->open(),
                      Catch::Contains("/nowhere/a.gcode: cannot be read"));
}

}  // namespace upload_test
