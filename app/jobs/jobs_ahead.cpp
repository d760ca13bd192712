// One thread waits for the next look.
#include "app/jobs/jobs_ahead.h"

#include <algorithm>
#include <utility>

#include "app/jobs/layer_content.h"

namespace lamella {

void JobsAhead::begin(Look look) {
    const std::lock_guard lock(mutex_);
    next_ = std::move(look);
    cancel_->cancel();
    changed_.notify_all();
}

void JobsAhead::end() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        cancel_->cancel();
        changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
}

void JobsAhead::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return next_ || ends_; });
        if (ends_) return;
        const Look look = *std::exchange(next_, std::nullopt);
        const auto cancel = cancel_ = std::make_shared<CancelToken>();
        lock.unlock();
        show(look, cancel);
        lock.lock();
    }
}

void JobsAhead::show(const Look& look, const std::shared_ptr<CancelToken>& cancel) const {
    constexpr int few = 16;  // px along x: the foam of a layer is made for any picture of it
    try {
        const auto job = jobs_.build_ahead(look.text, look.session, cancel);
        if (!job || cancel->cancelled()) return;
        if (!look.layer) {
            PassControl control;
            control.threads = threads_;
            control.cancel = cancel.get();
            job->coverage(coarse_volume, control);
            return;
        }
        const int layer = std::clamp(*look.layer, 0, job->job().layers.count() - 1);
        layer_picture(*job, layer, {job->job().bounds.rect(), few}, false);
    } catch (const std::exception&) {  // told to the page when it asks
    }
}

}  // namespace lamella
