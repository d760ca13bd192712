// The repair steps that make a mesh a closed chain, and the notes about them.
#include "engine/mesh/mesh_repair.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/mesh/mesh_duplicates.h"
#include "engine/mesh/mesh_edges.h"
#include "engine/mesh/mesh_holes.h"
#include "engine/mesh/mesh_orient.h"
#include "engine/mesh/mesh_weld.h"

namespace lamella {

namespace {

/// Smaller shares of the bounding box's diagonal (and its cube) cannot be printed.
constexpr double min_volume = 1e-12;
constexpr double min_sheet_thickness = 1e-5;

double diagonal_of(const TriangleMesh& mesh) {
    const dvec3 size = mesh.bounds().size();
    return std::sqrt(glm::dot(size, size));
}

std::string in_mm(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g mm", length);
    return text;
}

std::string were(std::size_t n) { return n == 1 ? " was" : " were"; }

class Repair {
  public:
    Repair(TriangleMesh mesh, std::string_view name) : name_(name), given_(mesh.triangles.size()) {
        out_.mesh = std::move(mesh);
    }

    SolidMesh run() {
        drop_invalid();
        const MeshEdges edges(triangles(), vertex_count());
        was_soup_ = edges.edges().size() == 3 * triangles().size();
        TriangleMesh& mesh = out_.mesh;
        out_.oriented_manifold = edges.is_oriented_manifold();
        if (out_.oriented_manifold) {
            finish(body_volumes(mesh, edges), TriangleMesh());
        } else {
            const TriangleMesh original = mesh;
            note_duplicates(drop_duplicates(mesh, BackToBack::cancel));
            mend();
            finish(body_volumes(mesh, MeshEdges(triangles(), vertex_count())), original);
        }
        return std::move(out_);
    }

  private:
    Triangles& triangles() { return out_.mesh.triangles; }
    std::size_t vertex_count() const { return out_.mesh.vertices.size(); }
    void say(std::string note) { out_.notes.push_back(std::move(note)); }

    void drop_invalid() {
        const auto usable = [&](std::uint32_t v) {
            const auto fine = [](double x) { return std::abs(x) <= max_coordinate; };
            if (v >= vertex_count()) return false;
            const dvec3& p = out_.mesh.vertices[v];
            return fine(p.x) && fine(p.y) && fine(p.z);
        };
        const std::size_t dropped = std::erase_if(triangles(), [&](const auto& t) {
            return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || !usable(t[0]) || !usable(t[1]) ||
                   !usable(t[2]);
        });
        if (dropped > 0)
            say(counted(dropped, "triangle") + " without three usable corners" + were(dropped) + " left out");
    }

    void note_duplicates(const DroppedDuplicates& dropped) {
        if (dropped.copies > 0) {
            say(counted(dropped.copies, "triangle") + were(dropped.copies) +
                " there more than once; one of each was kept");
        }
        if (dropped.cancelled > 0) {
            say(counted(dropped.cancelled, "triangle") +
                " lay back to back in pairs, enclosing nothing, and" + were(dropped.cancelled) + " left out");
        }
    }

    /// Makes the mesh a closed chain.
    void mend() {
        TriangleMesh& mesh = out_.mesh;
        const BorderWeld weld = weld_borders(mesh);
        if (weld.joined > 0) {
            say(counted(weld.joined, "corner") + " along open seams" + were(weld.joined) +
                " joined to a neighbour (at most " + in_mm(weld.farthest) + " away)");
            note_duplicates(drop_duplicates(mesh, BackToBack::cancel));
        }
        if (const std::size_t turned = agree_on_sides(mesh); turned > 0) {
            say(counted(turned, "triangle") + " faced the other way than " + (turned == 1 ? "its" : "their") +
                " neighbours and" + were(turned) + " turned");
            note_duplicates(drop_duplicates(mesh, BackToBack::cancel));
        }
        out_.caps = cap_holes(mesh);
        const CancelledCaps cancelled = cancel_caps(mesh, out_.caps);
        out_.caps -= cancelled.caps;
        if (cancelled.others > 0) {
            say(counted(cancelled.others, "loose triangle") + were(cancelled.others) + " left out");
        }
    }

