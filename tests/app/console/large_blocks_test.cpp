// Blocks checked against what a plain list of them says: apart, keeping their bytes, holes joined.
#include "app/console/large_blocks.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

namespace large_blocks_test {

namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

struct Block {
    unsigned char* start;
    std::size_t bytes;
    unsigned char mark;
    bool holds_mark() const {
        for (std::size_t i = 0; i < bytes; ++i) {
            if (start[i] != mark) return false;
        }
        return true;
    }
};

Block take(lamella::LargeBlocks& blocks, std::size_t bytes, unsigned char mark) {
    const Block block{static_cast<unsigned char*>(blocks.allocate(bytes)), bytes, mark};
    REQUIRE(block.start != nullptr);
    std::memset(block.start, mark, bytes);
    return block;
}

}  // namespace

TEST_CASE("Large blocks taken and freed at random keep their bytes") {
    lamella::LargeBlocks blocks(256 * mebibyte);
    std::mt19937 random(7);
    std::vector<Block> held;
    std::size_t max_held = 0;
    std::size_t now_held = 0;
    for (int step = 0; step < 20000; ++step) {
        if (held.size() < 40 && random() % 2 == 0) {
            held.push_back(take(blocks, 1 + random() % 60000, static_cast<unsigned char>(step)));
            CHECK(blocks.owns(held.back().start));
            CHECK(blocks.owns(held.back().start + held.back().bytes - 1));
            now_held += held.back().bytes;
        } else if (!held.empty()) {
            std::swap(held[random() % held.size()], held.back());
            REQUIRE(held.back().holds_mark());
            now_held -= held.back().bytes;
            blocks.free(held.back().start);
            held.pop_back();
        }
        max_held = std::max(max_held, now_held);
    }
    // Best fit wastes something, and whole pages are taken; it must not grow with the number of requests.
    CHECK(blocks.reach() < 2 * max_held);
    for (const Block& block : held) blocks.free(block.start);
    // With nothing held all is one hole, which takes a block of its size without growing.
    const std::size_t reach = blocks.reach();
    CHECK(blocks.allocate(reach) != nullptr);
    CHECK(blocks.reach() == reach);
}

TEST_CASE("The memory of a great hole among large blocks is given back") {
    lamella::LargeBlocks blocks(512 * mebibyte);
    const Block before = take(blocks, mebibyte, 1);
    const Block mesh = take(blocks, 200 * mebibyte, 2);
    const Block after = take(blocks, mebibyte, 3);
    blocks.free(mesh.start);
    // Memory that was given back reads as zeros when it is taken again.
    const Block again{static_cast<unsigned char*>(blocks.allocate(200 * mebibyte)), 200 * mebibyte, 0};
    CHECK(again.start == mesh.start);
    CHECK(again.holds_mark());
    CHECK(before.holds_mark());
    CHECK(after.holds_mark());
    CHECK(blocks.reach() == 202 * mebibyte);
}

TEST_CASE("Large blocks end where their room does") {
    lamella::LargeBlocks blocks(4 * mebibyte);
    void* first = blocks.allocate(3 * mebibyte);
    REQUIRE(first != nullptr);
    CHECK(blocks.allocate(2 * mebibyte) == nullptr);
    CHECK(blocks.allocate(~std::size_t{0}) == nullptr);
    int elsewhere = 0;
    CHECK_FALSE(blocks.owns(&elsewhere));
    CHECK_FALSE(blocks.owns(nullptr));
    blocks.free(first);
    CHECK(blocks.allocate(4 * mebibyte) == first);
}

TEST_CASE("Addresses that cannot be had leave no large blocks, and say so") {
    lamella::LargeBlocks blocks(~std::size_t{0} / 2);
    CHECK(blocks.allocate(mebibyte) == nullptr);
    CHECK_FALSE(blocks.owns(nullptr));
}

TEST_CASE("Large blocks serve several threads at once") {
    lamella::LargeBlocks blocks(256 * mebibyte);
    std::vector<int> wrong(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&blocks, &wrong, t] {
            std::mt19937 random(static_cast<unsigned>(t));
            for (int step = 0; step < 3000; ++step) {
                const std::size_t bytes = 1 + random() % 50000;
                auto* start = static_cast<unsigned char*>(blocks.allocate(bytes));
                const Block block{start, bytes, static_cast<unsigned char>(t)};
                std::memset(block.start, block.mark, bytes);
                std::this_thread::yield();
                if (!block.holds_mark()) ++wrong[t];
                blocks.free(block.start);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == std::vector<int>(4, 0));
}

}  // namespace large_blocks_test
