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

TEST(lanes, gather_takes_every_stride_th_number) {
    const std::vector<double> x = counted(200);
    for (const long stride : {1L, 2L, 3L, 7L, 25L}) {
        const Lanes lanes = Lanes::gather(x.data() + 3, stride);
        for (int lane = 0; lane < Lanes::kCount; ++lane)
            EXPECT_EQ(lanes[lane], 3.0 + static_cast<double>(lane * stride));
        const Lanes::Part part = Lanes::gather_part(x.data() + 5, stride);
        for (int lane = 0; lane < Lanes::kWidth; ++lane)
            EXPECT_EQ(part[lane], 5.0 + static_cast<double>(lane * stride));
    }
}

TEST(lanes, a_tile_is_that_many_gathers_one_after_the_other) {
    const std::vector<double> x = counted(300);
    for (const long stride : {8L, 9L, 31L}) {
        Lanes::Part tile[Lanes::kWidth];
        Lanes::gather_tile(x.data() + 2, stride, tile);
        for (int step = 0; step < Lanes::kWidth; ++step)
            for (int lane = 0; lane < Lanes::kWidth; ++lane)
                EXPECT_EQ(tile[step][lane], 2.0 + step + static_cast<double>(lane * stride));
    }
}

TEST(lanes, arithmetic_is_that_of_each_number) {
    const std::vector<double> x = counted(8);
    Lanes lanes = Lanes::gather(x.data(), 1);
    EXPECT_EQ(lanes.sum(), 28);
    lanes.add(2, lanes.times(3));
    lanes += lanes;
    lanes.set(5, -1);
    for (int lane = 0; lane < Lanes::kCount; ++lane) EXPECT_EQ(lanes[lane], lane == 5 ? -1 : 14 * lane);
    const Lanes copy(lanes);
    lanes.set(0, 9);
    EXPECT_EQ(copy[0], 0);
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
