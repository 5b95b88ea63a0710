#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace trg {

int resolve_threads(int threads) {
    if (threads > 0) return threads;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(int64_t count, int64_t grain, int threads,
                  const std::function<void(int64_t, int64_t)>& work) {
    const int64_t ranges = (count + grain - 1) / grain;
    const int64_t workers = std::min<int64_t>(resolve_threads(threads), ranges);
    std::atomic<int64_t> next{0};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    auto run = [&] {
        try {
            for (int64_t range = next++; range < ranges; range = next++) {
                work(range * grain, std::min(count, (range + 1) * grain));
            }
        } catch (...) {
            std::lock_guard<std::mutex> lock(failure_mutex);
            if (!failure) failure = std::current_exception();
            next = ranges;
        }
    };

    std::vector<std::thread> helpers;
    try {
        helpers.reserve(workers - 1 > 0 ? workers - 1 : 0);
        for (int64_t k = 1; k < workers; ++k) helpers.emplace_back(run);
    } catch (const std::system_error&) {
        // The machine gives no more threads: those that there are do all of it.
    }
    run();
    for (std::thread& helper : helpers) helper.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace trg
