#include "numerics/validation/cramer_rao.h"

#include <algorithm>
#include <limits>

#include "numerics/error.h"
#include "numerics/filters/sensitivity_system.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/models/sampled_system.h"
#include "numerics/simulation/exact_filter.h"

namespace dynlab::inline numerics {
namespace {

struct ParameterNumbers {
    Index poles = 0, numerator = 0;
    bool delay = false;

    Index total() const { return poles + numerator + (delay ? 1 : 0); }
};

std::vector<std::string> names_of(const ParameterNumbers& numbers) {
    std::vector<std::string> names;
    for (Index i = 1; i <= numbers.poles; ++i) names.push_back("a" + std::to_string(i));
    for (Index j = 0; j < numbers.numerator; ++j) names.push_back("b" + std::to_string(j));
    if (numbers.delay) names.push_back("Td");
    return names;
}

ParameterNumbers numbers_in(const std::vector<std::string>& names) {
    const auto beginning_with = [&](char letter) {
        return std::count_if(names.begin(), names.end(),
                             [&](const std::string& name) { return !name.empty() && name.front() == letter; });
    };
    return {beginning_with('a'), beginning_with('b'), beginning_with('T') > 0};
}

/// N x d, in the order of the names.
Matrix sensitivities(const TransferFunction& system, const Vector& theta, const ParameterNumbers& numbers,
                     const VectorView& u, double Ts, Hold hold) {
    const Vector num = theta.segment(numbers.poles, numbers.numerator);
    const SingleInputSystem all = sensitivity_system(num, system.den());
    const Index d = numbers.total();  // the output itself is row 0, the delay's the row after the coefficients'
    return ExactFilter(discretize(all.A, all.B, all.C.middleRows(1, d), all.D.segment(1, d), Ts, hold, system.delay()))
        .run(u);
}

}  // namespace

std::vector<std::string> system_parameter_names(const TransferFunction& system) {
    return names_of({system.pole_count(), system.num().size(), system.delay() > 0});
}

Vector true_parameters(const TransferFunction& system, const std::vector<std::string>& names) {
    const ParameterNumbers numbers = numbers_in(names);
    if (!system.continuous() || numbers.poles != system.pole_count() || numbers.numerator < system.num().size() ||
        numbers.numerator > numbers.poles + 1 || names != names_of(numbers))
        return {};
    Vector theta = Vector::Zero(numbers.total());
    theta.head(numbers.poles) = system.den().tail(numbers.poles);
    theta.segment(numbers.poles + numbers.numerator - system.num().size(), system.num().size()) = system.num();
    if (numbers.delay) theta[theta.size() - 1] = system.delay();
    return theta;
}

Matrix cramer_rao_bound(const TransferFunction& system, const VectorView& u, double Ts, Hold hold, double sigma,
                        const std::vector<std::string>& names) {
    const Vector theta = true_parameters(system, names);
    const ParameterNumbers numbers = numbers_in(names);
    if (theta.size() == 0)
        throw InvalidArgument(
            "The Cramer-Rao bound is available only for the coefficients a1, ..., b0, ... (and Td) of a model with as "
            "many poles as the system and no fewer zeros");
    if (numbers.delay && numbers.numerator > numbers.poles)
        throw InvalidArgument(
            "The Cramer-Rao bound of a delay needs a system with fewer zeros than poles, but this system has direct "
            "feedthrough");
    if (u.size() < theta.size())
        throw InvalidArgument(
            "The Cramer-Rao bound of {} parameters needs at least one sample per parameter, but the number of samples "
            "is {}",
            theta.size(), u.size());
    const Matrix psi = sensitivities(system, theta, numbers, u, Ts, hold);
    const LeastSquares solved = solve_least_squares(psi, Vector::Zero(psi.rows()));
    if (solved.rank < theta.size()) {
        Matrix unknown = Matrix::Zero(theta.size(), theta.size());
        unknown.diagonal().setConstant(std::numeric_limits<double>::infinity());
        return unknown;
    }
    return sigma * sigma * solved.inverse_gram;
}

}  // namespace dynlab::inline numerics
