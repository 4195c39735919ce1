#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// The triangular factor R of a tall matrix M = QR, made while the rows of M come in, which are not kept: R'R = M'M,
/// and a least-squares problem over the columns of M is one over those of R. Householder reflections, block by block,
/// so that no digits are lost as they are with M'M.
class TriangularFactor {
  public:
    explicit TriangularFactor(Index columns);
    void add(const MatrixView& rows);
    const Matrix& R() const { return R_; }  ///< columns x columns, zero below the diagonal

  private:
    Matrix R_, stack_;
};

}  // namespace dynlab::inline numerics
