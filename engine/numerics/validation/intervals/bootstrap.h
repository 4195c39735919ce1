#pragma once
#include <cstdint>
#include <functional>

#include "numerics/validation/intervals/refitted_output.h"

namespace dynlab::inline numerics {

enum class BootstrapKind {
    kResidual,    ///< "residual": the errors that the model left, drawn with replacement
    kParametric,  ///< "parametric": normal errors of the estimated variance, colored where those left are
};

struct BootstrapOptions {
    int runs = 500;
    BootstrapKind kind = BootstrapKind::kResidual;
    std::uint32_t seed = 1;
    double confidence = 0.95;                             ///< of the intervals
    int threads = 0;                                      ///< all cores when 0
    std::function<void(std::size_t done)> progress = {};  ///< runs done; called by one thread at a time
    std::function<bool()> cancel = {};                    ///< asked before every run

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// Of the parameters, and behind them of what follows from a model: the gain at rest ("gain"), time constants of real
/// poles in falling order ("T1", ..) and of pairs in rising order natural frequency and damping ("w1", "zeta1", ..;
/// rad/s).
struct Bootstrap {
    std::vector<std::string> names;
    Vector estimate;       ///< of the model itself, refitted to the data
    Matrix values;         ///< runs x names; NaN where a run was not fitted, or has other poles than the model
    Vector mean, std;      ///< over the runs
    Vector low, high;      ///< of the intervals: quantiles of the values
    Index parameters = 0;  ///< of the names, the first ones
    int failed = 0;        ///< runs without a fit
    bool canceled = false;
    std::vector<Message> warnings;  ///< whole sentences
    Message message;
};

/// The distribution of estimates under repetition of the experiment: the simulated output gets new errors `runs` times,
/// and the model is fitted to each of these data sets again, from its parameters. Residual: the residuals of the fit,
/// without their mean and enlarged by sqrt(N/(N - d)), d all estimated values. Parametric: normal errors of that
/// variance; if the residuals are not white, colored by their autoregression. Run k has the random stream of seed + k,
/// for any number of threads. Intervals are percentile intervals: they need no normal errors and follow the curvature
/// that a covariance neglects. Residual errors count as white; if they are not, a warning says so. Throws
/// InvalidArgument as RefittedOutput, for bad options, and if every run failed. Reference: Efron and Tibshirani (1993),
/// An Introduction to the Bootstrap, chapters 6, 9 and 13.
Bootstrap bootstrap(const RefittedOutput& model, const BootstrapOptions& options = {});

}  // namespace dynlab::inline numerics
