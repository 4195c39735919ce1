#pragma once
#include <array>

namespace dynlab::inline numerics {

/// Pairs that are worked on together.
inline constexpr int kNormalPairs = 8;
using NormalPairs = std::array<double, kNormalPairs>;

/// Independent standard normals from uniforms in [0, 1) (Box and Muller 1958):
///     cosines = R cos(2 pi U2), sines = R sin(2 pi U2), R = sqrt(-2 ln(1 - U1)), to 5e-16 of R.
/// Written without calls of the mathematical library: several pairs at once, and the same on every machine.
void box_muller(const NormalPairs& u1, const NormalPairs& u2, NormalPairs& cosines, NormalPairs& sines);

}  // namespace dynlab::inline numerics
