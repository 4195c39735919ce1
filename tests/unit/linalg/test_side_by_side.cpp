#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "numerics/linalg/side_by_side.h"

namespace test_side_by_side {

using namespace dynlab;

TEST(side_by_side, does_each_piece_once_also_within_another) {  // oracle: counted
    for (const bool long_enough : {true, false}) {
        std::vector<std::atomic<int>> done(7 * 50);
        side_by_side(7, [&](std::size_t i) {
            side_by_side(
                50, [&](std::size_t j) { ++done[50 * i + j]; }, long_enough);
        });
        for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
    }
    side_by_side(0, [](std::size_t) { FAIL(); });
}

TEST(side_by_side, a_waiting_thread_takes_up_no_other_piece) {  // oracle: a thread's own mark, set during its piece
    static thread_local bool busy = false;
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);  // also with fewer cores
    tbb::task_arena arena(8);
    std::atomic<int> interrupted = 0;
    const auto piece = [&](std::size_t) {
        if (busy) ++interrupted;
        busy = true;
        // Long enough for another thread to take up one of them, and for this one to wait for it.
        side_by_side(3, [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
        busy = false;
    };
    arena.execute([&] { side_by_side(100, piece); });
    EXPECT_EQ(interrupted, 0);
}

TEST(side_by_side, throws_what_a_piece_throws) {
    for (const bool long_enough : {true, false})
        EXPECT_THROW(side_by_side(
                         5, [](std::size_t i) { i == 3 ? throw std::runtime_error("third") : void(); }, long_enough),
                     std::runtime_error);
}

}  // namespace test_side_by_side
