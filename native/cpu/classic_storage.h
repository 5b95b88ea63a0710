/// The memory behind the classic integrator's queues of one thread.
#pragma once

#include <vector>

#include "kernel/classic_queues.h"

namespace trg {

class ClassicStorage {
  public:
    /// Room for `paths` rays at a time and sixteen times as many pending, followed `depth` deep.
    ClassicStorage(int32_t paths, int32_t depth)
        : pending_(static_cast<size_t>(paths) * 16 + depth),
          batch_(paths),
          vertices_(paths),
          shadows_(paths) {}

    ClassicQueues view() {
        return {pending_.data(),
                static_cast<int32_t>(pending_.size()),
                0,
                batch_.data(),
                vertices_.data(),
                shadows_.data()};
    }

  private:
    std::vector<PendingRay> pending_;
    std::vector<PendingRay> batch_;
    std::vector<ClassicVertex> vertices_;
    std::vector<ClassicShadow> shadows_;
};

}  // namespace trg
