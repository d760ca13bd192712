// Trilinear numbers worked out by hand, and ranges of volumes.
#include "procedural/volume/volume_grading.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>

#include "engine/base/error.h"
#include "tests/procedural/grading/grading_checks.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace volume_grading_test {

using namespace lamella;

namespace {

template <class T>
Volume volume_of(std::array<std::size_t, 3> size, std::vector<T> samples, double full_scale = 1) {
    Volume volume;
    volume.size = size;
    volume.samples = std::move(samples);
    volume.full_scale = full_scale;
    return volume;
}

template <class T>
Volume random_volume(std::array<std::size_t, 3> size, unsigned seed, double full_scale = 1) {
    std::mt19937 random(seed);
    std::vector<T> samples(size[0] * size[1] * size[2]);
    for (T& sample : samples) sample = static_cast<T>(random() % 251);
    return volume_of(size, samples, full_scale);
}

const Box box{{-3, 2, 10}, {7, 8, 40}};

}  // namespace

TEST_CASE("numbers between eight voxels are trilinear, and constant beyond the outermost centres") {
    // Centres at 0.5 and 1.5 along each axis; the sample is 1 x + 10 y + 100 z of the index.
    const GradingPtr grading = make_volume_grading(
        volume_of<std::int16_t>({2, 2, 2}, {0, 1, 10, 11, 100, 101, 110, 111}), {{0, 0, 0}, {2, 2, 2}});
    CHECK(grading->at({0.5, 0.5, 0.5}) == 0);
    CHECK(grading->at({1.5, 1.5, 1.5}) == 111);
    CHECK(grading->at({0.75, 1.0, 1.25}) == 0.25 + 5 + 75);
    CHECK(grading->at({1.0, 1.5, 0.5}) == 10.5);
    CHECK(grading->at({0, 0, 0}) == 0);
    CHECK(grading->at({-100, 1.0, 100}) == 105);
    // Not linear: a bump in one corner falls off as the product of the three ways.
    const GradingPtr bump =
        make_volume_grading(volume_of<float>({2, 2, 2}, {0, 0, 0, 0, 0, 0, 0, 8}), {{0, 0, 0}, {2, 2, 2}});
    CHECK(bump->at({1, 1, 1}) == 1);
    CHECK(bump->at({1.25, 1, 1.5}) == 8 * 0.75 * 0.5);
}

TEST_CASE("integer images give 0 to 1, one voxel is constant") {
    const GradingPtr bytes =
        make_volume_grading(volume_of<std::uint8_t>({1, 1, 3}, {0, 255, 51}, 255), {{0, 0, 0}, {1, 1, 3}});
    CHECK(bytes->at({0.3, 0.9, 0.5}) == 0);
    CHECK(bytes->at({0.3, 0.9, 1.5}) == 1);
    CHECK(bytes->at({0.3, 0.9, 2.5}) == 0.2);
    const GradingPtr words =
        make_volume_grading(volume_of<std::uint16_t>({1, 1, 1}, {13107}, 65535), {{0, 0, 0}, {1, 1, 1}});
    CHECK(words->at({9, 9, 9}) == 0.2);
    CHECK(words->range({{0, 0, 0}, {9, 9, 9}}).lo == 0.2);
    CHECK(words->range({{0, 0, 0}, {9, 9, 9}}).hi == 0.2);
}

TEST_CASE("numbers agree with an interpolation written down anew at random points") {
    const std::array<std::size_t, 3> size{7, 5, 6};
    const Volume volume = random_volume<std::uint32_t>(size, 3);
    const auto& samples = std::get<std::vector<std::uint32_t>>(volume.samples);
    const GradingPtr grading = make_volume_grading(volume, box);
    std::mt19937 random(4);
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p = checks::random_point(random, grown(box, 3));
        // The sum over all voxels of their hat functions, at the point kept between the outermost centres.
        double sum = 0;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const std::size_t index[3] = {k % size[0], k / size[0] % size[1], k / size[0] / size[1]};
            double hat = samples[k];
            for (int axis = 0; axis < 3; ++axis) {
                const auto n = static_cast<double>(size[static_cast<std::size_t>(axis)]);
                const double voxel = box.size()[axis] / n;
                const double kept =
                    std::min(std::max(p[axis], box.lo[axis] + voxel / 2), box.hi[axis] - voxel / 2);
                const double centre = box.lo[axis] + (static_cast<double>(index[axis]) + 0.5) * voxel;
                hat *= std::max(0.0, 1 - std::abs(kept - centre) / voxel);
            }
            sum += hat;
        }
        if (std::abs(grading->at(p) - sum) > 1e-10) FAIL("another number at point " << i);
    }
}

TEST_CASE("ranges of volumes enclose their numbers") {
    checks::check_ranges(*make_volume_grading(random_volume<std::uint8_t>({7, 5, 6}, 5, 255), box),
                         grown(box, 5));
    checks::check_ranges(*make_volume_grading(random_volume<float>({70, 33, 90}, 6), box), grown(box, 5));
    checks::check_ranges(*make_volume_grading(random_volume<double>({1, 40, 1}, 7), box), grown(box, 5));
    checks::check_ranges(*make_volume_grading(random_volume<std::int64_t>({9, 8, 17}, 8), box),
                         grown(box, 5));
}

