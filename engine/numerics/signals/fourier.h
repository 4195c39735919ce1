#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Discrete Fourier transform X_k = sum_n x_n exp(-2 pi i k n/N), k = 0..N-1, of any length: lengths with a large prime
/// factor go through a convolution (Bluestein 1970), so that none is slow. Nothing for no samples.
ComplexVector fourier_transform(const VectorView& x);

/// Those of two signals of one length, for the price of one: they are the parts of the transform of x + i y that are
/// equal and opposite at opposite frequencies.
struct TransformPair {
    ComplexVector first, second;
};
TransformPair fourier_transforms(const VectorView& x, const VectorView& y);

}  // namespace dynlab::inline numerics
