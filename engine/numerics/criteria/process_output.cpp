#include "numerics/criteria/process_output.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "numerics/criteria/transfer_sensitivity.h"
#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kLeastTime = 1e-3;   // samples: any faster lag looks like none
constexpr double kLargestTime = 1e6;  // records: any slower one looks like an integrator

/// One factor of the monic denominator and its derivatives with respect to parameters.
struct Factor {
    Vector polynomial;
    std::vector<std::pair<Index, Vector>> derivatives;
};

// s + 1/T
Factor lag(Index place, double T) {
    return {Vector{{1.0, 1 / T}}, {{place, Vector{{0.0, -1 / (T * T)}}}}};
}

// s^2 + 2 zeta/T s + 1/T^2
Factor pair(Index place, double T, double zeta) {
    const double square = T * T;
    return {Vector{{1.0, 2 * zeta / T, 1 / square}},
            {{place, Vector{{0.0, -2 * zeta / square, -2 / (square * T)}}}, {place + 1, Vector{{0.0, 2 / T, 0.0}}}}};
}

std::vector<Factor> factors_of(const ProcessStructure& structure, const Vector& parameters) {
    std::vector<Factor> factors;
    Index place = 1;
    for (int pole = structure.underdamped ? 3 : 1; pole <= structure.poles; ++pole, ++place)
        factors.push_back(lag(place, parameters[place]));
    if (structure.underdamped) factors.push_back(pair(place, parameters[place], parameters[place + 1]));
    if (structure.integrator) factors.push_back({Vector{{1.0, 0.0}}, {}});
    return factors;
}

}  // namespace

ProcessCoefficients process_coefficients(const ProcessStructure& structure, const Vector& parameters) {
    // With (1 + T s) = T (s + 1/T) the numerator is K (1 + Tz s) g, g the product of all last coefficients.
    const std::vector<Factor> factors = factors_of(structure, parameters);
    const double K = parameters[0];
    const Index q = parameters.size(), tz = q - 1 - (structure.delay ? 1 : 0);
    const Vector shape = structure.zero ? Vector{{parameters[tz], 1.0}} : Vector{{1.0}};
    ProcessCoefficients c;
    c.den = Vector::Ones(1);
    double g = 1;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        c.den = multiply(c.den, factors[i].polynomial);
        if (!structure.integrator || i + 1 < factors.size()) g *= factors[i].polynomial.tail(1)[0];
    }
    const Index n = c.den.size() - 1;
    c.num = K * g * shape;
    c.num_by_parameter = Matrix::Zero(shape.size(), q);
    c.den_by_parameter = Matrix::Zero(n, q);
    c.num_by_parameter.col(0) = g * shape;
    if (structure.zero) c.num_by_parameter(0, tz) = K * g;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        Vector others = Vector::Ones(1);
        for (std::size_t k = 0; k < factors.size(); ++k)
            if (k != i) others = multiply(others, factors[k].polynomial);
        for (const auto& [place, derivative] : factors[i].derivatives) {
            c.den_by_parameter.col(place) = multiply(others, derivative).tail(n);
            c.num_by_parameter.col(place) = K * g * derivative.tail(1)[0] / factors[i].polynomial.tail(1)[0] * shape;
        }
    }
    if (structure.delay) c.delay = parameters[q - 1];
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

Index initial_value_count(const ProcessStructure& structure, const StartCondition& condition) {
    return condition.state == InitialState::kEstimate ? structure.poles + (structure.integrator ? 1 : 0) : 0;
}

ProcessOutput::ProcessOutput(const ProcessStructure& structure, const StartCondition& condition,
                             std::vector<ProcessInput> inputs, double least_delay, double largest_delay)
    : structure_(structure), condition_(condition) {
    const bool rests = condition.state != InitialState::kZero && !structure.integrator;
    for (ProcessInput& input : inputs) {
        Record record{std::move(input), 0, samples_};
        if (rests) record.resting = record.input.u[0];
        record.input.u.array() -= record.resting;
        samples_ += record.input.u.size();
        records_.push_back(std::move(record));
    }
    model_parameters_ = static_cast<Index>(structure.parameter_names().size());
    initial_values_ = initial_value_count(structure, condition);
    set_bounds(least_delay, largest_delay);
}

