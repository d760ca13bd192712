// Asks at points that are turned back.
#include "engine/field/turned_grading.h"

#include <utility>

#include "engine/base/box_image.h"

namespace lamella {

namespace {

class TurnedGrading : public Grading {
  public:
    TurnedGrading(GradingPtr grading, const glm::dmat3& axes)
        : grading_(std::move(grading)), back_(glm::transpose(axes)) {}
    double at(dvec3 p) const override { return grading_->at(back_ * p); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        std::vector<dvec3> places;
        places.reserve(points.size());
        for (const dvec3& p : points) places.push_back(back_ * p);
        grading_->numbers(places, out);
    }
    Interval range(const Box& box) const override { return grading_->range(image_of(box, back_)); }

  private:
    GradingPtr grading_;
    glm::dmat3 back_;
};

}  // namespace

GradingPtr make_turned_grading(GradingPtr grading, const glm::dmat3& axes) {
    if (axes == glm::dmat3(1) || grading->constant()) return grading;
    return std::make_shared<TurnedGrading>(std::move(grading), axes);
}

}  // namespace lamella
