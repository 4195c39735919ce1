#pragma once
#include <optional>

#include "numerics/fit/fit.h"

namespace dynlab::inline numerics {

struct SvfOptions {
    double lambda = 0;         ///< rad/s, cutoff frequency of the filter; must be given: a bit above the bandwidth
    Hold hold_y = Hold::kFoh;  ///< how the output behaves between its samples inside the filter
    std::optional<double>
        beta;  ///< numerator of the Poisson moment functionals' (beta/(s + lambda))^n; default: lambda

    /// Throws InvalidArgument naming the option.
    void validate() const;
};

/// Least squares on state-variable filtered signals, for the CARX structure A(p) y = sum_j B_j(p) u_j(t - delay) + e:
/// with signals filtered by 1/(p + lambda)^n (lsgpmf: by (beta/(p + lambda))^n, which gives the same theta),
///     minimize sum_k (p^n y_f - phi' theta)^2,  phi = [-p^(n-1) y_f .. -y_f, p^m u_f .. u_f].
/// Filters are exact, from rest; inputs follow the data's hold; delays are fixed and of any size. Noise on the output
/// biases the estimate: see ivsvf, srivc. Standard errors are those of a white equation error, which the filters color:
/// see color_covariance. All inputs of an output share a denominator (kPerOutput or kCommon). Memory does not grow with
/// the length of the data. lssvf does not compute the fit of the simulation (measure_simulation does). Throws
/// InvalidArgument for unsuitable data (check_transfer_data), denominators per channel with several inputs, or free
/// delays. References: Young (1981); Garnier and Wang (2008), section 1.3.
Fit lssvf(const IdData& data, const TransferStructure& structure, const SvfOptions& options);

/// Throws InvalidArgument for a structure that is no CARX equation with fixed delays.
void check_carx(const char* method, const TransferStructure& structure);

/// Standard errors of more samples would take far longer than the estimate.
inline constexpr Index kMaxColoredSamples = 200'000;

/// Replaces the covariance of an estimate by lssvf or, with `instruments`, by ivsvf. The estimate takes the equation
/// error as white; the new covariance takes its color into account (criteria/estimating_terms.h,
/// statistics/robust_covariance.h). The filters color the error even if the noise is white. The computation takes ten
/// times as long as the estimate. For more than kMaxColoredSamples samples the covariance is not replaced, and a
/// warning says so. data and options: as for the estimate.
void color_covariance(Fit& fit, const IdData& data, const SvfOptions& options, bool instruments);

/// Adds the warning that lambda lies far from the model's band, with the usual choice.
void warn_of_cutoff(Fit& estimate, double lambda);

}  // namespace dynlab::inline numerics
