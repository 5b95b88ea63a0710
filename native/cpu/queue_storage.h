/// The memory behind the queues of one thread.
#pragma once

#include <vector>

#include "kernel/path_queues.h"

namespace trg {

class QueueStorage {
  public:
    /// Room for `capacity` paths with `lights` shadow rays each.
    QueueStorage(int32_t capacity, int32_t lights)
        : rays_(capacity),
          hits_(capacity),
          states_(capacity),
          keys_(capacity),
          results_(capacity),
          receivers_(capacity),
          shadow_rays_(static_cast<size_t>(capacity) * lights),
          shadows_(static_cast<size_t>(capacity) * lights),
          hidden_(static_cast<size_t>(capacity) * (lights > 1 ? lights : 1)),
          depth_(capacity) {}

    PathQueues view() {
        const int32_t capacity = static_cast<int32_t>(rays_.size());
        return {capacity,        rays_.data(),    hits_.data(),      states_.data(),
                keys_.data(),    results_.data(), receivers_.data(), shadow_rays_.data(),
                shadows_.data(), hidden_.data()};
    }
    float* depth() { return depth_.data(); }

  private:
    std::vector<Ray> rays_;
    std::vector<Hit> hits_;
    std::vector<PathState> states_;
    std::vector<SampleKey> keys_;
    std::vector<PathResult> results_;
    std::vector<Vec3> receivers_;
    std::vector<Ray> shadow_rays_;
    std::vector<ShadowState> shadows_;
    std::vector<uint8_t> hidden_;
    std::vector<float> depth_;
};

}  // namespace trg
