#pragma once
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// e(k) + a_1 e(k-1) + ... + a_p e(k-p) = w(k), w white: what makes a coloured error white. The roots of the polynomial
/// lie inside the unit circle.
struct Autoregression {
    std::vector<Vector> predictors;  ///< of the orders 0 to p: a_1 first; the last one is the model
    double variance = 0;             ///< of w, in squared units of e

    Index order() const { return static_cast<Index>(predictors.size()) - 1; }
};

/// The autoregression of `e` by Burg's method (Kay 1988, section 7.3), of the order up to `most` with the smallest
/// corrected information criterion AICc (Hurvich and Tsai 1989), N log(variance) + 2 p N/(N - p - 2). No mean is taken
/// off. `lengths` (summing to the number of values) tells uninterrupted records apart. Orders stay below a quarter of
/// the longest record. A signal that is zero has order 0. Throws InvalidArgument for lengths that do not add up and for
/// values that are not finite.
Autoregression fit_autoregression(const VectorView& e, const std::vector<Index>& lengths, Index most);

/// The highest order worth trying for N values: 20 log10 N, enough for the sum of a slow and of a white noise.
Index highest_autoregressive_order(Index N);

/// w of the records. The first p values are the errors of the lower orders' predictions, larger and as white: what the
/// unseen past has left behind is in them.
Vector whitened(const Autoregression& model, const VectorView& e, const std::vector<Index>& lengths);

/// Column by column the transposed operation of colouring w into e, from the end of each record to its start: x(k) with
/// z'e = x'w for every e.
Matrix coloured_backwards(const Autoregression& model, const MatrixView& Z, const std::vector<Index>& lengths);

}  // namespace dynlab::inline numerics
