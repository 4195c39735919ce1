#pragma once
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// e(k) + a_1 e(k-1) + ... + a_p e(k-p) = w(k), w white: what makes a colored error white. The roots of the polynomial
/// lie inside the unit circle.
struct Autoregression {
    std::vector<Vector> predictors;  ///< of the orders 0 to p: a_1 first; the last one is the model
    double variance = 0;             ///< of w, in squared units of e

    Index order() const { return static_cast<Index>(predictors.size()) - 1; }
    Vector filter() const;  ///< 1 a_1 .. a_p
};

/// Which order up to the highest is taken: the one with the smallest corrected information criterion AICc (Hurvich and
/// Tsai 1989), N log(variance) + 2 p N/(N - p - 2), where a term too few does harm; the one with the smallest BIC,
/// N log(variance) + p log N, where a term too many does; or the highest.
enum class AutoregressiveOrder { kAicc, kBic, kMaxInteger };

/// The autoregression of `e` by Burg's method (Kay 1988, section 7.3). The mean is not subtracted. `lengths` (summing
/// to the number of values) are the lengths of uninterrupted parts. Orders are at most `max_order`, selected orders at
/// most a quarter of the longest part, and they end when nothing is left to predict. A signal that is zero has order 0.
/// Throws InvalidArgument for lengths that do not add up and for values that are not finite.
Autoregression fit_autoregression(const VectorView& e, const std::vector<Index>& lengths, Index max_order,
                                  AutoregressiveOrder choice = AutoregressiveOrder::kAicc);

/// The highest order worth trying for N values: 20 log10 N, enough for the sum of a slow and of a white noise.
Index highest_autoregressive_order(Index N);

/// x(k) + a_1 x(k-1) + ... + a_p x(k-p) of an uninterrupted signal for all k whose past is in it: x.size() - p values,
/// of p samples at least.
Vector filtered_past(const Autoregression& model, const VectorView& x);

/// w of all uninterrupted parts. The first p values are the errors of the lower orders' predictions, larger and as
/// white: they contain the effect of the unobserved past.
Vector whitened(const Autoregression& model, const VectorView& e, const std::vector<Index>& lengths);

/// Column by column the transposed operation of coloring w into e, from the end of each part to its start: x(k) with
/// z'e = x'w for every e.
Matrix colored_backwards(const Autoregression& model, const MatrixView& Z, const std::vector<Index>& lengths);

}  // namespace dynlab::inline numerics
