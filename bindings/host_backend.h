// HostBackend: passes layers to the callbacks of an embedding program or a plugin.
#pragma once

#include <string>

#include "bindings/lamella.h"
#include "engine/layers/backend.h"

namespace lamella {

class HostBackend : public Backend {
  public:
    /// `flags` are passed to `begin`. Throws BadCall when `render` or `write` is missing.
    HostBackend(const lamella_backend& callbacks, std::uint32_t flags);

    int open(const Job& job, LayerRange range, bool resume) override;
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override;
    void write(const Layer& layer, LayerProduct& product) override;
    void finish() override;

  private:
    void check(std::int32_t status, const char* callback) const;

    lamella_backend callbacks_;
    std::uint32_t flags_;
};

}  // namespace lamella
