#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/transfer_estimate.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

void TransferOptions::validate() const {
    if (lambda && (!(*lambda > 0) || !std::isfinite(*lambda)))
        throw InvalidArgument("lambda must be a positive number of rad/s, and is " + number_text(*lambda));
    if (!(TdMin >= 0) || !std::isfinite(TdMin))
        throw InvalidArgument("TdMin must not be negative, and is " + number_text(TdMin));
    if (TdMax && (!(*TdMax >= TdMin) || !std::isfinite(*TdMax)))
        throw InvalidArgument("TdMax must be at least TdMin = " + number_text(TdMin) + ", and is " +
                              number_text(*TdMax));
    if (NumTd < 1) throw InvalidArgument("NumTd must be at least 1, and is " + std::to_string(NumTd));
    if (MaxIter < 0) throw InvalidArgument("MaxIter must not be negative, and is " + std::to_string(MaxIter));
    if (!(Tol > 0) || !std::isfinite(Tol)) throw InvalidArgument("Tol must be positive, and is " + number_text(Tol));
}

}  // namespace dynlab::inline numerics
