// The ten digits on a grid 0.6 wide and 1 high.
#include "printers/vector/stroke_digits.h"

#include <array>
#include <string>

namespace lamella {
namespace {

constexpr double digit_width = 0.6;  // in heights
constexpr double advance = 0.85;     // distance between digits, in heights

using DigitStrokes = std::vector<std::vector<dvec2>>;

DigitStrokes six() {
    return {{{0.5, 1},
             {0.2, 0.85},
             {0, 0.5},
             {0, 0.2},
             {0.18, 0},
             {0.42, 0},
             {0.6, 0.2},
             {0.6, 0.38},
             {0.42, 0.58},
             {0.18, 0.58},
             {0, 0.42}}};
}

DigitStrokes turned(DigitStrokes strokes) {
    for (auto& stroke : strokes) {
        for (dvec2& p : stroke) p = dvec2(digit_width, 1) - p;
    }
    return strokes;
}

const std::array<DigitStrokes, 10>& digits() {
    static const std::array<DigitStrokes, 10> all{
        DigitStrokes{
            {{0.2, 0}, {0.4, 0}, {0.6, 0.2}, {0.6, 0.8}, {0.4, 1}, {0.2, 1}, {0, 0.8}, {0, 0.2}, {0.2, 0}}},
        DigitStrokes{{{0.1, 0.75}, {0.3, 1}, {0.3, 0}}},
        DigitStrokes{{{0, 0.8}, {0.2, 1}, {0.4, 1}, {0.6, 0.8}, {0.6, 0.65}, {0, 0}, {0.6, 0}}},
        DigitStrokes{{{0, 0.85}, {0.15, 1}, {0.45, 1}, {0.6, 0.85}, {0.6, 0.68}, {0.42, 0.52}, {0.25, 0.52}},
                     {{0.42, 0.52}, {0.6, 0.35}, {0.6, 0.15}, {0.45, 0}, {0.15, 0}, {0, 0.15}}},
        DigitStrokes{{{0.45, 0}, {0.45, 1}, {0, 0.3}, {0.6, 0.3}}},
        DigitStrokes{{{0.55, 1},
                      {0.05, 1},
                      {0, 0.55},
                      {0.4, 0.6},
                      {0.6, 0.42},
                      {0.6, 0.18},
                      {0.42, 0},
                      {0.15, 0},
                      {0, 0.12}}},
        six(),
        DigitStrokes{{{0, 1}, {0.6, 1}, {0.2, 0}}},
        DigitStrokes{{{0.18, 0.54},
                      {0.02, 0.7},
                      {0.02, 0.84},
                      {0.18, 1},
                      {0.42, 1},
                      {0.58, 0.84},
                      {0.58, 0.7},
                      {0.42, 0.54},
                      {0.18, 0.54}},
                     {{0.18, 0.54},
                      {0, 0.36},
                      {0, 0.16},
                      {0.18, 0},
                      {0.42, 0},
                      {0.6, 0.16},
                      {0.6, 0.36},
                      {0.42, 0.54}}},
        turned(six())};
    return all;
}

}  // namespace

dvec2 number_size(int number, double height) {
    const auto count = static_cast<double>(std::to_string(number).size());
    return {((count - 1) * advance + digit_width) * height, height};
}

std::vector<std::vector<dvec2>> number_strokes(int number, dvec2 center, double height) {
    dvec2 corner = center - number_size(number, height) * 0.5;
    std::vector<std::vector<dvec2>> strokes;
    for (const char c : std::to_string(number)) {
        for (std::vector<dvec2> stroke : digits()[static_cast<std::size_t>(c - '0')]) {
            for (dvec2& p : stroke) p = corner + p * height;
            strokes.push_back(std::move(stroke));
        }
        corner.x += advance * height;
    }
    return strokes;
}

}  // namespace lamella
