#pragma once
#include <functional>

#include "numerics/validation/intervals/refitted_output.h"

namespace dynlab::inline numerics {

struct ProfileOptions {
    double confidence = 0.95;                          ///< of the interval
    int points = 41;                                   ///< of the grid
    std::optional<std::pair<double, double>> range{};  ///< of the grid; default: four standard errors about the
                                                       ///< estimate, and more if the interval is not over there
    std::function<bool()> cancel = {};                 ///< asked before every fit

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// How the fit gets worse as one parameter is moved away from its estimate.
struct Profile {
    std::string name;
    double estimate = 0, std = 0;     ///< those of the fit to the data
    Vector grid, rise;                ///< N ln(S/S_min) with all other parameters fitted again, S the sum of squares
    double level = 0;                 ///< the chi-squared quantile that bounds the interval
    std::optional<double> low, high;  ///< the interval; nothing where the grid ends inside it
    bool canceled = false;
    std::vector<Message> warnings;  ///< whole sentences
    Message message;
};

/// Profile likelihood of a parameter: all others, initial values and offsets are fitted again for each value on a grid,
/// and the interval ends where N ln(S/S_min) passes the chi-squared quantile with one degree of freedom. Nothing is
/// assumed of the loss's shape, where standard errors take it for a parabola. A delay's loss has corners at the samples
/// where inputs are held: these are on the grid. Each value is reached from its neighbor's solution, outwards from the
/// estimate and back, and the crossings are found by bisection. Errors count as white and normal; where they are not
/// white a warning says so. Throws InvalidArgument as RefittedOutput, for bad options, and for a parameter that the
/// model has not. Reference: Bates and Watts (1988), Nonlinear Regression Analysis, section 6.1; Raue et al. (2009),
/// Bioinformatics 25, 1923-1929.
Profile profile_likelihood(const RefittedOutput& model, const std::string& name, const ProfileOptions& options = {});

}  // namespace dynlab::inline numerics
