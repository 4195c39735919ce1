#include "numerics/criteria/rate_equations.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kHighestLocalDegree = 4;
constexpr int kPower = 8;  // of the test functions
constexpr Index kCentersPerWidth = 10;

/// Value and derivative at t[at] of the closest polynomial, as weights of the samples at the instants t.
Matrix polynomial_weights(const VectorView& t, Index at) {
    const Index n = t.size(), degree = std::min(kHighestLocalDegree, n - 1);
    const double scale = t[n - 1] - t[0];
    const Vector s = (t.array() - t[at]) / scale;
    Matrix powers(n, degree + 1);
    powers.col(0).setOnes();
    for (Index i = 1; i <= degree; ++i) powers.col(i) = powers.col(i - 1).cwiseProduct(s);
    Matrix weights = solve_by_pivoted_qr(powers, Matrix::Identity(n, n)).topRows(2);
    weights.row(1) /= scale;
    return weights;
}

bool input_jumps(const IdData& data, const Matrix& u, Index first, Index last) {
    if (data.hold != Hold::kZoh) return false;
    for (Index k = first + 1; k < last; ++k)
        if ((u.row(k).array() != u.row(first).array()).any()) return true;
    return false;
}

double bump(double s) {
    return std::pow(1 - s * s, kPower);
}
double bump_slope(double s) {
    return -2 * kPower * s * std::pow(1 - s * s, kPower - 1);
}

}  // namespace

RateEquations derivative_equations(const IdData& data, std::size_t experiment, const FunctionLibrary& library,
                                   int window) {
    const Experiment& data_set = data.experiments[experiment];
    const Index N = data_set.y.rows();
    if (N < window)
        throw InvalidArgument(
            "sindy: each derivative needs {} samples, but an experiment has only {}. Use longer experiments or a "
            "shorter window",
            window, N);
    const Vector t = data.time(experiment);
    Matrix X(N, data_set.y.cols()), rates(N, data_set.y.cols()), U(N, data_set.u.cols()), weights;
    Index rows = 0, weights_at = -1;
    for (Index k = 0; k < N; ++k) {
        const Index first = std::clamp<Index>(k - window / 2, 0, N - window), last = first + window - 1;
        if (input_jumps(data, data_set.u, first, last)) continue;
        if (!data.regular() || k - first != weights_at) {
            weights = polynomial_weights(t.segment(first, window), k - first);
            weights_at = k - first;
        }
        const auto samples = data_set.y.middleRows(first, window);
        X.row(rows) = weights.row(0) * samples;
        rates.row(rows) = weights.row(1) * samples;
        U.row(rows++) = data_set.u.row(data.hold == Hold::kZoh ? first : k);
    }
    return {library_values(library, X.topRows(rows), U.topRows(rows)), rates.topRows(rows)};
}

RateEquations weak_equations(const IdData& data, std::size_t experiment, const FunctionLibrary& library, double width) {
    const Experiment& data_set = data.experiments[experiment];
    const Index N = data_set.y.rows();
    const Vector t = data.time(experiment);
    // theta at the beginning and at the end of each interval between samples, with the input that acts within it
    const Matrix begins = library_values(library, data_set.y, data_set.u);
    Matrix ends = begins;
    if (data.hold == Hold::kZoh && data_set.u.cols() > 0) {
        Matrix held = data_set.u;
        held.bottomRows(N - 1) = data_set.u.topRows(N - 1);
        ends = library_values(library, data_set.y, held);
    }
    const double step = std::max(width / kCentersPerWidth, data.mean_step());
    const double available = t[N - 1] - t[0] - 2 * width;
    const Index rows = available < 0 ? 0 : static_cast<Index>(available / step) + 1;
    RateEquations equations{Matrix::Zero(rows, library.count()), Matrix::Zero(rows, data_set.y.cols())};
    Index first = 0;
    for (Index row = 0; row < rows; ++row) {
        const double center = t[0] + width + step * static_cast<double>(row);
        while (t[first] <= center - width && first + 1 < N && t[first + 1] <= center - width) ++first;
        Index inside = 0;
        for (Index k = first; k < N && t[k] < center + width; ++k) {
            const double s = (t[k] - center) / width;
            if (s <= -1) continue;
            ++inside;
            const double before = k > 0 ? (t[k] - t[k - 1]) / 2 : 0, after = k + 1 < N ? (t[k + 1] - t[k]) / 2 : 0;
            equations.Theta.row(row) += bump(s) * (before * ends.row(k) + after * begins.row(k));
            equations.B.row(row) -= bump_slope(s) / width * (before + after) * data_set.y.row(k);
        }
        if (inside < 3)
            throw InvalidArgument(
                "sindy: test functions with half-length {} {} cover fewer than 3 samples: increase {}",
                significant(width, 4), data.time_unit, OptionName{"width"});
    }
    return equations;
}

double usual_width(const IdData& data) {
    constexpr Index kMin = 5, kShare = 10;
    Index longest = 0;
    for (const Experiment& experiment : data.experiments) longest = std::max(longest, experiment.y.rows());
    const Index max_lag = std::max(kMin, longest / kShare);
    const auto correlation = [&](Index lag) {
        double sum = 0;
        for (const Experiment& experiment : data.experiments) {
            const Index N = experiment.y.rows();
            if (N <= lag) continue;
            for (Index i = 0; i < experiment.y.cols(); ++i) {
                const Vector x = experiment.y.col(i).array() - experiment.y.col(i).mean();
                const double power = x.squaredNorm() / static_cast<double>(N);
                if (power > 0) sum += x.head(N - lag).dot(x.tail(N - lag)) / power / static_cast<double>(N - lag);
            }
        }
        return sum;
    };
    const double start = correlation(0);
    Index lag = 1;
    while (lag < max_lag && correlation(lag) > start / 2) lag += 1 + lag / 20;
    return static_cast<double>(std::clamp(lag, kMin, max_lag)) * data.mean_step();
}

}  // namespace dynlab::inline numerics
