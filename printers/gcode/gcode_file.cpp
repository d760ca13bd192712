// G-code written to a file.
#include "printers/archive/unfinished_file.h"
#include "printers/gcode/gcode_output.h"

namespace lamella {
namespace {

class GcodeFile : public GcodeOutput {
  public:
    GcodeFile(const std::string& path, bool force) : file_(path, force) {}

    int begin(const JobStamp& stamp, bool resume) override { return file_.begin(stamp, resume); }
    nlohmann::ordered_json state() const override {
        return file_.history().empty() ? nlohmann::ordered_json() : file_.history().back();
    }
    InputError damaged_state() const override { return file_.damaged_journal(); }
    void commit(std::string_view text, int next, const nlohmann::ordered_json& state) override {
        file_.commit(text, next, state);
    }
    void end(std::string_view text) override { file_.end(text); }

  private:
    UnfinishedFile file_;
};

}  // namespace

std::unique_ptr<GcodeOutput> make_gcode_file(const std::string& path, bool force) {
    return std::make_unique<GcodeFile>(path, force);
}

}  // namespace lamella
