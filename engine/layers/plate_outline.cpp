// A pass that unites the rows and columns of all layers.
#include "engine/layers/plate_outline.h"

#include <algorithm>
#include <cmath>

#include "engine/layers/survey_rows.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

struct OutlineProduct : LayerProduct {
    RunRows rows, columns;
};

RunRows all_solid(const Layer& layer, const RowBand& band) {
    Scratch scratch;
    RunRows rows = all_rows(layer.part(), band, scratch);
    return layer.supports() == nullptr ? rows : united(rows, all_rows(*layer.supports(), band, scratch));
}

class OutlineSurveyor : public LayerPass {
  public:
    OutlineSurveyor(const Rect& rect, double pitch) : along_x_(rows_over(rect, pitch)), along_y_(along_x_) {
        along_y_.axis = Axis::y;
        std::swap(along_y_.along_origin, along_y_.across_origin);
        const auto pixels = [&](double size) {
            return std::max(1, static_cast<int>(std::ceil(size / pitch - 1e-9)));
        };
        along_x_.count = along_y_.hi = pixels(rect.size().y);
        along_y_.count = along_x_.hi = pixels(rect.size().x);
        outline_ = {rect.lo, pitch, empty_rows(static_cast<std::size_t>(along_x_.count)),
                    empty_rows(static_cast<std::size_t>(along_y_.count))};
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<OutlineProduct>();
        product->rows = all_solid(layer, along_x_);
        product->columns = all_solid(layer, along_y_);
        return product;
    }
    void write(const Layer& /*layer*/, LayerProduct& product) override {
        const auto& layer = static_cast<const OutlineProduct&>(product);
        outline_.rows = united(outline_.rows, layer.rows);
        outline_.columns = united(outline_.columns, layer.columns);
    }
    PlateOutline take() { return std::move(outline_); }

  private:
    RowBand along_x_, along_y_;
    PlateOutline outline_;
};

/// Returns the lines in reverse order, each read from its other end, as asked.
RunRows mirrored(const RunRows& rows, bool reverses_lines, bool reverses_runs, std::int32_t length) {
    RunRows out;
    out.reserve(rows.lines(), rows.runs().size());
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        const auto line = rows.line(reverses_lines ? rows.lines() - 1 - l : l);
        if (reverses_runs) {
            for (auto run = line.rbegin(); run != line.rend(); ++run)
                out.push(length - run->end, length - run->begin);
        } else {
            for (const Run& run : line) out.push(run.begin, run.end);
        }
        out.end_line();
    }
    return out;
}

}  // namespace

RunRows PlateOutline::turned(int quarters) const {
    const auto length = [](const RunRows& across) {
        return static_cast<std::int32_t>(across.lines()) * run_unit;
    };
    switch (quarters % 4) {
        case 1:
            return mirrored(columns, false, true, length(rows));
        case 2:
            return mirrored(rows, true, true, length(columns));
        case 3:
            return mirrored(columns, true, false, length(rows));
        default:
            return rows;
    }
}

PlateOutline survey_outline(const Job& job, double pitch, const PassControl& control) {
    OutlineSurveyor surveyor(job.bounds.rect(), pitch);
    survey_layers(job, surveyor, control);
    return surveyor.take();
}

}  // namespace lamella
