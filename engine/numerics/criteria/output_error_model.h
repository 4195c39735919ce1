#pragma once
#include "numerics/linalg/types.h"

namespace dynlab::inline numerics {

/// A model whose output depends smoothly on parameters: what an output-error method minimises over. Implemented by
/// each structure (process models, transfer functions); the search below knows nothing else of it.
class OutputErrorModel {
  public:
    virtual ~OutputErrorModel() = default;

    virtual Index parameter_count() const = 0;
    /// Closed bounds of each parameter (infinite when free); the search never evaluates outside them.
    virtual const Vector& lower() const = 0;
    virtual const Vector& upper() const = 0;
    /// Simulated output (N) and, when wanted, its derivatives with respect to the parameters (N x d).
    virtual void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const = 0;
};

}  // namespace dynlab::inline numerics