TEST_CASE("the range over a few voxels is that of the numbers at the corners of what it cuts") {
    const GradingPtr grading =
        make_volume_grading(random_volume<std::uint8_t>({40, 40, 40}, 9), {dvec3(0), dvec3(40)});
    std::mt19937 random(10);
    for (int i = 0; i < 200; ++i) {
        const dvec3 lo = checks::random_point(random, {dvec3(-1), dvec3(38)});
        const Box small{lo, checks::random_point(random, {lo, lo + 3.0})};
        const Interval range = grading->range(small);
        Interval found;
        std::array<std::vector<double>, 3> stops;
        for (int axis = 0; axis < 3; ++axis) {
            auto& list = stops[static_cast<std::size_t>(axis)];
            list = {small.lo[axis], small.hi[axis]};
            for (double c = -0.5; c < 41; ++c) {
                if (small.lo[axis] < c && c < small.hi[axis]) list.push_back(c);
            }
        }
        for (const double x : stops[0]) {
            for (const double y : stops[1]) {
                for (const double z : stops[2]) {
                    const double number = grading->at({x, y, z});
                    found = {std::min(found.lo, number), std::max(found.hi, number)};
                }
            }
        }
        if (std::abs(range.lo - found.lo) > 1e-10 || std::abs(range.hi - found.hi) > 1e-10) FAIL("not tight");
    }
}

TEST_CASE("the range over everything is that of the samples") {
    Volume volume = random_volume<float>({130, 70, 50}, 11);
    auto& samples = std::get<std::vector<float>>(volume.samples);
    samples[130 * 70 * 20 + 130 * 3 + 77] = -1000;
    samples.back() = 9000;
    const GradingPtr grading = make_volume_grading(volume, box);
    CHECK(grading->range(grown(box, 1)).lo == -1000);
    CHECK(grading->range(grown(box, 1)).hi == 9000);
    const Interval tight = tight_range(*grading, box);
    CHECK(tight.lo == -1000);
    CHECK(tight.hi == 9000);
}

TEST_CASE("the range of a large box exceeds that of its samples by no more than half its length") {
    // Along x the sample is its index, so an enclosure of numbers is one of places.
    const std::size_t n = 512;
    std::vector<std::uint16_t> ramp(n * 3 * 2);
    for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<std::uint16_t>(i % n);
    const GradingPtr grading = make_volume_grading(volume_of({n, 3, 2}, ramp), {{0, 0, 0}, {512, 3, 2}});
    for (double length = 1; length < 400; length *= 1.3) {
        const double begin = 37.3;
        const Interval range = grading->range({{begin, 0, 0}, {begin + length, 3, 2}});
        CHECK(range.lo <= begin - 0.5);
        CHECK(range.hi >= begin + length - 0.5);
        CHECK(range.width() <= length * 1.5 + 2);
        if (length < 4) CHECK(range.width() == Approx(length));
        if (length < 30) CHECK(range.width() <= length + 2);
    }
}

TEST_CASE("what is not finite is NaN around it and counts as infinity in ranges") {
    std::vector<float> samples(27, 2.0F);
    samples[13] = std::numeric_limits<float>::quiet_NaN();
    samples[0] = std::numeric_limits<float>::infinity();
    const GradingPtr grading = make_volume_grading(volume_of({3, 3, 3}, samples), {dvec3(0), dvec3(3)});
    CHECK(std::isnan(grading->at({1.5, 1.5, 1.5})));
    CHECK(std::isnan(grading->at({1.9, 1.5, 1.5})));
    CHECK(grading->range({dvec3(1), dvec3(2)}).hi == infinity);
    CHECK(grading->range({dvec3(1), dvec3(2)}).lo == 2);
    checks::check_ranges(*grading, {dvec3(0), dvec3(3)});
    const GradingPtr nothing = make_volume_grading(
        volume_of<double>({1, 1, 1}, {std::numeric_limits<double>::quiet_NaN()}), {dvec3(0), dvec3(3)});
    CHECK(nothing->range({dvec3(0), dvec3(3)}).lo == infinity);
    CHECK(nothing->range({dvec3(0), dvec3(3)}).hi == infinity);
}

TEST_CASE("the largest numbers of a type neither overflow nor lose their sign") {
    const GradingPtr grading =
        make_volume_grading(volume_of<double>({2, 1, 1}, {-1.7e308, 1.7e308}), {dvec3(0), dvec3(2)});
    CHECK(grading->at({1, 1, 1}) == 0);
    CHECK(grading->at({0, 1, 1}) == -1.7e308);
    const GradingPtr whole =
        make_volume_grading(volume_of<std::int8_t>({2, 1, 1}, {-128, 127}), {dvec3(0), dvec3(2)});
    CHECK(whole->range({dvec3(0), dvec3(2)}).lo == -128);
    CHECK(whole->range({dvec3(0), dvec3(2)}).hi == 127);
}

TEST_CASE("a file's own box is taken unless another is stated, and missed where there is none") {
    const ScratchFolder folder("volume_box");
    const std::string path = (folder / "v.nrrd").string();
    const std::string start = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: ascii\n";
    std::ofstream(path) << start << "spacings: 2 2 2\n\n10 20\n";
    CHECK(make_volume_grading(VolumeSource{path})->at({2, 0, 0}) == 15);
    CHECK(make_volume_grading(VolumeSource{path, Box{{0, 0, 0}, {2, 1, 1}}})->at({1, 0, 0}) == 15);
    std::ofstream(path) << start << "\n10 20\n";
    const auto message = [&](const std::optional<Box>& stated) -> std::string {
        try {
            make_volume_grading(VolumeSource{path, stated});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message({}).find(path + ": the file does not say where the volume lies") == 0);
    CHECK(message(Box{{0, 0, 0}, {2, 0, 1}}).find(path + ": the box of a volume must have three") == 0);
    CHECK(message(Box{{0, 0, 0}, {2, infinity, 1}}).find(path + ": the box of a volume must have three") ==
          0);
    CHECK(message(Box{{0, 0, 0}, {2, 1, 1}}).empty());
    CHECK_THROWS_AS(make_volume_grading(volume_of<float>({2, 2, 2}, {1, 2}), box), InputError);
}

}  // namespace volume_grading_test