Index ProcessOutput::initial_place(std::size_t experiment) const {
    return model_parameters_ + static_cast<Index>(experiment) * initial_values_;
}

Index ProcessOutput::offset_place(std::size_t experiment) const {
    return initial_place(records_.size()) + static_cast<Index>(experiment);
}

Index ProcessOutput::longest() const {
    Index longest = 0;
    for (std::size_t e = 0; e < records_.size(); ++e) longest = std::max(longest, rows(e));
    return longest;
}

void ProcessOutput::set_bounds(double least_delay, double largest_delay) {
    const Index count = condition_.offset ? offset_place(records_.size()) : initial_place(records_.size());
    lower_ = Vector::Constant(count, -kInfinity);
    upper_ = Vector::Constant(count, kInfinity);
    const double slowest = kLargestTime * static_cast<double>(longest());
    const Index times = structure_.underdamped ? structure_.poles - 1 : structure_.poles;
    lower_.segment(1, times).setConstant(kLeastTime);
    upper_.segment(1, times).setConstant(slowest);
    if (structure_.underdamped) lower_[1 + times] = 0;
    if (structure_.zero) {
        const Index tz = model_parameters_ - 1 - (structure_.delay ? 1 : 0);
        lower_[tz] = -slowest;
        upper_[tz] = slowest;
    }
    if (structure_.delay) {
        lower_[model_parameters_ - 1] = least_delay;
        upper_[model_parameters_ - 1] = largest_delay;
    }
}

Matrix ProcessOutput::motions(const ProcessInput& input, const VectorView& den) const {
    if (initial_values_ == 0) return Matrix(input.u.size(), 0);
    return input.t.size() == 0 ? free_responses(den, input.u.size(), 1) : free_responses(den, input.t);
}

void ProcessOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    const ProcessCoefficients c = process_coefficients(structure_, theta.head(model_parameters_));
    output.resize(samples_);
    if (sensitivities) sensitivities->setZero(samples_, theta.size());
    for (std::size_t e = 0; e < records_.size(); ++e) simulate_record(e, c, theta, output, sensitivities);
}

void ProcessOutput::simulate_record(std::size_t experiment, const ProcessCoefficients& c, const Vector& theta,
                                    Vector& output, Matrix* sensitivities) const {
    const auto& [input, resting, row] = records_[experiment];
    const Index N = input.u.size(), q = model_parameters_, n = c.den.size() - 1;
    const bool regular = input.t.size() == 0;
    const Vector initial = theta.segment(initial_place(experiment), initial_values_);
    const Matrix free = motions(input, c.den);
    auto y = output.segment(row, N);
    if (!sensitivities) {
        y = regular ? transfer_response(c.num, c.den, c.delay, input.u, 1, input.hold)
                    : transfer_response(c.num, c.den, c.delay, input.u, input.t, input.hold);
    } else {
        const Matrix by_coefficient = regular
                                          ? transfer_sensitivities(c.num, c.den, c.delay, input.u, 1, input.hold)
                                          : transfer_sensitivities(c.num, c.den, c.delay, input.u, input.t, input.hold);
        y = by_coefficient.col(0);
        Matrix by_den = by_coefficient.middleCols(1, n);
        if (initial_values_ > 0)
            by_den += regular ? free_sensitivities(c.den, initial, N, 1) : free_sensitivities(c.den, initial, input.t);
        auto own = sensitivities->middleRows(row, N);
        own.leftCols(q) = by_den * c.den_by_parameter;
        own.leftCols(q) += by_coefficient.middleCols(n + 1, c.num.size()) * c.num_by_parameter;
        own.col(0).array() += resting;
        if (structure_.delay) own.col(q - 1) = by_coefficient.rightCols(1);
        own.middleCols(initial_place(experiment), initial_values_) = free;
        if (condition_.offset) own.col(offset_place(experiment)).setOnes();
    }
    y += free * initial;
    y.array() += theta[0] * resting + (condition_.offset ? theta[offset_place(experiment)] : 0);
}

}  // namespace dynlab::inline numerics
