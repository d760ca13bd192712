// The order of upload, check and start, against a host whose every answer is scripted.
#include "hosts/send_upload.h"

#include <catch2/catch.hpp>
#include <random>

namespace send_upload_test {

using namespace lamella;

namespace {

const std::string content = "G28\nG1 X10\n";

std::unique_ptr<UploadSource> content_source() {
    return make_computed_source([](const auto& write, const CancelToken&) { write(content); });
}

/// What happens to a request: nothing, a failure before it is heard, or one after it was done.
enum class Fate : unsigned char { fine, busy, unreachable, lost_before, lost_after, refused, cut };

/// A host in memory. Each request takes the next fate of its kind; all further ones are fine.
class ScriptedHost : public NetworkHost {
  public:
    std::vector<Fate> uploads, starts, statuses;
    std::optional<std::string> file;
    std::string printing;
    int started = 0;
    bool started_cut = false;

    HostFacts facts() override { return {"Script 1", ""}; }
    UploadNeeds needs() const override { return UploadNeeds::nothing; }
    std::optional<HostFile> find(const std::string& /*name*/) override {
        return file ? std::optional(HostFile{file->size()}) : std::nullopt;
    }
    UploadFacts upload(const std::string& /*name*/, UploadSource& source,
                       const std::function<void(std::uint64_t)>& /*on_sent*/) override {
        const Fate fate = next(uploads);
        fail_before(fate);
        const auto bytes = source.open();
        std::string text, room(64, '\0');
        UploadDigest digest;
        while (const auto count = bytes->take(room)) text.append(room, 0, *count);
        digest.add(text);
        file = fate == Fate::cut ? text.substr(0, 3) : text;
        fail_after(fate);
        return digest.facts();
    }
    void start(const std::string& name) override {
        const Fate fate = next(starts);
        fail_before(fate);
        ++started;
        started_cut = started_cut || *file != content;
        printing = name;
        fail_after(fate);
    }
    HostStatus status() override {
        fail_before(next(statuses));
        HostStatus status;
        status.state = printing.empty() ? PrintState::idle : PrintState::printing;
        status.file = printing;
        return status;
    }
    void pause() override {}
    void resume() override {}
    void cancel() override {}
    bool is_plain() const override { return true; }

  private:
    static Fate next(std::vector<Fate>& fates) {
        if (fates.empty()) return Fate::fine;
        const Fate fate = fates.front();
        fates.erase(fates.begin());
        return fate;
    }
    static void fail_before(Fate fate) {
        if (fate == Fate::busy) throw HostError(HostFailure::busy, "busy", 503);
        if (fate == Fate::unreachable) throw HostError(HostFailure::unreachable, "not there");
        if (fate == Fate::lost_before) throw HostError(HostFailure::unanswered, "lost");
        if (fate == Fate::refused) throw HostError(HostFailure::refused, "no", 413);
    }
    static void fail_after(Fate fate) {
        if (fate == Fate::lost_after) throw HostError(HostFailure::unanswered, "lost");
    }
};

SendSettings quick_settings() {
    SendSettings settings;
    settings.name = "part-1a2b3c4d.gcode";
    settings.start = true;
    settings.retry = {5, 0.001, 0.01};
    return settings;
}

}  // namespace

TEST_CASE("what passes is lived through, and a print is started once", "[hosts]") {
    for (const Fate fate : {Fate::busy, Fate::unreachable, Fate::lost_before, Fate::lost_after, Fate::cut}) {
        ScriptedHost host;
        host.uploads = {fate, fate, fate};
        const SendReport report = send_upload(host, *content_source(), quick_settings());
        CHECK(report.started);
        CHECK(report.size == content.size());
        CHECK(host.file == content);
        CHECK(host.started == 1);
        CHECK(!host.started_cut);
    }
}

TEST_CASE("a start whose answer is lost is not repeated", "[hosts]") {
    ScriptedHost heard, unheard;
    heard.starts = {Fate::lost_after};
    CHECK(send_upload(heard, *content_source(), quick_settings()).started);
    CHECK(heard.started == 1);
    unheard.starts = {Fate::lost_before};
    CHECK_THROWS_WITH(send_upload(unheard, *content_source(), quick_settings()),
                      Catch::Contains("was not asked twice"));
    CHECK(unheard.started == 0);
    ScriptedHost busy;
    busy.starts = {Fate::busy, Fate::unreachable};
    CHECK(send_upload(busy, *content_source(), quick_settings()).started);
    CHECK(busy.started == 1);
}

TEST_CASE("a refusal is final, and nothing is started", "[hosts]") {
    ScriptedHost host;
    host.uploads = {Fate::refused};
    CHECK_THROWS_AS(send_upload(host, *content_source(), quick_settings()), HostError);
    CHECK(host.started == 0);
    ScriptedHost other;
    other.printing = "other.gcode";
    CHECK_THROWS_AS(send_upload(other, *content_source(), quick_settings()), InputError);
    CHECK(!other.file);
}

TEST_CASE("a second call finds the file and the print", "[hosts]") {
    ScriptedHost host;
    CHECK(send_upload(host, *content_source(), quick_settings()).uploaded);
    const SendReport again = send_upload(host, *content_source(), quick_settings());
    CHECK(!again.uploaded);
    CHECK(again.prints);
    CHECK(!again.started);
    CHECK(host.started == 1);
}

TEST_CASE("of 500 random scripts none starts twice, and none starts a part of a file", "[hosts]") {
    std::mt19937 random(45);
    constexpr Fate fates[] = {Fate::fine,       Fate::busy,    Fate::unreachable, Fate::lost_before,
                              Fate::lost_after, Fate::refused, Fate::cut};
    const auto draw = [&](std::vector<Fate>& script) {
        for (auto i = random() % 6; i > 0; --i) script.push_back(fates[random() % std::size(fates)]);
    };
    int done = 0;
    SendSettings settings = quick_settings();
    settings.retry = {4, 0, 0};
    for (int run = 0; run < 500; ++run) {
        ScriptedHost host;
        draw(host.uploads);
        draw(host.starts);
        draw(host.statuses);
        std::erase(host.statuses, Fate::cut);
        try {
            const SendReport report = send_upload(host, *content_source(), settings);
            REQUIRE(report.prints);
            REQUIRE(host.started == 1);
            ++done;
        } catch (const Error&) {
            REQUIRE(host.started <= 1);
        }
        REQUIRE(!host.started_cut);
    }
    CHECK(done > 50);
}

TEST_CASE("names are such that every host takes them", "[hosts]") {
    CHECK(upload_name("my part/ä; rm -rf", "0123456789abcdef", ".gcode") ==
          "my_part_____rm_-rf-01234567.gcode");
    CHECK(upload_name("", "0123456789abcdef", ".sl1") == "part-01234567.sl1");
    CHECK(upload_name(std::string(100, 'a'), "0123456789abcdef", ".g").size() == 40 + 9 + 2);
}

}  // namespace send_upload_test
