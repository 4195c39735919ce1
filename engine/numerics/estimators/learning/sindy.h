#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "numerics/criteria/function_library.h"
#include "numerics/fit/fit.h"
#include "numerics/models/free_run.h"

namespace dynlab::inline numerics {

/// dx/dt = Xi' theta(x, u), y = x: the outputs are the states.
class SindyModel : public FreeRunModel {
  public:
    /// `coefficients`: functions x states. `largest`: of the states in magnitude, in their units.
    SindyModel(FunctionLibrary library, Matrix coefficients, Index inputs, Vector largest);

    Index input_count() const override { return inputs_; }
    Index output_count() const override { return coefficients_.cols(); }
    /// `x0`: the states at the first sample; by default the first outputs of the data. The integration is adaptive from
    /// sample to sample, with the data's hold. A run is lost if a state exceeds 1e3 times its largest value in the
    /// estimation data.
    FreeRun free_run(const IdData& data, std::size_t experiment, const VectorView& x0) const override;

    const FunctionLibrary& library() const { return library_; }
    const Matrix& coefficients() const { return coefficients_; }
    Vector rate(const VectorView& x, const VectorView& u) const;  ///< dx/dt

  private:
    FunctionLibrary library_;
    Matrix coefficients_;
    Index inputs_;
    Vector largest_;
};

struct SindyOptions {
    /// A term goes when the root mean square of what it alone explains is less than this share of that of the rate.
    double threshold = 0.02;
    bool weak = false;            ///< integrals against test functions instead of derivatives
    int window = 5;               ///< samples (odd) over which a polynomial gives state and derivative
    std::optional<double> width;  ///< time unit; half the length of a test function; default: computed from the data
    std::function<bool()> cancel = {};  ///< asked before every experiment and state; then it throws

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// `fit.theta` holds the coefficients that stayed, state by state, and `fit.names` "x2: x1*x3".
struct SindyFit {
    Fit fit;
    std::shared_ptr<const SindyModel> model;
    std::vector<std::string> equations;  ///< "dx1/dt = -10*x1 + 10*x2", one for each state
    std::optional<double> width;         ///< that of the test functions, time unit
};

/// Sparse identification of nonlinear dynamics: dx/dt = Xi' theta(x, u) with few terms of a library of functions; the
/// outputs of the data are the states. The first solution is least squares over all functions. Then, state by state,
/// sindy removes the function with the smallest contribution and solves again, while this contribution is below the
/// threshold (sequential thresholding). The contribution has no unit, and similar functions cause no problem.
/// Equations:
/// * derivatives (default): state and derivative from a polynomial of degree 4 (at most) over the `window` around each
///   sample; where a held input jumps within the window the sample is left out;
/// * weak: for bump functions phi of compact support, -int phi' x dt = int phi theta(x, u) dt by the trapezoidal rule,
///   whose error is small because phi vanishes smoothly at its ends. No derivative of the data is taken, so noise is
///   averaged; held inputs are integrated piece by piece.
/// The threshold has no unit, so that the result does not depend on the units of the data. `fit_percent` is that of the
/// free run from the first sample (-infinity, with a warning, if the run diverges). There are no standard errors,
/// because the errors of the equations are correlated. Data: up to 8 outputs (states), any number of inputs (also none)
/// and experiments, regular or irregular sampling. Throws InvalidArgument for other data or options, too few samples,
/// and a library of another size or with values that are not finite. References: Brunton, Proctor and Kutz (2016), PNAS
/// 113, 3932-3937; Messenger and Bortz (2021), Multiscale Modeling and Simulation 19, 1474-1497.
SindyFit sindy(const IdData& data, const FunctionLibrary& library, const SindyOptions& options = {});

}  // namespace dynlab::inline numerics
