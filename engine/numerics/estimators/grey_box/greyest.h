#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "numerics/fit/fit.h"
#include "numerics/models/grey_model.h"
#include "numerics/simulation/grey_simulation.h"

namespace dynlab::inline numerics {

/// Where a grey-box model starts from, in each experiment.
enum class GreyStart {
    kModel,     ///< "model": as its x0 says
    kZero,      ///< "zero": all states zero
    kEstimate,  ///< "estimate": all states are estimated, separately for each experiment
};
/// Throws InvalidArgument that lists the words.
GreyStart parse_grey_start(const std::string& text);

struct GreyOptions {
    GreyStart initial_state = GreyStart::kModel;
    int max_iterations = 100;
    double tolerance = 1e-6;           ///< on the largest relative parameter change, made or still to come
    double relative_tolerance = 1e-7;  ///< relative error of an integration step
    int starts = 1;                    ///< the model's own, then others between the bounds or about the start
    std::vector<std::map<std::string, double>> further_starts;  ///< parameters by name, the others as the model's
    Vector output_weights;         ///< of each output's errors; by their standard deviations when empty
    std::function<bool()> cancel;  ///< asked before every iteration

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// An estimated grey-box model. The fit's theta, names, std and covariance cover all parameters. The variance is zero
/// for fixed parameters, and infinite for those that the data do not determine.
struct GreyFit {
    GreyModel model;  ///< with the estimates as its parameters' starts
    Fit fit;
    GreyStart start = GreyStart::kModel;
    Matrix intervals;                     ///< d x 2: ends of the 95 % confidence intervals
    Matrix initial_states;                ///< n x experiments, at the first samples
    Matrix initial_std;                   ///< of the estimated ones, zero of others
    Vector singular_values;               ///< of the scaled sensitivities, falling
    double relative_tolerance = 1e-7;     ///< relative error of an integration step
    std::vector<Matrix> outputs, states;  ///< simulated, per experiment: N x ny and N x n
};

/// Parameters of ordinary differential equations, dx/dt = f(t, x, u; p), y_k = h(t_k, x, u; p) + e_k:
///     minimize sum over experiments, samples and outputs of (y - simulated y)^2/variance of the output's errors
/// by Levenberg-Marquardt within the bounds, with sensitivities by the variational equations; the variances are
/// reestimated until they settle. Efficient for white Gaussian e, independent among outputs. Several starts are
/// followed a little way, the best of them to the end. Where that leaves more than 0.01 % of the outputs' variation and
/// the errors follow each other (lag-one correlation above 0.5), fits to longer and longer beginnings of the data lead
/// to further ends, until two agree. Covariance: variance (J'J)^-1 at the end. Throws InvalidArgument for bad options
/// or bounds, data of other channels than the model, too few samples, and a simulation from the start values that
/// breaks down (it says when and which state). Reference: Ljung (1999), section 4.3; Bohlin (2006), Practical Grey-box
/// Process Identification.
GreyFit greyest(const IdData& data, const GreyModel& model, const GreyOptions& options = {});

/// A model without estimation, for simulation; its starts replace the estimates.
GreyFit unfitted_grey_box(const GreyModel& model);

/// Outputs of an estimate for other inputs (N x ny), from x(t_1) = `x0` or, where that is empty, from the initial state
/// of the first experiment it was estimated from. Throws InvalidArgument for sizes that do not fit and where the
/// simulation breaks down.
Matrix grey_response(const GreyFit& grey, const GreyInputs& inputs, const Vector& x0 = {});

}  // namespace dynlab::inline numerics
