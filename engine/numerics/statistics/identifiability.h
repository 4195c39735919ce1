#pragma once
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// Parameters, or combinations of them, that the data do not determine.
struct Ambiguity {
    std::vector<bool> parameters;    ///< those that are among them
    std::vector<Message> sentences;  ///< one on each, for users
};

/// Of the sensitivities J (N x d) of the outputs at `theta`: a column that is zero beside `spread` (the norm of what
/// the outputs vary) belongs to a parameter that has no say; a singular value of the others, each scaled to norm one,
/// below the square root of the rounding times the largest is a combination that leaves the outputs as they are
/// (Golub and Van Loan 2013, section 5.5). Nothing where J is not finite.
Ambiguity find_ambiguity(const MatrixView& J, const std::vector<std::string>& names, const VectorView& theta,
                         double spread);

}  // namespace dynlab::inline numerics
