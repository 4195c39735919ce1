#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline figures {

/// A drawing of a process whose parts follow signals. Lengths in cm from the lower left corner, y upwards.

/// A part slides by (x, y) per unit of its signal, or turns about (x, y), to the left by `by` radians per unit. The
/// drawing shows it at the value `drawn_at`.
struct PlantPart {
    std::string signal, unit;  ///< which it follows, in which unit
    int on = -1;               ///< the part that carries it, before it in the list; -1 for none
    bool turns = false;
    double x = 0, y = 0, by = 1, drawn_at = 0;
};

/// A line, or an area without a rim.
struct PlantShape {
    std::vector<double> x, y;
    std::vector<int> part;  ///< that each point moves with; -1 for none
    bool filled = false;
    double look = 0;  ///< width in TeX points; of an area its shade, from 0 (white) to 1 (black)

    bool moves() const;
};

struct PlantDrawing {
    double width = 0, height = 0;
    std::vector<PlantPart> parts;
    std::vector<PlantShape> pieces;

    /// Throws InvalidArgument for pieces whose lists differ in length or parts that are not there.
    void validate() const;
    /// The piece at its place for these values of the parts' signals, one per part.
    PlantShape placed(const PlantShape& piece, const Vector& values) const;
};

/// A plant next to the data that it follows, in one figure: the panel `picture` shows the plant at some instants, and
/// the panel 1 + k after it the signal of part k over time in seconds, first as measured, then as simulated, if both
/// exist.
struct Motion {
    PlantDrawing plant;
    std::size_t picture = 0;
    bool measured = true, simulated = true;
};

}  // namespace dynlab::inline figures
