// Oracle: linear interpolation between two points, by hand.
#include "numerics/signals/interpolation.h"

#include <gtest/gtest.h>

#include <limits>

#include "numerics/error.h"
#include "support/thrown_message.h"

namespace dynlab {
namespace test_interpolation {

const Vector kX{{0, 1, 3}}, kY{{5, 10, -10}};

TEST(interpolation, joins_neighbors_by_straight_lines) {
    const Vector found = interpolate_linearly(kX, kY, Vector{{0, 0.5, 1, 2, 3}});
    EXPECT_EQ(found, (Vector{{5, 7.5, 10, 0, -10}}));
}

TEST(interpolation, has_no_values_outside_unless_the_ends_are_held) {
    EXPECT_THROW(interpolate_linearly(kX, kY, Vector{{-0.5}}), InvalidArgument);
    EXPECT_THROW(interpolate_linearly(kX, kY, Vector{{3.5}}), InvalidArgument);
    const Vector found = interpolate_linearly(kX, kY, Vector{{-7, 0, 2, 3.5}}, Outside::kHold);
    EXPECT_EQ(found, (Vector{{5, 5, 0, -10}}));
    const Vector no_number = Vector::Constant(1, std::numeric_limits<double>::quiet_NaN());
    EXPECT_THROW(interpolate_linearly(kX, kY, no_number, Outside::kHold), InvalidArgument);
    EXPECT_EQ(thrown_message([&] { interpolate_linearly(kX, kY, -no_number); }),
              "interpolation at NaN is not possible, because x ranges from 0 to 3. To use the values of the end points "
              "outside this range, specify outside = \"hold\"");
    EXPECT_EQ(thrown_message([&] { interpolate_linearly(kX, kY, Vector{{3.0000001}}); }),
              "interpolation at 3.0000001 is not possible, because x ranges from 0 to 3. To use the values of the end "
              "points outside this range, specify outside = \"hold\"");
}

}  // namespace test_interpolation
}  // namespace dynlab
