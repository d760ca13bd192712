// What one layer in flight owns: its slices, worked out once each, and reusable row buffers.
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
    /// A buffer on loan; it goes back to the scratch when the lease ends.
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

    /// A cleared row buffer.
    Lease rows() {
        if (free_.empty()) return {*this, std::make_unique<RunRows>()};
        auto rows = std::move(free_.back());
        free_.pop_back();
        rows->clear();
        return {*this, std::move(rows)};
    }

    /// For kernels that make the runs of many convex things; contents are undefined between calls.
    RunCollector collector;

  private:
    std::vector<std::unique_ptr<RunRows>> free_;
};

/// Owns the slices of one layer. Slices of a shared field are worked out once. Not thread-safe while slicing;
/// the finished slices are.
class SliceContext {
  public:
    /// The field's slice at height z, mm; made on first use.
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
