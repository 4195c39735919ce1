#include "numerics/kernels/process_output.h"

#include <limits>

#include "numerics/error.h"
#include "numerics/kernels/transfer_sensitivity.h"

namespace dynlab {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeastTime = 1e-3;   // samples: any faster lag looks like none
constexpr double kLargestTime = 1e6;  // records: any slower one looks like an integrator

// K/T/(s + 1/T)
void first_order(double K, double T, ProcessCoefficients& c) {
    c.num = Vector::Constant(1, K / T);
    c.den = Vector{{1.0, 1 / T}};
    c.num_by_parameter.leftCols(2) << 1 / T, -K / (T * T);
    c.den_by_parameter(0, 1) = -1 / (T * T);
}

// K/(T1 T2)/(s^2 + (1/T1 + 1/T2) s + 1/(T1 T2))
void second_order(double K, double T1, double T2, ProcessCoefficients& c) {
    const double product = T1 * T2;
    c.num = Vector::Constant(1, K / product);
    c.den = Vector{{1.0, 1 / T1 + 1 / T2, 1 / product}};
    c.num_by_parameter.leftCols(3) << 1 / product, -K / (T1 * product), -K / (T2 * product);
    c.den_by_parameter.middleCols(1, 2) << -1 / (T1 * T1), -1 / (T2 * T2), -1 / (T1 * product), -1 / (T2 * product);
}

// K/T^2/(s^2 + 2 zeta/T s + 1/T^2)
void underdamped(double K, double T, double zeta, ProcessCoefficients& c) {
    const double square = T * T;
    c.num = Vector::Constant(1, K / square);
    c.den = Vector{{1.0, 2 * zeta / T, 1 / square}};
    c.num_by_parameter.leftCols(3) << 1 / square, -2 * K / (square * T), 0;
    c.den_by_parameter.middleCols(1, 2) << -2 * zeta / square, 2 / T, -2 / (square * T), 0;
}

}  // namespace

void require_supported(const ProcessStructure& structure) {
    const bool known = !structure.integrator && !structure.zero &&
                       (structure.poles == 2 || (structure.poles == 1 && !structure.underdamped));
    if (!known)
        throw InvalidArgument("The structure " + structure.text() +
                              " is not supported: P1, P2 and P2U are, each with or without D (P1D, P2D, P2DU)");
}

ProcessCoefficients process_coefficients(const ProcessStructure& structure, const Vector& parameters) {
    require_supported(structure);
    ProcessCoefficients c;
    c.num_by_parameter = Matrix::Zero(1, parameters.size());
    c.den_by_parameter = Matrix::Zero(structure.poles, parameters.size());
    if (structure.poles == 1)
        first_order(parameters[0], parameters[1], c);
    else if (structure.underdamped)
        underdamped(parameters[0], parameters[1], parameters[2], c);
    else
        second_order(parameters[0], parameters[1], parameters[2], c);
    if (structure.delay) c.delay = parameters[parameters.size() - 1];
    return c;
}

Matrix coefficients_by_parameter(const ProcessModel& model) {
    const ProcessCoefficients c = process_coefficients(model.structure, model.parameters);
    const Index n = c.den_by_parameter.rows(), b = c.num_by_parameter.rows(), q = model.parameters.size();
    Matrix derivatives = Matrix::Zero(n + b + (model.structure.delay ? 1 : 0), q);
    derivatives.topRows(n) = c.den_by_parameter;
    derivatives.middleRows(n, b) = c.num_by_parameter;
    if (model.structure.delay) derivatives(n + b, q - 1) = 1;
    return derivatives;
}

ProcessOutput::ProcessOutput(const ProcessStructure& structure, const StartCondition& condition, const VectorView& u,
                             Hold hold, double least_delay, double largest_delay)
    : structure_(structure), condition_(condition), hold_(hold) {
    require_supported(structure);
    if (condition.state != InitialState::kZero) resting_input_ = u[0];
    input_ = u.array() - resting_input_;
    model_parameters_ = static_cast<Index>(structure.parameter_names().size());
    if (condition.state == InitialState::kEstimate) initial_values_ = structure.poles;
    const Index count = model_parameters_ + initial_values_ + (condition.offset ? 1 : 0);
    lower_ = Vector::Constant(count, -kInfinity);
    upper_ = Vector::Constant(count, kInfinity);
    const Index times = structure.underdamped ? 1 : structure.poles;
    lower_.segment(1, times).setConstant(kLeastTime);
    upper_.segment(1, times).setConstant(kLargestTime * static_cast<double>(u.size()));
    if (structure.underdamped) lower_[2] = 0;
    if (structure.delay) {
        lower_[model_parameters_ - 1] = least_delay;
        upper_[model_parameters_ - 1] = largest_delay;
    }
}

void ProcessOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    const Index N = input_.size(), q = model_parameters_, n = structure_.poles;
    const ProcessCoefficients c = process_coefficients(structure_, theta.head(q));
    const Vector initial = theta.segment(q, initial_values_);
    const double constant = theta[0] * resting_input_ + (condition_.offset ? theta[theta.size() - 1] : 0);
    const Matrix free = initial_values_ > 0 ? free_responses(c.den, N, 1) : Matrix(N, 0);
    if (!sensitivities) {
        output = transfer_response(c.num, c.den, c.delay, input_, 1, hold_);
        output.array() += constant;
        output += free * initial;
        return;
    }
    const Matrix by_coefficient = transfer_sensitivities(c.num, c.den, c.delay, input_, 1, hold_);
    output = by_coefficient.col(0) + free * initial;
    output.array() += constant;
    Matrix by_den = by_coefficient.middleCols(1, n);
    if (initial_values_ > 0) by_den += free_sensitivities(c.den, initial, N, 1);
    sensitivities->resize(N, theta.size());
    sensitivities->leftCols(q) = by_den * c.den_by_parameter;
    sensitivities->leftCols(q) += by_coefficient.middleCols(n + 1, c.num.size()) * c.num_by_parameter;
    sensitivities->col(0).array() += resting_input_;
    if (structure_.delay) sensitivities->col(q - 1) = by_coefficient.rightCols(1);
    sensitivities->middleCols(q, initial_values_) = free;
    if (condition_.offset) sensitivities->rightCols(1).setOnes();
}

}  // namespace dynlab
