#include "numerics/criteria/frequency_output.h"

#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/simulation/sampled_response.h"

namespace dynlab::inline numerics {

namespace {

constexpr Complex kImaginary{0, 1};

/// Values of a polynomial at the points.
ComplexVector values_of(const VectorView& p, const ComplexVector& s) {
    ComplexVector values(s.size());
    for (Index k = 0; k < s.size(); ++k) values[k] = evaluate(p, s[k]);
    return values;
}

/// p s^shift in a row of `size` coefficients, the constant last.
Eigen::RowVectorXd shifted_row(const VectorView& p, Index shift, Index size) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size);
    row.segment(size - shift - p.size(), p.size()) = p.transpose();
    return row;
}

RationalBasis basis_near(const ComplexVector& s, const Vector& weights, const ComplexVector& response,
                         const Vector& start, Index poles, Index zeros) {
    const Vector F = values_of(monic(start.head(poles)), s).cwiseAbs();
    const Vector near = weights.cwiseQuotient(F.cwiseMax(1e-12 * F.maxCoeff()));
    return rational_basis(s, near.cwiseProduct(response.cwiseAbs()), near, poles, zeros);
}

}  // namespace

Vector response_weights(const FrequencyData& data) {
    if (data.variance.size() == 0) return Vector::Ones(data.w.size());
    return (0.5 * data.variance).cwiseSqrt().cwiseInverse();
}

double frequency_time_unit(const FrequencyData& data) {
    return 1 / std::sqrt(data.w[0] * data.w[data.w.size() - 1]);
}

FrequencyOutput::FrequencyOutput(const FrequencyData& data, const TransferStructure& structure, const Vector& start,
                                 double least_delay, double largest_delay)
    : data_(data), free_delay_(structure.free_delays) {
    check_frequency_data("frequency response", data);
    if (!structure.single_channel())
        throw InvalidArgument("a frequency response has one input and one output, but the model has {} and {}",
                              structure.inputs, structure.outputs);
    poles_ = structure.poles.front(), zeros_ = structure.channels.front().zeros;
    unit_ = frequency_time_unit(data);
    delay_ = structure.channels.front().delay / unit_;
    s_ = kImaginary * unit_ * data.w.cast<Complex>();
    weights_ = response_weights(data);
    basis_ = basis_near(s_, weights_, data.response, start, poles_, zeros_);
    const Index count = poles_ + zeros_ + 1 + (free_delay_ ? 1 : 0);
    set_free(count);
    scale_.resize(count);
    for (Index i = 0; i < poles_; ++i) scale_[i] = std::pow(unit_, -static_cast<double>(i + 1));
    for (Index j = 0; j <= zeros_; ++j) scale_[poles_ + j] = std::pow(unit_, -static_cast<double>(poles_ - zeros_ + j));
    if (!free_delay_) return;
    lower_[count - 1] = least_delay / unit_, upper_[count - 1] = largest_delay / unit_, scale_[count - 1] = unit_;
}

Vector FrequencyOutput::stacked(const ComplexVector& values) const {
    const Index K = values.size();
    Vector rows(2 * K);
    rows << weights_.cwiseProduct(values.real()), weights_.cwiseProduct(values.imag());
    return rows;
}

Vector FrequencyOutput::target() const {
    return stacked(data_.response);
}

Vector FrequencyOutput::parameters(const VectorView& coefficients, double delay) const {
    Vector all(parameter_count());
    all.head(poles_ + zeros_ + 1) = basis_.parameters(coefficients);
    if (free_delay_) all[all.size() - 1] = delay;
    return all;
}

Vector FrequencyOutput::coefficients(const VectorView& parameters) const {
    return basis_.coefficients(parameters.head(poles_ + zeros_ + 1));
}

Vector FrequencyOutput::theta(const VectorView& parameters) const {
    Vector all = parameters;
    all.head(poles_ + zeros_ + 1) = coefficients(parameters);
    return all.cwiseProduct(scale_);
}

