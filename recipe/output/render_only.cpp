// Opens the outputs in a temporary folder.
#include "recipe/output/render_only.h"

#include <filesystem>
#include <vector>

#include "engine/base/error.h"
#include "recipe/identity.h"
#include "recipe/printer_choice.h"

namespace lamella {
namespace {

namespace fs = std::filesystem;

/// A temporary folder that is removed with this object.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::error_code error;
        std::string pattern = (fs::temp_directory_path(error) / "lamella_XXXXXX").string();
        if (error || mkdtemp(pattern.data()) == nullptr)
            throw FaultError("cannot make a folder for unfinished layers in " + pattern);
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

class Renderer : public Backend {
  public:
    Renderer(std::span<const Output> outputs, LayerRange whole) : whole_(whole) {
        std::vector<Output> moved(outputs.begin(), outputs.end());
        for (std::size_t i = 0; i < moved.size(); ++i) {
            const fs::path folder = folder_.path() / std::to_string(i);
            fs::create_directory(folder);
            const fs::path name = fs::path(moved[i].path).filename();
            moved[i].path = (folder / (name.empty() || name == "-" ? "layers" : name)).string();
        }
        outputs_ = make_outputs(moved, true);
    }
    int open(const Job& job, LayerRange range, bool /*resume*/) override {
        outputs_->open(job, whole_, false);
        return range.first;
    }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        return outputs_->render(layer);
    }
    void write(const Layer& /*layer*/, LayerProduct& /*product*/) override {}
    void finish() override {}

  private:
    ScratchFolder folder_;  ///< outlives the files open in it
    std::unique_ptr<Backend> outputs_;
    LayerRange whole_;
};

}  // namespace

std::unique_ptr<Backend> make_renderer(std::span<const Output> outputs, LayerRange whole) {
    return std::make_unique<Renderer>(outputs, whole);
}

std::string settings_of(std::span<const Output> outputs) {
    Fnv128 hash;
    for (const Output& output : outputs) {
        if (output.open)
            throw InputError(output.path +
                             ": layers rendered by a plugin cannot be stored or sent to another process; "
                             "accepted: outputs of lamella's own printers");
        hash.add(profile_as_toml({output.printer, "", ""}) + "\n");
    }
    return hash.hex();
}

}  // namespace lamella
