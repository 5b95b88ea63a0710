/// Work shared among threads in ranges that do not depend on how many threads there are.
#pragma once

#include <cstdint>
#include <functional>

namespace trg {

/// `threads`, or the number of cores when it is 0 or less.
int resolve_threads(int threads);

/// Calls `work(begin, end)` for the consecutive ranges of `grain` items that cover [0, count).
/// The ranges are the same for any number of threads; which thread takes one is not said.
/// The first exception that `work` throws ends the loop early and is thrown again here.
void parallel_for(int64_t count, int64_t grain, int threads,
                  const std::function<void(int64_t, int64_t)>& work);

}  // namespace trg
