#include "figures/moving_plant.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline figures {

bool PlantShape::moves() const {
    return std::any_of(part.begin(), part.end(), [](int one) { return one >= 0; });
}

void PlantDrawing::validate() const {
    const int count = static_cast<int>(parts.size());
    for (int i = 0; i < count; ++i)
        if (const int on = parts[static_cast<std::size_t>(i)].on; on < -1 || on >= i)
            throw InvalidArgument("a part that carries another part of the drawing must be defined before that part");
    for (const PlantShape& piece : pieces) {
        if (piece.x.size() != piece.y.size() || piece.x.size() != piece.part.size())
            throw InvalidArgument(
                "a shape of the drawing needs equal numbers of x coordinates, y coordinates and parts");
        for (const int part : piece.part)
            if (part < -1 || part >= count)
                throw InvalidArgument("a shape of the drawing belongs to a part that does not exist");
    }
}

PlantShape PlantDrawing::placed(const PlantShape& piece, const Vector& values) const {
    PlantShape result = piece;
    for (std::size_t i = 0; i < piece.x.size(); ++i) {
        double &x = result.x[i], &y = result.y[i];
        for (int k = piece.part[i]; k >= 0; k = parts[static_cast<std::size_t>(k)].on) {
            const PlantPart& part = parts[static_cast<std::size_t>(k)];
            const double moved = values[k] - part.drawn_at;
            if (part.turns) {
                const double c = std::cos(part.by * moved), s = std::sin(part.by * moved);
                const double dx = x - part.x, dy = y - part.y;
                x = part.x + c * dx - s * dy, y = part.y + s * dx + c * dy;
            } else {
                x += moved * part.x, y += moved * part.y;
            }
        }
    }
    return result;
}

}  // namespace dynlab::inline figures