    void finish(BodyVolumes bodies, const TriangleMesh& original) {
        TriangleMesh& mesh = out_.mesh;
        drop_sheets(bodies);
        if (triangles().empty() && !original.triangles.empty()) {
            // Some modellers list every face twice, once for each side: then everything has cancelled.
            mesh = original;
            const DroppedDuplicates dropped = drop_duplicates(mesh, BackToBack::keep_one);
            if (dropped.cancelled * 4 >= original.triangles.size()) {
                out_.notes.clear();
                say("the surface is there twice, once facing each way; one copy was kept");
                mend();
                bodies = body_volumes(mesh, MeshEdges(triangles(), vertex_count()));
                drop_sheets(bodies);
            } else {
                triangles().clear();
            }
        }
        if (triangles().empty()) refuse();
        note_caps();
        if (const std::size_t turned = turn_bodies_outwards(mesh, bodies); turned > 0) {
            say((bodies.volume.size() == 1 ? std::string("the whole surface was")
                                           : counted(turned, "closed surface") + were(turned)) +
                " inside out and" + were(turned) + " turned");
        }
        double volume = 0.0;
        for (const double v : bodies.volume) volume += v;
        const double diagonal = diagonal_of(mesh);
        if (triangles().size() < 4 || !(volume > min_volume * diagonal * diagonal * diagonal)) refuse();
        drop_unused_vertices(mesh);
        // A manifold stays one: only whole bodies have been flipped or removed.
        out_.oriented_manifold =
            out_.caps == 0 &&
            (out_.oriented_manifold || MeshEdges(triangles(), vertex_count()).is_oriented_manifold());
    }

    void note_caps() {
        if (out_.caps == 0) return;
        const Holes holes = holes_under(out_.mesh, out_.caps);
        const std::string how = " closed, with " + counted(out_.caps, "triangle") + " in all";
        std::string what = counted(holes.wide, "hole");
        if (holes.wide == 0) what = counted(holes.hairlines, "hairline gap");
        if (holes.wide > 0 && holes.hairlines > 0) what += " and " + counted(holes.hairlines, "hairline gap");
        say(what + were(holes.wide + holes.hairlines) + how);
    }

    /// Removes flat bodies: open sheets that are capped by their own backs.
    void drop_sheets(BodyVolumes& bodies) {
        const double diagonal = diagonal_of(out_.mesh);
        const std::size_t first_cap = triangles().size() - out_.caps;
        std::vector<double> cap_area(bodies.volume.size(), 0.0);
        for (std::size_t t = first_cap; t < triangles().size(); ++t) {
            const dvec3 a = out_.mesh.vertices[triangles()[t][0]];
            const dvec3 normal = glm::cross(out_.mesh.vertices[triangles()[t][1]] - a,
                                            out_.mesh.vertices[triangles()[t][2]] - a);
            cap_area[bodies.body[t]] += 0.5 * std::sqrt(glm::dot(normal, normal));
        }
        std::vector<bool> is_sheet(bodies.volume.size(), false);
        std::size_t sheets = 0;
        for (std::size_t b = 0; b < is_sheet.size(); ++b) {
            // Two triangles that only close each other are a pair back to back.
            const bool flat = std::abs(bodies.volume[b]) <= min_sheet_thickness * diagonal * bodies.area[b];
            const bool mostly_caps = 4.0 * cap_area[b] >= bodies.area[b];
            const bool nothing = std::abs(bodies.volume[b]) <= 1e-15 * diagonal * bodies.area[b];
            is_sheet[b] = (flat && mostly_caps) || nothing;
            sheets += is_sheet[b] ? 1 : 0;
        }
        if (sheets == 0) return;
        say(counted(sheets, "flat sheet") + " without thickness" + were(sheets) + " left out");
        std::size_t kept = 0;
        std::size_t kept_caps = 0;
        for (std::size_t t = 0; t < triangles().size(); ++t) {
            if (is_sheet[bodies.body[t]]) continue;
            kept_caps += t >= first_cap ? 1 : 0;
            triangles()[kept] = triangles()[t];
            ++kept;
        }
        triangles().resize(kept);
        out_.caps = kept_caps;
        bodies = body_volumes(out_.mesh, MeshEdges(triangles(), vertex_count()));
    }

    [[noreturn]] void refuse() const {
        std::string why =
            given_ == 1 ? "the one triangle encloses" : "the " + counted(given_, "triangle") + " enclose";
        why += " no volume";
        if (given_ == 0) why = "there are no triangles";
        if (given_ > 1 && was_soup_) why += " (they share no edges)";
        throw InputError(std::string(name_) + ": " + why + ", so there is nothing to print");
    }

    std::string_view name_;
    std::size_t given_;
    bool was_soup_ = false;
    SolidMesh out_;
};

}  // namespace

SolidMesh close_mesh(TriangleMesh mesh, std::string_view name) { return Repair(std::move(mesh), name).run(); }

}  // namespace lamella
