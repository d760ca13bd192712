// LayerBeads: plans the beads of a layer, tool by tool.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "printers/common/profile.h"
#include "printers/gcode/object_labels.h"
#include "printers/toolpath/neighbour_layers.h"
#include "printers/toolpath/toolpath.h"

namespace lamella {

/// When beads are laid: always, or only where their tool was changed to before, or was not.
enum class LaidWhen : std::uint8_t { always, tool_changed, tool_kept };

/// Beads that one tool lays one after the other.
struct ToolBeads {
    static constexpr int any = -1;

    int tool = 0;  ///< `any`: the one that is in use
    LaidWhen when = LaidWhen::always;
    Toolpaths paths;
};

struct LayerPaths {
    std::vector<ToolBeads> beads;  ///< in printing order; those of one tool follow each other
    double part_area = 0;          ///< of the layer's section, mm^2
    double support_area = 0;
    int islands_left_out = 0;
};

/// Plans the toolpaths of a job's layers. Even layers take their tools in ascending order, odd ones in
/// descending order, so that the tool is kept between layers that need the same ones. A tool lays its strip
/// of the purge tower first, then brim and skirt, then supports, because the part rests on them. Thread-safe;
/// a layer's beads depend on the job alone. Job and profile must outlive the object.
class LayerBeads {
  public:
    LayerBeads(const Job& job, const PrinterProfile& profile)
        : job_(job), profile_(profile), neighbours_(job, profile.filament.tolerance) {}

    /// `labels` tell the part of the plate that a bead belongs to.
    LayerPaths plan(const Layer& layer, const ObjectLabels& labels) const;
    /// Drops what is held for layers below `index`.
    void forget_below(int index) { neighbours_.forget_below(index - profile_.toolpath.bottom_layers); }

  private:
    LineSettings line(const Layer& layer) const;
    Toolpaths fill(const Layer& layer, const std::vector<Contour>& contours, double density,
                   const LayerNeighborhood& around) const;
    std::optional<LayerBelow> footing(const Layer& layer) const;
    std::optional<PlacedPolygons> core(const Layer& layer) const;
    Toolpaths skirt(const Layer& layer, const LayerOutlines& outlines) const;
    Toolpaths tower_piece(const Layer& layer, const Rect& rect, double density) const;
    void add_tower(const Layer& layer, const std::vector<int>& tools, LayerPaths& planned) const;

    const Job& job_;
    const PrinterProfile& profile_;
    NeighbourLayers neighbours_;
};

}  // namespace lamella
