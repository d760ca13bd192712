// Back-ends Fetching and Sending: unpack received layers, pack rendered layers.
#include "printers/common/carried_layers.h"

namespace lamella {
namespace {

class Fetching : public Backend {
  public:
    Fetching(std::unique_ptr<Backend> outputs, FetchLayer fetch)
        : outputs_(std::move(outputs)), fetch_(std::move(fetch)) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        return outputs_->open(job, range, resume);
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        std::optional<std::string> bytes = fetch_(layer.index());
        if (!bytes) return outputs_->render(layer);
        auto product = empty_product();
        if (!product) throw FaultError("the output takes no layers that were made elsewhere");
        unpack(std::move(*bytes), *product);
        return product;
    }
    std::unique_ptr<LayerProduct> empty_product() const override { return outputs_->empty_product(); }
    void write(const Layer& layer, LayerProduct& product) override { outputs_->write(layer, product); }
    void finish() override { outputs_->finish(); }
    std::vector<std::string> notes() const override { return outputs_->notes(); }

  private:
    std::unique_ptr<Backend> outputs_;
    FetchLayer fetch_;
};

class Sending : public Backend {
  public:
    Sending(std::unique_ptr<Backend> renderer, LayerRange whole, SendLayer send)
        : renderer_(std::move(renderer)), whole_(whole), send_(std::move(send)) {}

    int open(const Job& job, LayerRange range, bool /*resume*/) override {
        if (!begun_) renderer_->open(job, whole_, false);
        begun_ = true;
        return range.first;
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        return renderer_->render(layer);
    }
    void write(const Layer& layer, LayerProduct& product) override { send_(layer.index(), pack(product)); }
    void finish() override {}

  private:
    std::unique_ptr<Backend> renderer_;
    LayerRange whole_;
    SendLayer send_;
    bool begun_ = false;
};

}  // namespace

std::unique_ptr<Backend> make_fetching(std::unique_ptr<Backend> outputs, FetchLayer fetch) {
    return std::make_unique<Fetching>(std::move(outputs), std::move(fetch));
}

std::unique_ptr<Backend> make_sending(std::unique_ptr<Backend> renderer, LayerRange whole, SendLayer send) {
    return std::make_unique<Sending>(std::move(renderer), whole, std::move(send));
}

}  // namespace lamella
