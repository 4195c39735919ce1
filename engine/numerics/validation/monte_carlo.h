#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"
#include "numerics/simulation/closed_loop.h"

namespace dynlab::inline numerics {

/// What one estimation gives to a study.
struct MonteCarloEstimate {
    Vector theta, std = {};  ///< std is empty when the method gives none
    std::vector<std::string> names =
        {};                  ///< of theta; when empty the system's own if the number fits, theta1 .. otherwise
    bool continuous = true;  ///< a discrete-time model's parameters are not the system's
    bool converged = true;
};

struct MonteCarloMethod {
    std::string label;
    std::function<MonteCarloEstimate(const IdData&)> estimate;
    bool concurrent = true;  ///< may be called by several threads at once; otherwise by the caller's thread only
};

/// What one run of one method gave.
struct MonteCarloOutcome {
    MonteCarloEstimate estimate;
    Message failure;    ///< why it gave none; empty when it did
    bool done = false;  ///< false: the study was stopped before
};

/// One run: of every method, in their order.
struct MonteCarloRun {
    std::vector<MonteCarloOutcome> outcomes;
};

/// Makes the runs `first`, `first` + 1, ..., `count` of them.
using SomeRuns = std::function<std::vector<MonteCarloRun>(std::size_t first, std::size_t count)>;

/// A repeated experiment: the noise-free output x of `system` for the input u, plus white noise. Run k = 0, 1, ... has
/// y = x + sigma randn with the random stream of seed + k (signals/random.h), for any number of threads. With a
/// controller, u is the reference of a loop, whose data contain input, output and reference; the noise passes through
/// the loop.
struct MonteCarloStudy {
    TransferFunction system;      ///< continuous time; the truth
    Vector u;                     ///< N samples; of the reference with a controller
    double Ts = 0;                ///< s between samples
    Hold hold = Hold::kZoh;       ///< of u
    std::optional<double> sigma;  ///< standard deviation of the noise; give this ...
    std::optional<double> snr;    ///< ... or 20 log10(std x/std noise) in dB
    int runs = 100;
    std::uint32_t seed = 1;
    int threads = 0;                                      ///< all cores when 0; never more than there are
    std::function<void(std::size_t done)> progress = {};  ///< estimations done; called by one thread at a time
    std::function<bool()> cancel = {};                    ///< asked before every run, by one thread at a time
    std::optional<LoopController> controller = {};        ///< of a closed loop
    /// Gives all runs in their order, having had some of them made by the function that it is given. A run depends on
    /// its number alone, so that any parts make the same whole. All are made at once without.
    std::function<std::vector<MonteCarloRun>(std::size_t runs, const SomeRuns& some)> in_parts = {};

    /// Throws InvalidArgument naming the field.
    void validate() const;
};

/// What happened to one method. Statistics are over the runs that gave an estimate, n of them.
struct MonteCarloResult {
    std::string label;
    std::vector<std::string> names;          ///< d parameters
    Matrix theta, std;                       ///< runs x d; NaN where a run gave nothing, or no standard errors
    Vector truth;                            ///< d; empty when the method's structure does not hold the system
    Vector mean, spread, median, low, high;  ///< d; spread: standard deviation (n - 1); low, high: extremes
    Vector reported;                         ///< d, mean of the reported standard errors; NaN without
    Vector bias;                             ///< d, mean - truth; empty without truth
    Matrix bound;           ///< d x d, Cramer-Rao bound of the covariance; empty without truth and in a loop
    int estimated = 0;      ///< runs that gave an estimate
    int failed = 0;         ///< runs that threw or gave something not finite
    int not_converged = 0;  ///< of the estimated ones
    Message first_failure;  ///< what the first failed run said

    /// Standard deviations that no unbiased method can beat; empty without truth.
    Vector least_spread() const;
};

struct MonteCarlo {
    std::vector<MonteCarloResult> results;  ///< in the order of the methods
    double sigma = 0, snr = 0;              ///< snr infinite without noise
    int runs = 0;
    bool canceled = false;  ///< runs that had not begun count neither as estimated nor as failed
};

/// Runs every method on the data of every run, on several cores. The result contains true values and the bound for
/// methods whose parameters are the system's (validation/cramer_rao.h). Memory: one data set per thread, runs x d per
/// method. Throws InvalidArgument for an unsuitable study, for methods with equal labels, and if every run of a method
/// failed.
MonteCarlo monte_carlo(const MonteCarloStudy& study, const std::vector<MonteCarloMethod>& methods);

}  // namespace dynlab::inline numerics
