/// The memory behind the queues of one thread.
#pragma once

#include <memory>
#include <vector>

#include "cpu/classic_storage.h"
#include "cpu/pass_film.h"
#include "kernel/path_queues.h"

namespace trg {

class QueueStorage {
  public:
    /// Room for `capacity` paths with `lights` shadow rays each, and for what passes ask for.
    QueueStorage(int32_t capacity, int32_t lights, const PassRequest& passes)
        : rays_(capacity),
          hits_(capacity),
          states_(capacity),
          keys_(capacity),
          results_(capacity),
          receivers_(capacity),
          media_(capacity),
          shadow_rays_(static_cast<size_t>(capacity) * lights),
          shadows_(static_cast<size_t>(capacity) * lights),
          hidden_(static_cast<size_t>(capacity) * (lights > 1 ? lights : 1)),
          times_(capacity),
          ray_times_(hidden_.size()),
          depth_(capacity) {
        if (!passes.needs_kernels()) return;
        stride_ = lay_out_passes(passes).stride;
        pass_values_.resize(static_cast<size_t>(capacity) * stride_);
        pass_states_.resize(capacity);
        pass_hits_.resize(capacity);
        shadow_shares_.resize(static_cast<size_t>(capacity) * lights);
    }

    PathQueues view() {
        const int32_t capacity = static_cast<int32_t>(rays_.size());
        return {capacity,
                rays_.data(),
                hits_.data(),
                states_.data(),
                keys_.data(),
                results_.data(),
                receivers_.data(),
                media_.data(),
                boundaries_.data(),
                shadow_media_.data(),
                shadow_rays_.data(),
                shadows_.data(),
                hidden_.data(),
                {pass_values_.data(), stride_, pass_states_.data(), pass_hits_.data(),
                 shadow_shares_.data()},
                times_.data(),
                ray_times_.data(),
                classic_ ? &classic_view_ : nullptr,
                {limits_.data(), ray_masks_.data(), 0}};
    }
    /// Adds what the classic integrator needs, followed `depth` deep.
    void add_classic(int32_t depth) {
        classic_ = std::make_unique<ClassicStorage>(static_cast<int32_t>(rays_.size()), depth);
        classic_view_ = classic_->view();
    }
    /// Adds what media with priorities need.
    void add_boundaries() {
        boundaries_.resize(rays_.size());
        shadow_media_.resize(shadow_rays_.size());
    }
    /// Adds what kLimits needs.
    void add_limits() {
        limits_.resize(rays_.size());
        ray_masks_.resize(hidden_.size());
    }
    float* depth() { return depth_.data(); }

  private:
    std::vector<Ray> rays_;
    std::vector<Hit> hits_;
    std::vector<PathState> states_;
    std::vector<SampleKey> keys_;
    std::vector<PathResult> results_;
    std::vector<Vec3> receivers_;
    std::vector<MediaStack> media_;
    std::vector<Boundary> boundaries_;
    std::vector<MediaStack> shadow_media_;
    std::vector<Ray> shadow_rays_;
    std::vector<ShadowState> shadows_;
    std::vector<uint8_t> hidden_;
    std::vector<float> times_, ray_times_;
    std::vector<float> depth_;
    std::vector<PathLimits> limits_;
    std::vector<uint8_t> ray_masks_;
    int32_t stride_ = 0;
    std::vector<float> pass_values_;
    std::vector<PassState> pass_states_;
    std::vector<PassHit> pass_hits_;
    std::vector<ScatterShares> shadow_shares_;
    std::unique_ptr<ClassicStorage> classic_;
    ClassicQueues classic_view_{};
};

}  // namespace trg
