#pragma once
#include "numerics/criteria/output_error_model.h"
#include "numerics/criteria/rational_basis.h"
#include "numerics/models/frequency_data.h"
#include "numerics/models/transfer_structure.h"

namespace dynlab::inline numerics {

/// The frequency response of a continuous-time model B/F exp(-Td s) as a function of [q (Td)], q those of a
/// RationalBasis, for the output-error search: the rows are the real and then the imaginary parts at the K frequencies,
/// weighted so that their errors have variance one if `data` contain variances. The response and its sensitivities are
/// exact for the input's behavior between samples. TIMES ARE COUNTED IN time_unit() HERE, one over the geometric mean
/// of the lowest and the highest frequency, so that numbers stay near one; theta() leads back to seconds and rad/s.
class FrequencyOutput : public OutputErrorModel {
  public:
    /// The basis suits a model near `start` = [a_1 .. a_n b_0 .. b_m], in time units. `least_delay` and `largest_delay`
    /// (s) bound a free delay. Throws InvalidArgument as check_frequency_data(), and for other than one channel or
    /// too few frequencies.
    FrequencyOutput(const FrequencyData& data, const TransferStructure& structure, const Vector& start,
                    double least_delay = 0, double largest_delay = 0);

    /// Not finite where a pole lies on a frequency of the data, instead of failing there; with keep_stable() also where
    /// one lies to the right of the imaginary axis.
    void simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const override;
    void keep_stable() { stable_ = true; }

    Vector target() const;                              ///< the measured response in the same rows
    Vector stacked(const ComplexVector& values) const;  ///< any response in the same rows
    /// [q (Td)] of coefficients and a delay in time units.
    Vector parameters(const VectorView& coefficients, double delay) const;
    Vector coefficients(const VectorView& parameters) const;  ///< in time units, without the delay
    /// Coefficients (and delay) in seconds and rad/s, and their derivatives with respect to the parameters, which are
    /// constant.
    Vector theta(const VectorView& parameters) const;
    Matrix theta_derivatives() const;
    double time_unit() const { return unit_; }        ///< s
    const Vector& seconds() const { return scale_; }  ///< factors that bring coefficients (and delay) to seconds

  private:
    void simulate_sines(const Vector& theta, ComplexVector& response, Eigen::MatrixXcd* derivatives) const;
    void simulate_held(const Vector& theta, ComplexVector& response, Eigen::MatrixXcd* derivatives) const;

    FrequencyData data_;
    bool free_delay_, stable_ = false;
    Index poles_, zeros_;
    double unit_, delay_;  // s; the fixed delay in time units
    ComplexVector s_;      // in 1/time unit
    Vector weights_;       // of each frequency's real and imaginary part
    RationalBasis basis_;
    Vector scale_;  // from time units to seconds
};

/// 1/sqrt(variance/2), or ones where it is not known: what the real and imaginary parts are weighted with.
Vector response_weights(const FrequencyData& data);
/// One over the geometric mean of the lowest and the highest frequency, s.
double frequency_time_unit(const FrequencyData& data);

}  // namespace dynlab::inline numerics
