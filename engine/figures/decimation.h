#pragma once
#include <utility>
#include <vector>

namespace dynlab::inline figures {

/// A point of the page in cm. A gap in a curve is a point whose y is NaN.
struct PagePoint {
    double x, y;
    bool gap() const { return !(y == y) || !(x == x); }
};
using Trace = std::vector<PagePoint>;

/// The same picture from fewer points. Of every run of neighbors that fall into one column of width `cell`, the
/// first, lowest, highest and last remain, in their order: nothing a printer of that resolution shows is lost (the M4
/// aggregation of Jugel, Jerzak, Hackenbroich and Markl 2014). Where a curve that runs to and fro keeps
/// more than 20000 points so, segments between the same two square cells are drawn once, with cells as coarse as
/// needed. Gaps stay.
Trace decimate_line(const Trace& trace, double cell);

/// Markers that would print on top of one another (same square cell) are drawn once.
Trace decimate_points(const Trace& trace, double cell);

/// Band between two edges over the same x (first lower, second upper): per column the lowest and the highest.
std::pair<Trace, Trace> decimate_band(const Trace& lower, const Trace& upper, double cell);

}  // namespace dynlab::inline figures
