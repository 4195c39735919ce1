#pragma once
#include <string>
#include <vector>

#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// All products of powers of `variables` variables up to a total degree: 1, then those of degree 1 in the order of the
/// variables, then z1^2, z1 z2, ..., of degree 2, and so on.
class Monomials {
  public:
    /// Throws InvalidArgument that begins with `caller` for a degree outside 0 to 9, or more than 2000 monomials.
    Monomials(const std::string& caller, Index variables, int degree);
    Monomials() = default;

    Index count() const { return static_cast<Index>(factors_.size()); }
    int degree(Index monomial) const { return static_cast<int>(factors_[static_cast<std::size_t>(monomial)].size()); }

    /// One monomial at the values z, and all of them for the rows of Z (N x variables), N x count.
    double value(Index monomial, const VectorView& z) const;
    Matrix values(const MatrixView& Z) const;

    /// "1", "y1(k-1)", "x1^2*u1": the monomial in the variables' names.
    std::string text(Index monomial, const std::vector<std::string>& names) const;

  private:
    std::vector<std::vector<Index>> factors_;  // variables, in order, as often as their power says
    std::vector<Index> rest_;                  // the monomial without its first factor
};

}  // namespace dynlab::inline numerics
