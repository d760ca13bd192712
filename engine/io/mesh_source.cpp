// Numbers in text, messages, and the welding of equal corners, for the mesh readers.
#include "engine/io/mesh_source.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/mesh/triangulate.h"

namespace lamella {

namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

std::uint64_t mixed(std::uint64_t h) {
    h ^= h >> 31;
    h *= 0x9e3779b97f4a7c15U;
    return h ^ (h >> 29);
}

std::size_t hash_of(dvec3 p) {
    std::uint64_t h = mixed(std::bit_cast<std::uint64_t>(p.x));
    h = mixed(h + std::bit_cast<std::uint64_t>(p.y));
    h = mixed(h + std::bit_cast<std::uint64_t>(p.z));
    return static_cast<std::size_t>(h ^ (h >> 32));
}

bool usable(double v) { return std::abs(v) <= max_coordinate; }

}  // namespace

MeshSource mesh_source(std::string_view name, std::span<const std::byte> bytes, double unit_mm) {
    if (!(unit_mm > 0.0 && unit_mm <= 1e6)) {
        throw InputError(std::string(name) + ": a unit must be more than 0 and at most 1,000,000 mm, not " +
                         std::to_string(unit_mm));
    }
    return {std::string(name), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, unit_mm};
}

void reject(const MeshSource& source, const std::string& what) {
    throw InputError(source.name + ": " + what);
}

std::string_view TextCursor::token() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
}

std::string_view TextCursor::token_on_line() {
    while (at_ < text_.size() && is_space(text_[at_]) && !is_line_end(text_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
}

void TextCursor::skip_line() {
    while (at_ < text_.size() && !is_line_end(text_[at_])) ++at_;
    if (at_ + 1 < text_.size() && text_[at_] == '\r' && text_[at_ + 1] == '\n') ++at_;
    if (at_ < text_.size()) ++at_;
}

std::size_t TextCursor::line_at(std::size_t offset) const {
    std::size_t line = 1;
    for (std::size_t i = 0; i < std::min(offset, text_.size()); ++i) {
        if (text_[i] == '\n' || (text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n'))) ++line;
    }
    return line;
}

MeshWelder::MeshWelder(std::size_t expected_vertices) {
    mesh_.vertices.reserve(expected_vertices);
    slots_.assign(std::bit_ceil(std::max<std::size_t>(64, expected_vertices * 2)), unusable);
}

std::uint32_t MeshWelder::vertex(dvec3 p) {
    if (!(usable(p.x) && usable(p.y) && usable(p.z))) return unusable;
    p += 0.0;  // minus zero becomes zero, so that equal numbers have equal bits
    if (mesh_.vertices.size() * 2 >= slots_.size()) grow();
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash_of(p) & mask;
    for (; slots_[slot] != unusable; slot = (slot + 1) & mask) {
        if (mesh_.vertices[slots_[slot]] == p) return slots_[slot];
    }
    slots_[slot] = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back(p);
    return slots_[slot];
}

void MeshWelder::grow() {
    slots_.assign(slots_.size() * 2, unusable);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
        std::size_t slot = hash_of(mesh_.vertices[i]) & mask;
        while (slots_[slot] != unusable) slot = (slot + 1) & mask;
        slots_[slot] = static_cast<std::uint32_t>(i);
    }
}

void MeshWelder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    ++offered_;
    if (a == unusable || b == unusable || c == unusable) {
        ++not_finite_;
    } else if (a == b || b == c || c == a) {
        ++degenerate_;
    } else {
        mesh_.triangles.push_back({a, b, c});
    }
}

MeshFile MeshWelder::finish(const MeshSource& source, std::vector<std::string> notes) {
    const std::string of = " of " + counted(offered_, "triangle");
    if (mesh_.triangles.empty()) {
        std::string why = "it holds no triangles";
        if (not_finite_ > 0 && degenerate_ == 0)
            why = "every corner position is NaN, infinite or absurdly large";
        if (not_finite_ == 0 && degenerate_ > 0)
            why = "every triangle is degenerate (two of its corners coincide)";
        if (not_finite_ > 0 && degenerate_ > 0) {
            why = "every triangle has coinciding corners or corners that are NaN or infinite";
        }
        if (offered_ > 0) why = "none" + of + " can be used: " + why;
        for (const std::string& note : notes) why += "; " + note;
        reject(source, why + ", so there is nothing to print");
    }
    if (not_finite_ > 0) {
        notes.push_back(grouped(not_finite_) + of + " had NaN, infinite or absurdly large corners and " +
                        (not_finite_ == 1 ? "was" : "were") + " left out");
    }
    if (degenerate_ > 0) {
        notes.push_back(grouped(degenerate_) + of + (degenerate_ == 1 ? " was" : " were") +
                        " degenerate (two corners at one place) and " + (degenerate_ == 1 ? "was" : "were") +
                        " left out");
    }
    return {std::move(mesh_), std::move(notes)};
}

PolygonWelder::PolygonWelder(std::vector<dvec3> vertices)
    : vertices_(std::move(vertices)), welder_(vertices_.size()) {
    welded_.reserve(vertices_.size());
    for (const dvec3& p : vertices_) welded_.push_back(welder_.vertex(p));
}

void PolygonWelder::polygon(std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) {
        welder_.triangle(welded_[corners[0]], welded_[corners[1]], welded_[corners[2]]);
        return;
    }
    ring_.clear();
    points_.clear();
    for (const std::uint32_t corner : corners) {
        const std::uint32_t vertex = welded_[corner];
        if (!ring_.empty() && ring_.back() == vertex && vertex != MeshWelder::unusable) continue;
        ring_.push_back(vertex);
        // Triangles at an unusable corner are skipped below, whatever the cut.
        points_.push_back(vertex == MeshWelder::unusable ? dvec3(0.0) : vertices_[corner]);
    }
    while (ring_.size() > 3 && ring_.front() == ring_.back()) {
        ring_.pop_back();
        points_.pop_back();
    }
    if (ring_.size() < 3) ring_.resize(3, ring_.front());
    cut_.clear();
    points_.resize(ring_.size(), points_.front());
    triangulate_loop(points_, cut_);
    for (const auto& [a, b, c] : cut_) welder_.triangle(ring_[a], ring_[b], ring_[c]);
}

}  // namespace lamella
