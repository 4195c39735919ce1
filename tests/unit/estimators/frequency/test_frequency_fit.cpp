#include "numerics/estimators/frequency/frequency_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "numerics/signals/random.h"
#include "numerics/simulation/sampled_response.h"
#include "support/message_texts.h"
#include "support/thrown_message.h"

namespace test_frequency_fit {

using namespace dynlab;
using dynlab::test::texts_of;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

Vector logarithmic(double low, double high, Index count) {
    return Vector::LinSpaced(count, std::log(low), std::log(high)).array().exp();
}

FrequencyData noise_free(const TransferFunction& G, const Vector& w, double Ts = 0,
                         InterSample inter_sample = InterSample::kBandLimited) {
    return frequency_data(response_between_samples(G, w, Ts, inter_sample), w, Vector(), Ts, inter_sample);
}

/// Adds errors of this variance. The data contain the variance if `reported`.
FrequencyData noisy(const FrequencyData& truth, const Vector& variance, std::uint32_t seed, bool reported = true) {
    RandomStream random(seed);
    ComplexVector H = truth.response;
    for (Index k = 0; k < H.size(); ++k) {
        const double size = std::sqrt(variance[k] / 2), re = random.normal(), im = random.normal();
        H[k] += size * Complex(re, im);
    }
    return frequency_data(H, truth.w, reported ? variance : Vector(), truth.Ts, truth.inter_sample);
}

double relative_error(const Vector& found, const Vector& truth) {
    return (found - truth).cwiseQuotient(truth).cwiseAbs().maxCoeff();
}

TEST(frequency_fit, of_a_lightly_damped_beam_is_exact) {  // oracle: the system
    const TransferFunction G(Vector{{1.2}}, Vector{{1.1, 0.0009, 1.2}});
    const Vector truth{{0.0009 / 1.1, 1.2 / 1.1, 1.2 / 1.1}};
    const Fit fit = frequency_fit("coe", noise_free(G, logarithmic(0.1, 10, 200)), TransferStructure::single(2, 0));
    EXPECT_LT(relative_error(fit.theta, truth), 1e-10);
    EXPECT_EQ(fit.termination, Termination::kConverged);
    EXPECT_EQ(fit.names, (std::vector<std::string>{"a1", "a2", "b0"}));
    EXPECT_NEAR(fit.fit_percent[0], 100, 1e-6);
}

TEST(frequency_fit, is_exact_over_decades_and_with_zeros) {  // oracle: the system; Rao and Garnier's
    const TransferFunction G(Vector{{-6400.0, 1600.0}}, Vector{{1.0, 5.0, 408.0, 416.0, 1600.0}});
    const Fit fit = frequency_fit("srivc", noise_free(G, logarithmic(0.1, 100, 150)), TransferStructure::single(4, 1));
    EXPECT_LT(relative_error(fit.theta, Vector{{5.0, 408.0, 416.0, 1600.0, -6400.0, 1600.0}}), 1e-10);
}

TEST(frequency_fit, of_held_inputs_is_the_system_in_continuous_time) {  // oracle: the system
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 4.0, 3.0}});
    FitOptions options;
    options.tolerance = 1e-10;
    for (const InterSample hold : {InterSample::kZoh, InterSample::kFoh}) {
        const Fit fit = frequency_fit("coe", noise_free(G, Vector::LinSpaced(60, 0.1, 15), 0.2, hold),
                                      TransferStructure::single(2, 0), options);
        EXPECT_LT(relative_error(fit.theta, Vector{{4.0, 3.0, 2.0}}), 1e-10);
    }
}

TEST(frequency_fit, finds_a_free_delay) {  // oracle: the system
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}}, 0, 1.37);
    TransferStructure structure = TransferStructure::single(2, 0);
    structure.free_delays = true;
    const Fit plain = frequency_fit("coe", noise_free(G, logarithmic(0.05, 8, 80)), structure);
    EXPECT_LT(relative_error(plain.theta, Vector{{0.8, 4.0, 2.0, 1.37}}), 1e-10);
    EXPECT_GT(plain.delay_grid.size(), 10);
    const Fit held =
        frequency_fit("coe", noise_free(G, Vector::LinSpaced(80, 0.1, 12), 0.1, InterSample::kZoh), structure);
    EXPECT_LT(relative_error(held.theta, Vector{{0.8, 4.0, 2.0, 1.37}}), 1e-9);
}

