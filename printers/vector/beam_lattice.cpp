// Rounds ends to nodes, writes XML in pieces, and builds the package of three parts.
#include "printers/vector/beam_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/package_3mf.h"
#include "printers/archive/zip_writer.h"

namespace lamella {
namespace {

constexpr int lattice_decimals = 5;
constexpr double units_per_mm = 1e5;
constexpr double shortest = 1 / units_per_mm;  // mm; distinct nodes are at least this far apart
constexpr double farthest = 1e6;               // mm
constexpr std::size_t max_beams = (std::size_t{1} << 31U) - 1;

/// A point in units of 1e-5 mm.
using Node = std::array<std::int64_t, 3>;

/// Rounds halves away from zero, as numbers are written.
std::int64_t rounded(double mm) { return std::llround(mm * units_per_mm); }
Node node_at(dvec3 p) { return {rounded(p.x), rounded(p.y), rounded(p.z)}; }

struct NodeHash {
    std::size_t operator()(const Node& node) const {
        std::uint64_t hash = 0;
        for (const std::int64_t v : node) {
            hash = (hash ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 32U;
        }
        return static_cast<std::size_t>(hash);
    }
};

void check(std::span<const Beam> beams) {
    if (beams.empty()) throw InputError("a beam lattice needs beams, and there are none");
    if (beams.size() > max_beams) throw InputError("a beam lattice holds at most 2^31 - 1 beams");
    for (std::size_t i = 0; i < beams.size(); ++i) {
        const Beam& beam = beams[i];
        bool good = beam.ra > 0 && beam.rb > 0 && beam.ra <= farthest && beam.rb <= farthest;
        for (int k = 0; k < 3; ++k)
            good = good && std::abs(beam.a[k]) <= farthest && std::abs(beam.b[k]) <= farthest;
        if (!good)
            throw InputError(
                "beam " + std::to_string(i) +
                " cannot be written: its ends must lie within 1e6 mm of the origin and its radii "
                "between 0 and 1e6 mm");
    }
}

/// Buffers text and passes it to the archive in pieces.
class Piecewise {
  public:
    explicit Piecewise(ZipWriter& zip) : zip_(zip) {}
    Piecewise& operator<<(std::string_view text) {
        text_ += text;
        if (text_.size() >= piece) flush();
        return *this;
    }
    Piecewise& number(double value) {
        append_number(text_, value, lattice_decimals);
        return *this;
    }
    void flush() {
        zip_.write(text_);
        text_.clear();
    }

  private:
    static constexpr std::size_t piece = 1 << 16;
    ZipWriter& zip_;
    std::string text_;
};

double radius_of(double r) { return std::max(r, shortest); }

class LatticeWriter {
  public:
    LatticeWriter(std::span<const Beam> beams, ZipWriter& zip) : beams_(beams), out_(zip) {}

    BeamLatticeReport write(const std::string& name) {
        out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                "<model unit=\"millimeter\" xml:lang=\"en-US\" "
                "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
                "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
                "requiredextensions=\"b\">\n"
                "<metadata name=\"Application\">Lamella</metadata>\n"
                "<resources>\n<object id=\"1\" type=\"model\" name=\""
             << xml_attribute(name) << "\">\n<mesh>\n<vertices>\n";
        write_nodes();
        out_ << "</vertices>\n";
        write_beams();
        out_ << "</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>\n";
        out_.flush();
        return report_;
    }

  private:
    /// Nodes are numbered in the order in which beams mention them. Beams of zero length are skipped.
    void write_nodes() {
        for (const Beam& beam : beams_) {
            const Node a = node_at(beam.a), b = node_at(beam.b);
            if (a == b) {
                ++report_.dropped;
                continue;
            }
            write_node(a);
            write_node(b);
            ++report_.beams;
        }
        if (report_.beams == 0)
            throw InputError("a beam lattice needs a beam of some length, and there is none");
        report_.vertices = numbers_.size();
    }

    void write_node(const Node& node) {
        if (!numbers_.emplace(node, numbers_.size()).second) return;
        (out_ << "<vertex x=\"").number(static_cast<double>(node[0]) / units_per_mm) << "\" y=\"";
        out_.number(static_cast<double>(node[1]) / units_per_mm) << "\" z=\"";
        out_.number(static_cast<double>(node[2]) / units_per_mm) << "\"/>\n";
    }

    /// The lattice's radius, the default of beams that state none, is that of the first beam.
    void write_beams() {
        std::int64_t common = 0;
        for (const Beam& beam : beams_) {
            if (node_at(beam.a) == node_at(beam.b)) continue;
            const std::int64_t r1 = rounded(radius_of(beam.ra)), r2 = rounded(radius_of(beam.rb));
            if (common == 0) {
                common = r1;
                (out_ << "<b:beamlattice minlength=\"").number(shortest) << "\" radius=\"";
                out_.number(static_cast<double>(common) / units_per_mm) << "\" cap=\"sphere\">\n<b:beams>\n";
            }
            out_ << "<b:beam v1=\"" << std::to_string(numbers_.at(node_at(beam.a))) << "\" v2=\""
                 << std::to_string(numbers_.at(node_at(beam.b)));
            if (r1 != common || r2 != common)
                (out_ << "\" r1=\"").number(static_cast<double>(r1) / units_per_mm);
            if (r2 != r1) (out_ << "\" r2=\"").number(static_cast<double>(r2) / units_per_mm);
            out_ << "\"/>\n";
        }
        out_ << "</b:beams>\n</b:beamlattice>\n";
    }

    std::span<const Beam> beams_;
    Piecewise out_;
    std::unordered_map<Node, std::size_t, NodeHash> numbers_;
    BeamLatticeReport report_;
};

}  // namespace

BeamLatticeReport write_beam_lattice(const std::filesystem::path& path, std::span<const Beam> beams,
                                     const std::string& name) {
    check(beams);
    ZipWriter zip(path);
    begin_model(zip);
    const BeamLatticeReport report = LatticeWriter(beams, zip).write(name);
    zip.finish();
    return report;
}

}  // namespace lamella
