// State of one layer in flight: its slices, each computed once, and reusable row buffers.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/field/field.h"
#include "engine/runs/run_collector.h"

namespace lamella {

/// Reusable row buffers of one worker. Not thread-safe.
class Scratch {
  public:
    /// A borrowed buffer; its destructor returns it to the scratch.
    class Lease {
      public:
        Lease(Scratch& owner, std::unique_ptr<RunRows> rows) : owner_(&owner), rows_(std::move(rows)) {}
        Lease(Lease&&) = default;
        Lease& operator=(Lease&&) = delete;
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        ~Lease() {
            if (rows_) owner_->free_.push_back(std::move(rows_));
        }
        RunRows& operator*() const { return *rows_; }
        RunRows* operator->() const { return rows_.get(); }

      private:
        Scratch* owner_;
        std::unique_ptr<RunRows> rows_;
    };

    /// Returns a cleared row buffer.
    Lease rows() {
        if (free_.empty()) return {*this, std::make_unique<RunRows>()};
        auto rows = std::move(free_.back());
        free_.pop_back();
        rows->clear();
        return {*this, std::move(rows)};
    }

    /// For kernels that make the runs of many convex objects; contents are undefined between calls.
    RunCollector collector;

  private:
    std::vector<std::unique_ptr<RunRows>> free_;
};

/// Owns the slices of one layer. The slice of a shared field is computed once. Not thread-safe while slices
/// are being made; the finished slices are.
class SliceContext {
  public:
    /// Returns the field's slice at height z, mm; computes it on first use.
    const SliceField& slice(const Field& field, double z) {
        const auto key = std::make_pair(&field, z);
        if (const auto found = memo_.find(key); found != memo_.end()) return *found->second;
        const SliceField& made = field.slice(*this, z);
        memo_.emplace(key, &made);
        return made;
    }

    /// Makes a slice that lives as long as the context.
    template <typename Slice, typename... Arguments>
    const Slice& make(Arguments&&... arguments) {
        auto slice = std::make_unique<Slice>(std::forward<Arguments>(arguments)...);
        const Slice& made = *slice;
        slices_.push_back(std::move(slice));
        return made;
    }

  private:
    std::map<std::pair<const Field*, double>, const SliceField*> memo_;
    std::vector<std::unique_ptr<SliceField>> slices_;
};

}  // namespace lamella
