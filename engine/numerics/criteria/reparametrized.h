#pragma once
#include <functional>

#include "numerics/criteria/output_error_model.h"

namespace dynlab::inline numerics {

/// An output-error model in other parameters: with theta leading smoothly to the inner model's parameters q(theta), its
/// output is that of q(theta), and by the chain rule its sensitivities are those of the inner model times dq/dtheta.
class Reparametrized : public OutputErrorModel {
  public:
    struct Point {
        Vector inner;        ///< q(theta)
        Matrix derivatives;  ///< dq/dtheta, inner parameters x parameters
    };
    using Map = std::function<Point(const Vector& theta)>;

    /// Keeps a reference to `inner`. The bounds, of equal length, are those of theta.
    Reparametrized(const OutputErrorModel& inner, Map map, Vector lower, Vector upper);

    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;
    OutputErrorProducts products(const Vector& theta, const VectorView& y) const override;
    Index masked_rows() const override { return inner_.masked_rows(); }
    bool products_are_cheap() const override { return inner_.products_are_cheap(); }

  private:
    const OutputErrorModel& inner_;
    Map map_;
};

}  // namespace dynlab::inline numerics
