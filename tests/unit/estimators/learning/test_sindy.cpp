#include "numerics/estimators/learning/sindy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/reader.h"
#include "support/nonlinear_data.h"
#include "support/thrown_message.h"

namespace test_sindy {

using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAreArray;

using Coefficients = std::map<std::string, double>;

const Coefficients kLorenz = {{"y1: y1", -10},   {"y1: y2", 10},   {"y2: y1", 28},      {"y2: y2", -1},
                              {"y2: y1*y3", -1}, {"y3: y1*y2", 1}, {"y3: y3", -8.0 / 3}};
const Coefficients kLotkaVolterra = {{"y1: y1", 1.1}, {"y1: y1*y2", -0.4}, {"y2: y1*y2", 0.1}, {"y2: y2", -0.4}};

SindyFit polynomials(const IdData& data, int degree, const SindyOptions& options = {}) {
    return sindy(data, polynomial_library(data.output_names, data.input_names, degree), options);
}

/// Oracle: the equations that were simulated. The support is exact, the coefficients to so many per cent.
void expect_equations(const SindyFit& found, const Coefficients& truth, double percent) {
    std::vector<std::string> names;
    for (const auto& [name, value] : truth) names.push_back(name);
    ASSERT_THAT(found.fit.names, UnorderedElementsAreArray(names));
    for (std::size_t i = 0; i < found.fit.names.size(); ++i) {
        const double value = truth.at(found.fit.names[i]);
        EXPECT_NEAR(found.fit.theta[static_cast<Index>(i)], value, percent / 100 * std::abs(value))
            << found.fit.names[i];
    }
}

bool has_support(const SindyFit& found, const Coefficients& truth) {
    bool all = found.fit.names.size() == truth.size();
    for (const std::string& name : found.fit.names) all = all && truth.count(name) == 1;
    return all;
}

SindyOptions weakly() {
    SindyOptions options;
    options.weak = true;
    return options;
}

TEST(sindy, finds_lorenz_without_noise) {
    const IdData data = lorenz_data(0.005, 4000);
    for (const int degree : {2, 3}) {
        expect_equations(polynomials(data, degree), kLorenz, 1);
        expect_equations(polynomials(data, degree, weakly()), kLorenz, 1);
    }
}

TEST(sindy, finds_lotka_volterra_without_noise) {
    const IdData data = lotka_volterra_data(0.05, 800);
    for (const int degree : {2, 3}) {
        expect_equations(polynomials(data, degree), kLotkaVolterra, 1);
        expect_equations(polynomials(data, degree, weakly()), kLotkaVolterra, 1);
    }
}

TEST(sindy, finds_lorenz_under_noise_in_weak_form) {
    const IdData clean = lorenz_data(0.005, 6000);
    for (std::uint32_t seed = 1; seed <= 10; ++seed)
        for (const int degree : {2, 3})
            expect_equations(polynomials(with_relative_noise(clean, 0.01, seed), degree, weakly()), kLorenz, 5);
}

TEST(sindy, finds_lotka_volterra_under_noise_in_weak_form) {
    const IdData clean = lotka_volterra_data(0.05, 1200);
    for (std::uint32_t seed = 1; seed <= 10; ++seed)
        expect_equations(polynomials(with_relative_noise(clean, 0.01, seed), 2, weakly()), kLotkaVolterra, 5);
}

TEST(sindy, weak_form_bears_more_noise_than_derivatives) {  // oracle: the support put in, 10 seeds
    const IdData clean = lorenz_data(0.005, 6000);
    int weak = 0, plain = 0;
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        const IdData noisy = with_relative_noise(clean, 0.1, seed);
        weak += has_support(polynomials(noisy, 2, weakly()), kLorenz);
        plain += has_support(polynomials(noisy, 2), kLorenz);
    }
    EXPECT_EQ(weak, 10);
    EXPECT_LT(plain, 3);
}

/// A tank: dh/dt = 0.5 u - 0.3 sqrt(h) with a held input, exact between samples by 50 steps of Runge and Kutta.
IdData tank_data(Index N) {
    RandomStream chance(1);
    Matrix h(N, 1), u(N, 1);
    double x = 1;
    for (Index k = 0; k < N; ++k) {
        u(k, 0) = k % 20 == 0 ? 0.4 + 0.8 * chance.uniform() : u(k - 1, 0);
        h(k, 0) = x;
        for (int i = 0; i < 50; ++i) {
            const auto rate = [&](double level) { return 0.5 * u(k, 0) - 0.3 * std::sqrt(level); };
            const double d = 0.5 / 50, a = rate(x), b = rate(x + d / 2 * a), c = rate(x + d / 2 * b),
                         e = rate(x + d * c);
            x += d / 6 * (a + 2 * b + 2 * c + e);
        }
    }
    IdData data(h, u, 0.5);
    data.output_names = {"h"};
    return data;
}

FunctionLibrary tank_library() {
    FunctionLibrary library;
    library.names = {"1", "u", "h", "sqrt(h)", "h^2"};
    library.values = [](const Matrix& X, const Matrix& U) {
        Matrix values(X.rows(), 5);
        values << Vector::Ones(X.rows()), U, X, X.cwiseSqrt(), X.cwiseAbs2();
        return values;
    };
    return library;
}

