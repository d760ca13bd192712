// Embedding Lamella: a ball of foam with a skin, asked layer by layer for its contours.
#include <lamella/engine/layers/layer.h>
#include <lamella/engine/solids/csg.h>
#include <lamella/engine/solids/primitives.h>
#include <lamella/engine/solids/shell.h>
#include <lamella/procedural/foam/voronoi_foam.h>

#include <cstdio>

int main() {
    using namespace lamella;
    const FieldPtr body = make_sphere({0, 0, 0}, 10);
    FoamSettings settings;
    settings.cell = 3;
    settings.beam_radius = 0.4;
    settings.region = body->bounds();
    const FieldPtr foam = make_voronoi_foam(settings);

    Job job;
    job.part = make_intersection({body, make_union({foam, make_shell(body, 0.8)})});
    job.bounds = body->bounds();
    job.layers = equal_layers(job.bounds.size().z, 2);

    for (int i = 0; i < job.layers.count(); ++i) {
        const Layer layer(job, i);
        double area = 0;
        const auto contours = layer.contours(0.05);
        for (const Contour& contour : contours) area += signed_area(contour.points);
        std::printf("layer %d at z %.1f mm: %zu contours, %.2f mm^2\n", i, layer.z(), contours.size(), area);
    }
}
