// Combines checking back-ends with writing ones.
#include "app/reports/check_outputs.h"

#include "printers/common/several_outputs.h"

namespace lamella {
namespace {

/// A back-end for a check whose report is read after the back-ends are destroyed.
class SharedCheck : public Backend {
  public:
    explicit SharedCheck(std::shared_ptr<PrintCheck> check) : check_(std::move(check)) {}
    int open(const Job& job, LayerRange range, bool /*resume*/) override {
        return check_->open(job, range, false);
    }
    std::optional<RowBand> shared_lines() const override { return check_->shared_lines(); }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override { return check_->render(layer); }
    std::unique_ptr<LayerProduct> empty_product() const override { return check_->empty_product(); }
    void write(const Layer& layer, LayerProduct& product) override { check_->write(layer, product); }
    void finish() override { check_->finish(); }

  private:
    std::shared_ptr<PrintCheck> check_;
};

}  // namespace

std::unique_ptr<Backend> OutputChecks::check_of(const PrinterProfile& machine, const std::string& part,
                                                const Job& job, int parts) {
    const CheckPlan plan = plan_check(machine, job, parts);
    planned_.push_back({part, machine.name, plan, {}});
    checks_.push_back(std::make_shared<PrintCheck>(job, plan.options));
    return std::make_unique<SharedCheck>(checks_.back());
}

std::unique_ptr<Backend> OutputChecks::beside(std::unique_ptr<Backend> outputs,
                                              const std::vector<Output>& machines, const std::string& part,
                                              const Job& job, int parts) {
    std::vector<std::unique_ptr<Backend>> all;
    all.push_back(std::move(outputs));
    for (const Output& output : machines) all.push_back(check_of(output.printer, part, job, parts));
    return make_several_outputs(std::move(all));
}

std::vector<CheckOutcome> OutputChecks::outcomes() const {
    std::vector<CheckOutcome> outcomes = planned_;
    for (std::size_t i = 0; i < outcomes.size(); ++i) outcomes[i].report = checks_[i]->report();
    return outcomes;
}

}  // namespace lamella
