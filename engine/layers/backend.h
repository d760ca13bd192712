// Backend: where finished layers go. One interface for files, image stacks and machines.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/archive.h"
#include "engine/layers/layer.h"

namespace lamella {

/// What a back-end made of one layer, ready to be written. Back-ends derive their own payload.
struct LayerProduct {
    virtual ~LayerProduct() = default;
    /// Packs or unpacks what is written of the layer, the areas not included.
    virtual void serialize(Archive& /*parcel*/) {
        throw FaultError("what was made of a layer cannot be carried");
    }

    double area = 0;          ///< solid area of the layer's part, mm^2
    double support_area = 0;  ///< of its supports, mm^2
};

/// A product as bytes for another process, and back.
std::string pack(LayerProduct& product);
void unpack(std::string bytes, LayerProduct& product);

/// The range of layers a run makes: [first, last).
struct LayerRange {
    int first = 0;
    int last = 0;
    int count() const { return last - first; }
};

/// A destination of layers. `render` is called for several layers at once; the rest comes from one thread, in
/// order: begin, write for each layer by ascending index, then end. A back-end that is destroyed before `end`
/// leaves what it has written under its unfinished name, so that a later run can continue it.
class Backend {
  public:
    virtual ~Backend() = default;
    /// Opens the output. Returns the first layer that is still missing: range.first, or later when `resume`
    /// is set and an unfinished output of the same job (Job::identity) and range exists. Throws InputError
    /// when the output exists already or belongs to another job, FaultError when it cannot be made.
    virtual int begin(const Job& job, LayerRange range, bool resume) = 0;
    /// Lines of each layer that `render` looks at, where others may go through them, too.
    virtual std::optional<RowBand> lines_looked_at() const { return {}; }
    /// Computes what will be written of a layer. Thread-safe, pure.
    virtual std::unique_ptr<LayerProduct> render(const Layer& layer) const = 0;
    /// An empty product, to unpack into what `render` of another process packed. Null where layers cannot be
    /// carried.
    virtual std::unique_ptr<LayerProduct> empty_product() const { return nullptr; }
    /// Writes one layer. Throws FaultError when that fails.
    virtual void write(const Layer& layer, LayerProduct& product) = 0;
    /// Completes the output and gives it its final name.
    virtual void end() = 0;
    /// What a user should know about the layers written in this run; a sentence each.
    virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace lamella
