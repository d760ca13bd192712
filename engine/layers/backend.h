// LayerPass and Backend: the interfaces of everything that takes layers in order.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/archive.h"
#include "engine/layers/layer.h"

namespace lamella {

/// What a pass computes from one layer. Each pass derives its own payload.
struct LayerProduct {
    virtual ~LayerProduct() = default;
    /// Packs or unpacks the payload, without the areas. Throws FaultError where products cannot be sent.
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

/// Whether a pass takes jobs whose parts are printed one by one, or makes layers of the whole plate.
enum class TakesStacks : bool { no, yes };

/// Throws InputError unless `range` is a valid range of the job's layers, with at least one, and for stacks
/// of layers where these are not taken.
void check_range(const Job& job, const LayerRange& range, TakesStacks takes = TakesStacks::no);

/// A pass over a job's layers. `render` is called for several layers at once; the rest comes from one thread,
/// in order: `write` for each layer by ascending index, then `finish`.
class LayerPass {
  public:
    virtual ~LayerPass() = default;
    /// Returns the scanlines of each layer that `render` reads, if other passes may share them.
    virtual std::optional<RowBand> shared_lines() const { return {}; }
    /// Computes a layer's product. Thread-safe, pure.
    virtual std::unique_ptr<LayerProduct> render(const Layer& layer) const = 0;
    /// Takes one layer's product. Throws FaultError when it cannot be written.
    virtual void write(const Layer& layer, LayerProduct& product) = 0;
    /// Ends the pass after its last layer.
    virtual void finish() {}
};

/// A destination of layers: a file, an image stack or a machine. `open` is called first; `finish` gives the
/// output its final name. A back-end that is destroyed before `finish` leaves the layers written so far under
/// an unfinished name, from which a later run can continue.
///
///     class Areas : public Backend {
///         int open(const Job&, LayerRange range, bool) override { return range.first; }
///         std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
///             auto product = std::make_unique<LayerProduct>();
///             product->area = area(layer.contours(0.01));
///             return product;
///         }
///         void write(const Layer& layer, LayerProduct& product) override {
///             std::cout << layer.index() << " " << product.area << "\n";
///         }
///     };
class Backend : public LayerPass {
  public:
    /// Opens the output. Returns the first layer that is still missing: range.first, or later when `resume`
    /// is set and an unfinished output of the same job (Job::identity) and range exists. The range lies
    /// within the job. Throws InputError when the output exists already or belongs to another job, FaultError
    /// when it cannot be made.
    virtual int open(const Job& job, LayerRange range, bool resume) = 0;
    /// Returns an empty product, to unpack a product that `render` of another process packed. Null where
    /// products cannot be sent between processes.
    virtual std::unique_ptr<LayerProduct> empty_product() const { return nullptr; }
    /// Returns what a user should know about the layers written in this run; a sentence each.
    virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace lamella
