#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
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
    std::atomic<int> interrupted = 0;
    side_by_side(40, [&](std::size_t) {
        if (busy) ++interrupted;
        busy = true;
        std::atomic<long> sum = 0;
        side_by_side(20, [&](std::size_t j) { sum += static_cast<long>(j); });
        EXPECT_EQ(sum, 190);
        busy = false;
    });
    EXPECT_EQ(interrupted, 0);
}

TEST(side_by_side, throws_what_a_piece_throws) {
    for (const bool long_enough : {true, false})
        EXPECT_THROW(side_by_side(
                         5, [](std::size_t i) { i == 3 ? throw std::runtime_error("third") : void(); }, long_enough),
                     std::runtime_error);
}

}  // namespace test_side_by_side
