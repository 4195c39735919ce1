#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/message.h"
#include "numerics/models/process_model.h"
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

/// A continuous-time model with the covariance of theta = [a_1..a_n b_0..b_m], or of [a_1..a_n b_0..b_m delay]. What
/// follows is first-order (delta-method) uncertainty with exact derivatives: good while standard errors are small
/// against the values they belong to.
struct UncertainModel {
    TransferFunction G;
    Matrix covariance;  ///< d x d, d = n + m + 1 or n + m + 2

    UncertainModel() = default;
    /// Throws InvalidArgument for a discrete or improper G or a covariance of another size.
    UncertainModel(TransferFunction G, Matrix covariance);
    /// From the covariance of a process model's parameters. Throws InvalidArgument for a size that does not fit.
    UncertainModel(const ProcessModel& process, const MatrixView& covariance);
    bool free_delay() const { return covariance.rows() == G.pole_count() + G.num().size() + 1; }
};

/// Standard deviations of the step response at `t` (s, not negative, strictly increasing):
///     dy/da_i = -p^(n-i) B/A^2 1,  dy/db_j = p^(m-j)/A 1,  dy/d delay = -(impulse response).
Vector step_response_std(const UncertainModel& model, const VectorView& t);

/// Standard deviations of magnitude (dB) and phase (degrees) at the frequencies `w` (rad/s), from the derivatives of
/// ln G: d/da_i = -s^(n-i)/A, d/db_j = s^(m-j)/B, d/d delay = -s.
struct FrequencyUncertainty {
    Vector magnitude_std, phase_std;
};
FrequencyUncertainty frequency_response_std(const UncertainModel& model, const VectorView& w);

/// A pole or zero with the covariance of its real and imaginary part, from dp/da_i = -p^(n-i)/A'(p).
struct RootUncertainty {
    Complex root;
    Eigen::Matrix2d covariance;
    /// Another root lies within three standard deviations of their difference: first order says little.
    bool near_multiple = false;
};
std::vector<RootUncertainty> pole_uncertainty(const UncertainModel& model);
std::vector<RootUncertainty> zero_uncertainty(const UncertainModel& model);

/// `count` points around the ellipse that holds the root with probability `confidence`, the last equal to the first;
/// for a real root the two ends of its interval. One column each for real and imaginary parts.
Matrix confidence_region(const RootUncertainty& root, double confidence, Index count = 73);

/// One row per pole, in the order of damping(G).
struct ModeUncertainty {
    PoleDescription mode;
    double natural_frequency_std, damping_ratio_std, time_constant_std;  ///< NaN where the value is not finite
};
struct ModelUncertainty {
    double gain = 0, gain_std = 0;  ///< steady state; NaN with an integrator
    std::vector<ModeUncertainty> modes;
    std::vector<Message> warnings;  ///< whole sentences
};
ModelUncertainty describe_uncertainty(const UncertainModel& model);

}  // namespace dynlab::inline numerics
