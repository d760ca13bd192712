// Percent and time left: of what is not answered yet, whatever was waited for.
#include "printers/serial/print_progress.h"

#include <catch2/catch.hpp>

namespace print_progress_test {

using namespace lamella;

namespace {

/// Ten layers of 100 s, and 20 s before them; four are known.
PrintProgress ten_layers() {
    PrintProgress progress;
    progress.layers = 10;
    progress.layers_known = 4;
    progress.layers_seconds = 400;
    progress.known_seconds = 420;
    return progress;
}

}  // namespace

TEST_CASE("time left is that of the lines not answered and of the layers not computed") {
    PrintProgress progress = ten_layers();
    REQUIRE(progress.left());
    CHECK(*progress.left() == Approx(1020));
    CHECK(*progress.share() == 0);
    progress.done_seconds = progress.printing = 220;
    CHECK(*progress.left() == Approx(800));
    CHECK(*progress.share() == Approx(220.0 / 1020));
    progress.layers_known = 10;
    progress.layers_seconds = 1000;
    progress.known_seconds = 1025;  // with what comes behind the last layer
    progress.done_seconds = progress.printing = 1025;
    CHECK(*progress.left() == 0);
    CHECK(*progress.share() == 1);
}

TEST_CASE("time that was heated or paused is none that was printed") {
    PrintProgress progress = ten_layers();
    // Nothing but motion is passed to it: 20 minutes of heating before the first line leave it as it is.
    progress.printing = 0;
    CHECK(*progress.left() == Approx(1020));
}

TEST_CASE("layers of an earlier run are printed but none of them was printed now") {
    PrintProgress progress = ten_layers();
    progress.layers_before = 6;
    CHECK(*progress.left() == Approx(420));
    CHECK(*progress.share() == Approx(600.0 / 1020));
    progress.done_seconds = progress.printing = 220;
    CHECK(*progress.left() == Approx(200));
}

TEST_CASE("a ready file tells its times beforehand") {
    PrintProgress progress;
    progress.layers = 50;
    progress.seconds_before = 300;
    progress.seconds_ahead = 700;
    CHECK(*progress.left() == 700);
    CHECK(*progress.share() == Approx(0.3));
    progress.done_seconds = progress.printing = 350;
    CHECK(*progress.left() == Approx(350));
    CHECK(*progress.share() == Approx(0.65));
}

TEST_CASE("a machine that is slower than the model is believed, the more the longer it is watched") {
    PrintProgress progress;
    progress.seconds_before = 0;
    progress.seconds_ahead = 7200;
    progress.done_seconds = 3600;
    progress.printing = 7200;  // half the speed
    CHECK(*progress.left() > 3600 * 1.9);
    CHECK(*progress.left() < 3600 * 2);
    progress.done_seconds = 2;
    progress.printing = 20;  // the first lines fill the planner, or empty it
    CHECK(*progress.left() < 7200 * 1.2);
}

TEST_CASE("before a layer is known nothing is told") {
    PrintProgress progress;
    progress.layers = 10;
    progress.known_seconds = 20;
    CHECK(!progress.left());
    CHECK(!progress.share());
}

}  // namespace print_progress_test
