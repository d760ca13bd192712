// The back-end for Slic3r's SVG dialect.
#include "printers/vector/slic3r_svg.h"

#include <fmt/format.h>

#include "engine/base/number_format.h"
#include "printers/archive/unfinished_file.h"
#include "printers/polygons/polygons.h"
#include "printers/vector/svg_text.h"

namespace lamella {
namespace {

struct Slic3rProduct : LayerProduct {
    void serialize(Archive& parcel) override { parcel(polygons); }

    std::string polygons;
};

class Slic3rSvg : public Backend {
  public:
    Slic3rSvg(const PrinterProfile& profile, const std::string& path, bool force)
        : vector_(profile.vector), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check_page(vector_);
        z0_ = job.z0();
        page_ = grown(job.bounds.rect(), vector_.margin);
        const std::string settings =
            fmt::format("slic3r-svg tolerance={} margin={}", vector_.tolerance, vector_.margin);
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (output_.resumed()) return next;
        output_.commit(fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
                                   "<svg width=\"{}\" height=\"{}\" xmlns=\"http://www.w3.org/2000/svg\" "
                                   "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\">\n",
                                   format_number(page_.size().x, svg_decimals),
                                   format_number(page_.size().y, svg_decimals)),
                       next);
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<Slic3rProduct>();
        Polygons all;
        const auto add = [&](const std::vector<Contour>& contours, double& area) {
            for (const Contour& contour : contours) {
                area += signed_area(contour.points);
                all.push_back(to_polygon(contour.points));
            }
        };
        add(layer.contours(vector_.tolerance), product->area);
        add(layer.support_contours(vector_.tolerance), product->support_area);
        for (const NestedPolygon& border : nested_polygons(all)) {
            const bool hole = border.depth % 2 == 1;
            std::string& text = product->polygons;
            text += fmt::format("    <polygon slic3r:type=\"{}\" points=\"", hole ? "hole" : "contour");
            bool first = true;
            for (const dvec2& p : to_points(border.polygon)) {
                if (!first) text += ' ';
                first = false;
                append_number(text, p.x - page_.lo.x, svg_decimals);
                text += ',';
                append_number(text, p.y - page_.lo.y, svg_decimals);
            }
            text += fmt::format("\" style=\"fill: {}\" />\n", hole ? "black" : "white");
        }
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<Slic3rProduct>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        output_.commit(
            fmt::format("  <g id=\"layer{}\" slic3r:z=\"{}\">\n{}  </g>\n", layer.index(),
                        format_number(layer.z() - z0_, 6), dynamic_cast<Slic3rProduct&>(product).polygons),
            layer.index() + 1);
    }

    void finish() override { output_.end(svg_end); }

  private:
    VectorProfile vector_;
    UnfinishedFile output_;
    Rect page_;
    double z0_ = 0;
};

}  // namespace

std::unique_ptr<Backend> make_slic3r_svg(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Slic3rSvg>(profile, path, force);
}

}  // namespace lamella