TEST(frequency_fit, keeps_a_fixed_delay) {
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}}, 0, 0.5);
    const Fit fit = frequency_fit("coe", noise_free(G, logarithmic(0.05, 8, 80)), TransferStructure::single(2, 0, 0.5));
    EXPECT_LT(relative_error(fit.theta, Vector{{0.8, 4.0, 2.0}}), 1e-10);
    EXPECT_EQ(fit.models.front().delay(), 0.5);
}

TEST(frequency_fit, is_a_stationary_point_of_the_weighted_criterion) {  // oracle: the criterion itself, by differences
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}});
    const Vector w = logarithmic(0.2, 20, 60);
    const FrequencyData data = noisy(noise_free(G, w), w.cwiseInverse() * 0.01, 4);
    FitOptions options;
    options.tolerance = 1e-10;
    const Fit fit = frequency_fit("coe", data, TransferStructure::single(2, 0), options);
    const auto criterion = [&](const Vector& theta) {
        double sum = 0;
        for (Index k = 0; k < w.size(); ++k) {
            const Complex s(0, w[k]);
            sum += std::norm(data.response[k] - theta[2] / (s * s + theta[0] * s + theta[1])) / data.variance[k];
        }
        return sum;
    };
    const double least = criterion(fit.theta);
    for (Index i = 0; i < 3; ++i)
        for (const double step : {-1e-4, 1e-4}) {
            Vector other = fit.theta;
            other[i] *= 1 + step;
            EXPECT_GT(criterion(other), least);
        }
    EXPECT_NEAR(fit.loss, least / 60, 1e-9 * least);  // both parts of 60 values of variance one
}

TEST(frequency_fit, standard_errors_are_those_of_the_information_matrix) {  // second route: dG/dtheta by hand
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}});
    const Vector w = logarithmic(0.2, 20, 60), variance = Vector::Constant(60, 1e-6);
    const Fit fit = frequency_fit("coe", noisy(noise_free(G, w), variance, 2), TransferStructure::single(2, 0));
    Matrix information = Matrix::Zero(3, 3);
    for (Index k = 0; k < 60; ++k) {
        const Complex s(0, w[k]), F = s * s + fit.theta[0] * s + fit.theta[1], B = fit.theta[2];
        const ComplexVector slope{{-B * s / (F * F), -B / (F * F), 1.0 / F}};
        information += 2 / variance[k] * (slope.conjugate() * slope.transpose()).real();
    }
    const Matrix bound = information.inverse();
    EXPECT_LT((fit.covariance - bound).norm(), 1e-6 * bound.norm());
    EXPECT_THAT(fit.warnings, IsEmpty());
}

TEST(frequency_fit, measures_a_variance_that_is_not_given) {  // oracle: that of the errors, 120 of them
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}});
    const Vector w = logarithmic(0.2, 20, 400);
    const Fit fit = frequency_fit("coe", noisy(noise_free(G, w), Vector::Constant(400, 0.01), 3, false),
                                  TransferStructure::single(2, 0));
    EXPECT_NEAR(fit.noise_variance[0], 0.01, 4 * 0.01 / std::sqrt(400.0));
}

TEST(frequency_fit, reports_errors_that_the_variance_does_not_explain) {
    const TransferFunction G(Vector{{1.0}}, Vector{{1.0, 1.2, 1.5, 1.0}});
    const Vector w = logarithmic(0.1, 10, 60);
    const Fit fit =
        frequency_fit("coe", noisy(noise_free(G, w), Vector::Constant(60, 1e-6), 3), TransferStructure::single(1, 0));
    EXPECT_THAT(texts_of(fit.warnings),
                Contains(HasSubstr("deviates from the response by more than the variance explains")));
}

