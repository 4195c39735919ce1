#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Discrete Fourier transform X_k = sum_n x_n exp(-2 pi i k n/N), k = 0..N-1, of any length: lengths with a large prime
/// factor go through a convolution (Bluestein 1970), so that none is slow. Nothing for no samples.
ComplexVector fourier_transform(const VectorView& x);

}  // namespace dynlab::inline numerics
