// Renders and writes the products of several back-ends side by side.
#include "printers/common/several_outputs.h"

#include <algorithm>

namespace lamella {
namespace {

/// One product per back-end; null if the back-end already has the layer.
struct Products : LayerProduct {
    explicit Products(const std::vector<std::unique_ptr<Backend>>& to) : outputs(to) {}

    void serialize(Archive& parcel) override {
        each.resize(outputs.size());
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            bool is_there = each[i] != nullptr;
            parcel(is_there);
            if (!is_there) continue;
            if (!each[i]) each[i] = outputs[i]->empty_product();
            if (!each[i]) throw FaultError("what was made of a layer cannot be carried");
            parcel(each[i]->area, each[i]->support_area);
            each[i]->serialize(parcel);
        }
    }

    const std::vector<std::unique_ptr<Backend>>& outputs;
    std::vector<std::unique_ptr<LayerProduct>> each;
};

class SeveralOutputs : public Backend {
  public:
    explicit SeveralOutputs(std::vector<std::unique_ptr<Backend>> outputs) : outputs_(std::move(outputs)) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        next_.clear();
        for (const auto& output : outputs_) next_.push_back(output->open(job, range, resume));
        return *std::min_element(next_.begin(), next_.end());
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto products = std::make_unique<Products>(outputs_);
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            const std::optional<RowBand> lines = outputs_[i]->shared_lines();
            if (lines && layer.index() >= next_[i]) layer.cache_lines(*lines);
        }
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            auto product = layer.index() < next_[i] ? nullptr : outputs_[i]->render(layer);
            if (product && products->area == 0) {
                products->area = product->area;
                products->support_area = product->support_area;
            }
            products->each.push_back(std::move(product));
        }
        return products;
    }

    std::unique_ptr<LayerProduct> empty_product() const override {
        return std::make_unique<Products>(outputs_);
    }

    void write(const Layer& layer, LayerProduct& product) override {
        const auto& products = dynamic_cast<Products&>(product).each;
        for (std::size_t i = 0; i < outputs_.size(); ++i) {
            if (products[i] && layer.index() >= next_[i]) outputs_[i]->write(layer, *products[i]);
        }
    }

    void finish() override {
        for (const auto& output : outputs_) output->finish();
    }

    std::vector<std::string> notes() const override {
        std::vector<std::string> all;
        for (const auto& output : outputs_) {
            const std::vector<std::string> notes = output->notes();
            all.insert(all.end(), notes.begin(), notes.end());
        }
        return all;
    }

  private:
    std::vector<std::unique_ptr<Backend>> outputs_;
    std::vector<int> next_;  ///< first missing layer of each back-end
};

}  // namespace

std::unique_ptr<Backend> make_several_outputs(std::vector<std::unique_ptr<Backend>> outputs) {
    return std::make_unique<SeveralOutputs>(std::move(outputs));
}

}  // namespace lamella
