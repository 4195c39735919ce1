#include "numerics/filters/lanes.h"

#include <gtest/gtest.h>

#include <vector>

namespace test_lanes {

using namespace dynlab;

std::vector<double> counted(int count) {
    std::vector<double> x(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = i;
    return x;
}

// oracle of all: definition, number by number

TEST(lanes, a_tile_takes_every_stride_th_number_step_by_step) {
    const std::vector<double> x = counted(300);
    for (const long stride : {8L, 9L, 31L}) {
        Lanes::Part tile[Lanes::kWidth];
        Lanes::gather_tile(x.data() + 2, stride, tile);
        for (int step = 0; step < Lanes::kWidth; ++step)
            for (int lane = 0; lane < Lanes::kWidth; ++lane)
                EXPECT_EQ(tile[step][lane], 2.0 + step + static_cast<double>(lane * stride));
    }
}

TEST(lanes, repeat_counts_up_with_constants) {
    std::vector<int> seen;
    repeat<4>([&](auto i) {
        static_assert(decltype(i)::value >= 0);
        seen.push_back(i);
    });
    EXPECT_EQ(seen, (std::vector<int>{0, 1, 2, 3}));
}

}  // namespace test_lanes