TEST(sindy, takes_functions_and_inputs) {
    const IdData data = tank_data(600);
    const Coefficients truth = {{"h: u", 0.5}, {"h: sqrt(h)", -0.3}};
    const SindyFit found = sindy(data, tank_library());
    expect_equations(found, truth, 1);
    EXPECT_EQ(found.equations, (std::vector<std::string>{"dh/dt = 0.5*u - 0.3*sqrt(h)"}));
    EXPECT_GT(found.fit.fit_percent[0], 99.9);
    expect_equations(sindy(data, tank_library(), weakly()), truth, 1);
}

TEST(sindy, joins_experiments_and_irregular_samples) {
    const IdData data = lotka_volterra_data(0.05, 800);
    const IdData joined = IdData::merge({data.range(1, 300), data.range(400, 800)});
    expect_equations(polynomials(joined, 2), kLotkaVolterra, 1);
    std::vector<Index> kept;
    for (Index k = 0; k < 800; ++k)
        if (k % 3 != 1) kept.push_back(k);
    Matrix y(static_cast<Index>(kept.size()), 2);
    Vector t(y.rows());
    for (Index i = 0; i < y.rows(); ++i) {
        y.row(i) = data.experiments[0].y.row(kept[static_cast<std::size_t>(i)]);
        t[i] = 0.05 * static_cast<double>(kept[static_cast<std::size_t>(i)]);
    }
    expect_equations(polynomials(IdData(y, Matrix(y.rows(), 0), t), 2), kLotkaVolterra, 1);
}

TEST(sindy, runs_freely_from_the_first_sample) {  // oracle: the Runge-Kutta method of the data
    const IdData data = lotka_volterra_data(0.05, 800);
    const SindyFit found = polynomials(data, 2);
    EXPECT_GT(found.fit.fit_percent.minCoeff(), 99);
    const SindyModel truth(
        found.model->library(),
        [&] {
            Matrix Xi = Matrix::Zero(6, 2);
            Xi(1, 0) = 1.1, Xi(4, 0) = -0.4, Xi(4, 1) = 0.1, Xi(2, 1) = -0.4;
            return Xi;
        }(),
        0, Vector{{20, 20}});
    const FreeRun run = truth.free_run(data, 0, Vector());
    EXPECT_LT((run.output - data.experiments[0].y).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(sindy, reports_when_a_run_is_lost) {  // oracle: dx/dt = x^2 from 1 is 1/(1 - t)
    FunctionLibrary square{{"x^2"}, [](const Matrix& X, const Matrix&) { return Matrix(X.cwiseAbs2()); }};
    const SindyModel model(square, Matrix::Ones(1, 1), 0, Vector::Constant(1, 0.1));
    IdData data = inputs_alone(Matrix(100, 0), 0.05, Hold::kZoh);
    const FreeRun run = model.free_run(data, 0, Vector::Ones(1));
    ASSERT_TRUE(run.lost_at.has_value());
    EXPECT_EQ(*run.lost_at, 20);  // 1/(1 - t) passes 100 at t = 0.99
    EXPECT_NEAR(run.output(19, 0), 20, 1e-6);
}

TEST(sindy, warns_of_a_state_without_terms) {
    IdData data = tank_data(200);
    FunctionLibrary far{{"sin"}, [](const Matrix& X, const Matrix&) { return Matrix((300 * X.array()).sin()); }};
    SindyOptions strict;
    strict.threshold = 0.9;
    EXPECT_THAT(message_text(sindy(data, far, strict).fit.full_message()),
                HasSubstr("No function of the library contributes to the derivative of h"));
}

TEST(sindy, refuses_what_cannot_be_fitted) {
    const IdData data = lotka_volterra_data(0.05, 30);
    EXPECT_THAT(thrown_message([&] { polynomials(data.range(1, 8), 3); }),
                HasSubstr("greater than the number of functions, 10"));
    EXPECT_THAT(thrown_message([&] { polynomials(data.range(1, 4), 1); }),
                HasSubstr("each derivative needs 5 samples"));
    EXPECT_THAT(thrown_message([&] { sindy(data, {}); }), HasSubstr("contains no function"));
    SindyOptions options;
    options.threshold = 1;
    EXPECT_THAT(thrown_message([&] { polynomials(data, 1, options); }),
                HasSubstr("`threshold`, a fraction of the derivative, must be at least 0"));
    options = {};
    options.window = 4;
    EXPECT_THAT(thrown_message([&] { polynomials(data, 1, options); }), HasSubstr("`window` must be an odd number"));
    options = weakly();
    options.width = -1;
    EXPECT_THAT(thrown_message([&] { polynomials(data, 1, options); }), HasSubstr("`width` must be positive"));
    options.width = 10;
    EXPECT_THAT(thrown_message([&] { polynomials(data, 1, options); }), HasSubstr("a smaller `width`"));
    const IdData still(Matrix::Ones(50, 1), Matrix::Random(50, 1), 1);
    EXPECT_THAT(thrown_message([&] { polynomials(still, 1); }), HasSubstr("never changes"));
    const SindyFit found = polynomials(data, 1);
    EXPECT_THAT(thrown_message([&] { found.model->free_run(data, 0, Vector::Ones(3)); }),
                HasSubstr("x0 must contain the 2 states"));
    EXPECT_THAT(thrown_message([&] { found.model->free_run(still, 0, Vector()); }), HasSubstr("select the channels"));
}

}  // namespace test_sindy