Matrix FrequencyOutput::theta_derivatives() const {
    Matrix derivatives = Matrix::Identity(parameter_count(), parameter_count());
    derivatives.topLeftCorner(basis_.map.rows(), basis_.map.cols()) = basis_.map;
    return scale_.asDiagonal() * derivatives;
}

void FrequencyOutput::simulate_sines(const Vector& theta, ComplexVector& response,
                                     Eigen::MatrixXcd* derivatives) const {
    const Vector q = theta.head(poles_ + zeros_ + 1);
    const double delay = free_delay_ ? theta[theta.size() - 1] : delay_;
    const ComplexVector late = (-delay * s_).array().exp();
    const ComplexVector lateness = late.cwiseQuotient(basis_.denominator(q));
    response = basis_.numerator(q).cwiseProduct(lateness);
    if (derivatives == nullptr) return;
    derivatives->resize(s_.size(), parameter_count());
    const ComplexVector by_denominator = -response.cwiseQuotient(basis_.denominator(q));
    derivatives->leftCols(poles_) = by_denominator.asDiagonal() * basis_.P.leftCols(poles_);
    derivatives->middleCols(poles_, zeros_ + 1) = lateness.asDiagonal() * basis_.Q;
    if (free_delay_) derivatives->col(parameter_count() - 1) = -s_.cwiseProduct(response);
}

void FrequencyOutput::simulate_held(const Vector& theta, ComplexVector& response, Eigen::MatrixXcd* derivatives) const {
    const Index count = poles_ + zeros_ + 1, size = 2 * poles_ + 1;
    const Vector values = coefficients(theta);
    const Vector F = monic(values.head(poles_)), B = values.tail(zeros_ + 1), square = multiply(F, F);
    Matrix numerators(derivatives == nullptr ? 1 : 1 + parameter_count(), size);
    numerators.row(0) = shifted_row(multiply(B, F), 0, size);
    if (derivatives != nullptr) {
        for (Index i = 0; i < poles_; ++i) numerators.row(1 + i) = -shifted_row(B, poles_ - 1 - i, size);
        for (Index j = 0; j <= zeros_; ++j) numerators.row(1 + poles_ + j) = shifted_row(F, zeros_ - j, size);
        if (free_delay_) {
            // The slope of the answer to the input; a direct term's jumps stay at their samples.
            const Vector smooth = numerators.row(0) - numerators(0, 0) * square.transpose();
            numerators.row(1 + count) = -shifted_row(smooth.tail(size - 1), 1, size);
        }
    }
    const double delay = free_delay_ ? theta[theta.size() - 1] : delay_;
    const Hold hold = data_.inter_sample == InterSample::kZoh ? Hold::kZoh : Hold::kFoh;
    const Eigen::MatrixXcd all = sampled_responses(numerators, square, data_.w * unit_, data_.Ts / unit_, hold, delay);
    response = all.col(0);
    if (derivatives == nullptr) return;
    *derivatives = all.rightCols(parameter_count());
    derivatives->leftCols(count) = derivatives->leftCols(count) * basis_.map.cast<Complex>();
}

void FrequencyOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    ComplexVector response;
    Eigen::MatrixXcd derivatives;
    Eigen::MatrixXcd* const requested = sensitivities == nullptr ? nullptr : &derivatives;
    if (data_.inter_sample == InterSample::kBandLimited)
        simulate_sines(theta, response, requested);
    else
        simulate_held(theta, response, requested);
    if (stable_ && !is_hurwitz(monic(coefficients(theta).head(poles_)))) response.setConstant(Complex(kNaN, kNaN));
    output = stacked(response);
    if (sensitivities == nullptr) return;
    sensitivities->resize(output.size(), parameter_count());
    for (Index i = 0; i < parameter_count(); ++i) sensitivities->col(i) = stacked(derivatives.col(i));
}

}  // namespace dynlab::inline numerics
