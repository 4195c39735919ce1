#include "numerics/criteria/process_output.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "numerics/linalg/polynomial.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kLeastTime = 1e-3;   // samples: any faster lag looks like none
constexpr double kLargestTime = 1e6;  // data lengths: any slower lag looks like an integrator

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

// Derivatives of [a_1..a_n b_0..b_m], and of the delay, which is the last parameter.
Matrix by_parameter(const ProcessCoefficients& c, bool delay) {
    const Index n = c.den_by_parameter.rows(), b = c.num_by_parameter.rows(), q = c.den_by_parameter.cols();
    Matrix derivatives = Matrix::Zero(n + b + (delay ? 1 : 0), q);
    derivatives.topRows(n) = c.den_by_parameter;
    derivatives.middleRows(n, b) = c.num_by_parameter;
    if (delay) derivatives(n + b, q - 1) = 1;
    return derivatives;
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
    return by_parameter(process_coefficients(model.structure, model.parameters), model.structure.delay);
}

TransferStructure transfer_structure(const ProcessStructure& structure) {
    TransferStructure transfer =
        TransferStructure::single(structure.poles + (structure.integrator ? 1 : 0), structure.zero ? 1 : 0);
    transfer.free_delays = structure.delay;
    return transfer;
}

TransferOutput::AtRest at_rest(const ProcessStructure& structure) {
    return structure.integrator ? TransferOutput::AtRest::kNothing : TransferOutput::AtRest::kOwnGain;
}

Reparametrized process_output(const ProcessStructure& structure, const TransferOutput& output) {
    const Index q = static_cast<Index>(structure.parameter_names().size()), linear = output.linear_count();
    Index longest = 0;
    for (std::size_t e = 0; e < output.experiment_count(); ++e) longest = std::max(longest, output.rows(e));
    const double slowest = kLargestTime * static_cast<double>(longest);
    Vector lower = Vector::Constant(q + linear, -kInfinity), upper = -lower;
    const Index times = structure.underdamped ? structure.poles - 1 : structure.poles;
    lower.segment(1, times).setConstant(kLeastTime);
    upper.segment(1, times).setConstant(slowest);
    if (structure.underdamped) lower[1 + times] = 0;
    const Index tz = q - 1 - (structure.delay ? 1 : 0);
    if (structure.zero) lower[tz] = -(upper[tz] = slowest);
    const Index inner = output.parameter_count() - linear;
    const bool own_gain = output.has_own_gains();
    if (structure.delay) {
        const Index place = transfer_structure(structure).delay_index(0, 0);
        lower[q - 1] = output.lower()[place];
        upper[q - 1] = output.upper()[place];
    }
    const auto coefficients_of = [structure, q, inner, linear, own_gain](const Vector& theta) {
        const ProcessCoefficients c = process_coefficients(structure, theta.head(q));
        Reparametrized::Point point{Vector(inner + linear), Matrix::Zero(inner + linear, q + linear)};
        point.inner.head(inner) << c.den.tail(c.den.size() - 1), c.num, theta.segment(q - 1, structure.delay ? 1 : 0),
            theta.head(own_gain ? 1 : 0);
        point.inner.tail(linear) = theta.tail(linear);
        point.derivatives.topLeftCorner(inner - (own_gain ? 1 : 0), q) = by_parameter(c, structure.delay);
        if (own_gain) point.derivatives(inner - 1, 0) = 1;
        point.derivatives.bottomRightCorner(linear, linear).setIdentity();
        return point;
    };
    return Reparametrized(output, coefficients_of, lower, upper);
}

Vector process_seconds(const ProcessStructure& structure, const TransferOutput& output) {
    const auto names = structure.parameter_names();
    const Index q = static_cast<Index>(names.size()), linear = output.linear_count();
    Vector seconds = Vector::Ones(q + linear);
    for (Index i = 0; i < q; ++i)
        if (names[static_cast<std::size_t>(i)].front() == 'T') seconds[i] = output.time_unit();
    if (structure.integrator) seconds[0] = 1 / output.time_unit();
    seconds.tail(linear) = output.seconds().tail(linear);
    return seconds;
}

}  // namespace dynlab::inline numerics
