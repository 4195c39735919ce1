#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline figures {

/// A drawing of a process whose parts follow signals. Lengths in cm from the lower left corner, y upwards.

/// A part slides by (x, y) per unit of its signal, or turns about (x, y), to the left by `by` radians per unit. It is
/// drawn as it stands at the value `drawn_at`.
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
    /// The piece where it stands while the parts' signals have these values, one a part.
    PlantShape placed(const PlantShape& piece, const Vector& values) const;
};

/// A rig beside the records that it follows, in one figure: the panel `picture` shows it at some instants, and the
/// panel behind it by 1 + k the signal of part k over time in seconds, first as measured, then as simulated, where
/// there are both.
struct Motion {
    PlantDrawing plant;
    std::size_t picture = 0;
    bool measured = true, simulated = true;
};

}  // namespace dynlab::inline figures
