#include "course/store/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace dynlab::inline course {

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void(std::size_t, std::size_t)>& progress) {
    std::atomic<std::size_t> next = 0, done = 0;
    std::exception_ptr failure;
    std::once_flag failed;
    const auto worker = [&](bool shows) {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                std::call_once(failed, [&] { failure = std::current_exception(); });
                next = count;
                return;
            }
            ++done;
            if (shows && progress) progress(done, count);
        }
    };
    {
        std::vector<std::jthread> others;
        const std::size_t workers = std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
        for (std::size_t i = 1; i < workers; ++i) others.emplace_back(worker, false);
        worker(true);
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace dynlab::inline course
