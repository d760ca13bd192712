// Files that change between builds: what is kept is that of the file as it is now.
#include "recipe/inputs/input_cache.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "recipe/identity.h"
#include "tests/app/commands/folder.h"

namespace lamella {
namespace {

void write_tetrahedron(const std::string& path, double size) {
    std::ofstream out(path, std::ios::binary);
    out << "v 0 0 0\nv " << size << " 0 0\nv 0 " << size << " 0\nv 0 0 " << size
        << "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

TEST_CASE("a file that has changed is read again, and no other", "[inputs]") {
    const Folder folder;
    const std::string path = folder / "part.obj";
    write_tetrahedron(path, 6);
    InputCache cache;
    const SolidSource source{path};
    const InputCache::Solid first = cache.solid(source);
    CHECK(first.report.volume == Approx(36));
    CHECK(cache.solid(source).field == first.field);
    CHECK(cache.hash(path) == hash_file(path));

    write_tetrahedron(path, 12.5);  // another size of the file, too
    const InputCache::Solid second = cache.solid(source);
    CHECK(second.report.volume == Approx(12.5 * 12.5 * 12.5 / 6));
    CHECK(second.field->bounds().hi.x == Approx(12.5));
    CHECK(cache.hash(path) == hash_file(path));

    write_tetrahedron(path, 13.5);  // the same size, later
    std::filesystem::last_write_time(path,
                                     std::filesystem::last_write_time(path) + std::chrono::milliseconds(1));
    CHECK(cache.solid(source).report.volume == Approx(13.5 * 13.5 * 13.5 / 6));
    CHECK(cache.hash(path) == hash_file(path));
    std::filesystem::remove(path);
    CHECK_THROWS_AS(cache.solid(source), InputError);
    CHECK_THROWS_AS(cache.hash(path), InputError);
}

TEST_CASE("each placement of a file is a solid of its own, and few are kept", "[inputs]") {
    const Folder folder;
    const std::string path = folder / "part.obj";
    write_tetrahedron(path, 6);
    InputCache cache(2);
    const FieldPtr plain = cache.solid({path}).field;
    SolidSource moved{path};
    moved.place.at = {100, 0, 0};
    CHECK(cache.solid(moved).field->bounds().lo.x == Approx(100));
    SolidSource scaled{path};
    scaled.scale = 2;
    CHECK(cache.solid(scaled).report.volume == Approx(8 * 36));
    CHECK(cache.solid({path}).field != plain);  // the oldest had to go
}

}  // namespace
}  // namespace lamella