TEST(frequency_fit, gives_stable_models_where_they_are_wanted) {
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, -0.4, 4.0}});
    const FrequencyData data = noise_free(G, logarithmic(0.2, 20, 60));
    const Fit free = frequency_fit("coe", data, TransferStructure::single(2, 0));
    EXPECT_LT(relative_error(free.theta, Vector{{-0.4, 4.0, 2.0}}), 1e-10);
    EXPECT_THAT(texts_of(free.warnings), Contains(HasSubstr("unstable")));
    FitOptions options;
    options.stable = true;
    EXPECT_TRUE(frequency_fit("coe", data, TransferStructure::single(2, 0), options).models.front().stable());
}

TEST(frequency_fit, refuses_what_it_cannot_use) {
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 4.0}});
    const FrequencyData data = noise_free(G, Vector{{1.0, 2.0}});
    EXPECT_THAT(thrown_message([&] { frequency_fit("coe", data, TransferStructure::single(2, 0)); }),
                HasSubstr("coe: the response must have at least as many frequencies as parameters (3), but has 2"));
    FrequencyData zero = data;
    zero.w[0] = 0;
    EXPECT_THAT(thrown_message([&] { frequency_fit("coe", zero, TransferStructure::single(1, 0)); }),
                HasSubstr("must be positive"));
    const TransferStructure two = TransferStructure::grid(1, 2, Denominators::kPerOutput, {1}, {0}, {0.0});
    EXPECT_THAT(thrown_message([&] { frequency_fit("coe", data, two); }), HasSubstr("the model has 2 and 1"));
}

TEST(frequency_fit, stops_on_request) {
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}});
    const Vector w = logarithmic(0.2, 20, 60);
    FitOptions options;
    options.cancel = [] { return true; };
    const Fit fit = frequency_fit("coe", noisy(noise_free(G, w), Vector::Constant(60, 0.1), 2),
                                  TransferStructure::single(2, 0), options);
    EXPECT_EQ(fit.termination, Termination::kCanceled);
}

TEST(frequency_lssvf, without_noise_is_the_system_and_its_errors_are_first_order) {
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}});
    const Vector w = logarithmic(0.2, 20, 60);
    SvfOptions options;
    options.lambda = 3;
    const Fit exact = frequency_lssvf(noise_free(G, w), TransferStructure::single(2, 0), options);
    EXPECT_LT(relative_error(exact.theta, Vector{{0.8, 4.0, 2.0}}), 1e-10);
    // oracle: spread over 400 seeds at a level at which its bias is far below it
    Matrix found(3, 400);
    Fit one;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        one = frequency_lssvf(noisy(noise_free(G, w), Vector::Constant(60, 1e-6), seed),
                              TransferStructure::single(2, 0), options);
        found.col(seed - 1) = one.theta;
    }
    const Vector mean = found.rowwise().mean();
    for (Index i = 0; i < 3; ++i) {
        const double spread = std::sqrt((found.row(i).array() - mean[i]).square().sum() / 399);
        EXPECT_NEAR(one.std[i] / spread, 1, 0.15) << "parameter " << i;  // four standard errors of a spread of 400
    }
}

TEST(frequency_lssvf, refuses_free_delays_and_cutoffs_below_zero) {
    const TransferFunction G(Vector{{2.0}}, Vector{{1.0, 0.8, 4.0}});
    const FrequencyData data = noise_free(G, logarithmic(0.2, 20, 60));
    TransferStructure structure = TransferStructure::single(2, 0);
    SvfOptions options;
    EXPECT_THAT(thrown_message([&] { frequency_lssvf(data, structure, options); }), HasSubstr("cutoff"));
    options.lambda = 3;
    structure.free_delays = true;
    EXPECT_THAT(thrown_message([&] { frequency_lssvf(data, structure, options); }),
                HasSubstr("this method does not estimate delays"));
}

}  // namespace test_frequency_fit
