#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figures/figure.h"

namespace dynlab::inline figures {

/// A number written beside an axis.
struct Tick {
    double value;
    std::string label;
};

/// One axis of a panel: its range, and where on its length a value lies.
struct Axis {
    double low = 0, high = 1;
    bool log = false;
    std::vector<Tick> ticks;
    std::vector<double> minor;  ///< short ticks without a number
    int exponent = 0;           ///< multiply the labels by 10^exponent, shown at the axis' end

    double position(double value) const;     ///< 0 at low, 1 at high; NaN for what the axis cannot show
    double widest_label(double size) const;  ///< cm at `size` points
};

/// Smallest and largest value that an axis must show; nothing recorded gives 0..1 (1..10 when logarithmic).
class Extent {
  public:
    explicit Extent(bool log) : log_(log) {}
    void include(double value);
    void include(const Vector& values);
    /// With `margin` of the length free at both ends. A single value is given room on both sides.
    std::pair<double, double> padded(double margin) const;

  private:
    bool log_;
    std::optional<double> low_, high_;
};

/// The same range, or, where its ends are too large, too small or too close for computing with them, one near it:
/// within 1e305 (for a logarithmic axis 1e-305 to 1e305), and longer than nothing.
std::pair<double, double> usable_range(std::pair<double, double> range, bool log);

/// Chooses about `count` ticks at round numbers (1, 2 or 5 times a power of ten, or multiples of `step`). Large and
/// small magnitudes share a power of ten; logarithmic axes number decades, and digits between where these are fewer
/// than four.
Axis make_axis(std::pair<double, double> range, bool log, double count, std::optional<double> step = {});

}  // namespace dynlab::inline figures
