// Objects of the C interface that release themselves, for tests.
#pragma once

#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "bindings/lamella.h"

namespace lamella {

template <typename T>
T sized() {
    T value{};
    value.struct_size = sizeof value;
    return value;
}

/// A context whose failures fail the test, unless it is asked for the status.
class Caller {
  public:
    Caller() { expect_ok(lamella_context_create(LAMELLA_ABI_VERSION, &context_), "no context"); }
    ~Caller() { lamella_context_destroy(context_); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;
    operator lamella_context*() const { return context_; }

    lamella_error error() const {
        auto error = sized<lamella_error>();
        expect_ok(lamella_last_error(context_, &error), "no error to tell");
        return error;
    }
    void require(std::int32_t status) const {
        if (status != LAMELLA_OK) expect_ok(status, error().message);
    }

  private:
    /// Assertions are for one thread only, and each thread has a caller of its own.
    static void expect_ok(std::int32_t status, const char* message) {
        if (status != LAMELLA_OK) throw std::runtime_error(message);
    }

    lamella_context* context_ = nullptr;
};

using RecipeHandle = std::unique_ptr<lamella_recipe, decltype(&lamella_recipe_destroy)>;
using JobHandle = std::unique_ptr<lamella_job, decltype(&lamella_job_destroy)>;
using SectionHandle = std::unique_ptr<lamella_section, decltype(&lamella_section_destroy)>;
using ContoursHandle = std::unique_ptr<lamella_contours, decltype(&lamella_contours_destroy)>;

inline RecipeHandle recipe_by_call(const Caller& caller, const std::string& text = "") {
    lamella_recipe* recipe = nullptr;
    caller.require(lamella_recipe_create(caller, &recipe));
    RecipeHandle handle(recipe, lamella_recipe_destroy);
    if (!text.empty())
        caller.require(lamella_recipe_add_text(caller, recipe, text.data(), text.size(), "test.toml"));
    return handle;
}

inline JobHandle job_by_call(const Caller& caller, const lamella_recipe* recipe) {
    lamella_job* job = nullptr;
    caller.require(lamella_job_build(caller, recipe, nullptr, &job));
    return {job, lamella_job_destroy};
}

inline JobHandle job_by_call(const Caller& caller, const std::string& text) {
    return job_by_call(caller, recipe_by_call(caller, text).get());
}

inline SectionHandle section_by_call(const Caller& caller, const lamella_job* job, double z) {
    lamella_section* section = nullptr;
    caller.require(lamella_section_open(caller, job, z, &section));
    return {section, lamella_section_destroy};
}

inline double area_by_call(const Caller& caller, lamella_section* section, double tolerance = 0.01,
                           std::int32_t what = LAMELLA_PART) {
    lamella_contours* contours = nullptr;
    caller.require(lamella_section_contours(caller, section, what, tolerance, &contours));
    const ContoursHandle handle(contours, lamella_contours_destroy);
    auto view = sized<lamella_contours_view>();
    caller.require(lamella_contours_view_get(caller, contours, &view));
    return view.area;
}

}  // namespace lamella
