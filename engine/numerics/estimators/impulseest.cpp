#include "numerics/estimators/impulseest.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/fit/spectral_estimate.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/linalg/tall_gram.h"
#include "numerics/number_text.h"
#include "numerics/statistics/chi_squared.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kFewestSamplesOfImpulseest = 8, kMostLags = 400;

/// Rows [u(k) u(k-1) .. u(k-n)] and y(k) of an experiment, without their means over it (which estimates c).
class CentredRows {
  public:
    CentredRows(const Experiment& experiment, Index n)
        : u_(experiment.u.col(0)), y_(experiment.y.col(0).tail(experiment.y.rows() - n)), means_(n + 1) {
        for (Index i = 0; i <= n; ++i) means_[i] = u_.segment(n - i, y_.size()).mean();
        mean_ = y_.mean();
    }
    Index count() const { return y_.size(); }
    void put(Index first, Eigen::Ref<Matrix> Phi, Eigen::Ref<Vector> y) const {
        const Index n = means_.size() - 1;
        for (Index i = 0; i <= n; ++i) Phi.col(i) = u_.segment(first + n - i, Phi.rows()).array() - means_[i];
        y = y_.segment(first, y.size()).array() - mean_;
    }

  private:
    VectorView u_, y_;
    Vector means_;
    double mean_ = 0;
};

struct Regression {
    Matrix Phi;
    Vector y;
};
Regression regression_of(const IdData& data, Index n) {
    Index rows = 0, at = 0;
    for (const Experiment& experiment : data.experiments) rows += experiment.y.rows() - n;
    Regression regression{Matrix(rows, n + 1), Vector(rows)};
    for (const Experiment& experiment : data.experiments) {
        const CentredRows of(experiment, n);
        of.put(0, regression.Phi.middleRows(at, of.count()), regression.y.segment(at, of.count()));
        at += of.count();
    }
    return regression;
}

/// Phi' Phi, Phi' y and y' y, from few rows at a time: a long record needs no memory for the rest of Phi.
struct Sums {
    Matrix gram;
    Vector projection;
    double energy = 0;
};
Sums sums_of(const IdData& data, Index n) {
    constexpr Index kRows = 4096;
    Matrix joint = Matrix::Zero(n + 2, n + 2), Phi(kRows, n + 1);
    Vector y(kRows);
    for (const Experiment& experiment : data.experiments) {
        const CentredRows of(experiment, n);
        for (Index first = 0; first < of.count(); first += kRows) {
            const Index rows = std::min(kRows, of.count() - first);
            of.put(first, Phi.topRows(rows), y.head(rows));
            joint += tall_gram(Phi.topRows(rows), y.head(rows));
        }
    }
    return {joint.topLeftCorner(n + 1, n + 1), joint.col(n + 1).head(n + 1), joint(n + 1, n + 1)};
}

/// Samples that are fitted, without those which the experiments' c take.
double free_samples(const IdData& data, Index n) {
    Index count = 0;
    for (const Experiment& experiment : data.experiments) count += experiment.y.rows() - n - 1;
    return static_cast<double>(count);
}

void fit_plainly(const IdData& data, Index n, ImpulseEstimate& estimate) {
    const Regression regression = regression_of(data, n);
    const LeastSquares fit = solve_least_squares(regression.Phi, regression.y);
    if (fit.rank < regression.Phi.cols() || fit.condition_number > 1e8)
        throw InvalidArgument(
            "impulseest: the input is not persistently exciting enough to determine the " +
            std::to_string(regression.Phi.cols()) +
            " samples of the impulse response; use the smooth estimate, fewer lags, or resample the data to a "
            "lower rate first");
    estimate.response = fit.solution;
    estimate.noise_variance =
        fit.residuals.squaredNorm() / std::max(free_samples(data, n) - static_cast<double>(n + 1), 1.0);
    estimate.std = (estimate.noise_variance * fit.inverse_gram.diagonal().array()).sqrt();
    estimate.null_std = estimate.std;
}

/// Evidence of one decay lambda. With g = sqrt(kappa) sigma L z, z ~ N(0, 1), L L' the kernel of scale one, and the
/// eigenvalues d of L' Phi' Phi L with projections b = U' L' Phi' y, all is a function of kappa alone:
///     sigma^2 = (y'y - sum kappa b^2/(1 + kappa d))/N,  -2 log evidence = N log sigma^2 + sum log(1 + kappa d) + ...
struct Evidence {
    Matrix LU;  ///< L U
    Vector d, b;
    double energy, count;

    double variance(double kappa) const {
        return std::max((energy - (kappa * b.array().square() / (1 + kappa * d.array())).sum()) / count,
                        1e-14 * energy / count);
    }
    double loss(double kappa) const { return count * std::log(variance(kappa)) + (1 + kappa * d.array()).log().sum(); }
};

/// Lower Cholesky factor of the kernel lambda^max(i, j): the kernel is U D U' with U upper triangular ones and
/// D_i = lambda^i - lambda^(i+1), D_n = lambda^n, so any square root serves.
Matrix kernel_root(Index size, double lambda) {
    Matrix root = Matrix::Zero(size, size);
    for (Index j = 0; j < size; ++j) {
        const double power = std::pow(lambda, static_cast<double>(j));
        root.col(j).head(j + 1).setConstant(std::sqrt(j + 1 < size ? power * (1 - lambda) : power));
    }
    return root;
}

struct Choice {
    Evidence evidence;
    double kappa = 0, loss = std::numeric_limits<double>::infinity();
};

/// Smallest loss over kappa: a scan over decades, then golden section.
void choose_scale(Choice& choice) {
    const Evidence& evidence = choice.evidence;
    const double unit = 1 / std::max(evidence.d.maxCoeff(), 1e-300);
    double best = 0;
    for (int i = -8; i <= 48; ++i) {
        const double exponent = 0.5 * i, loss = evidence.loss(unit * std::pow(10, exponent));
        if (loss < choice.loss) choice.loss = loss, best = exponent;
    }
    constexpr double kGolden = 0.6180339887498949;
    double low = best - 0.5, high = best + 0.5;
    const auto loss_at = [&](double exponent) { return evidence.loss(unit * std::pow(10, exponent)); };
    for (int i = 0; i < 25; ++i) {
        const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
        loss_at(left) < loss_at(right) ? high = right : low = left;
    }
    choice.kappa = unit * std::pow(10, (low + high) / 2);
    choice.loss = evidence.loss(choice.kappa);
}

Choice choice_for(const Sums& sums, double count, double lambda) {
    const Matrix L = kernel_root(sums.gram.rows(), lambda);
    const auto [values, vectors] = symmetric_eigen(L.transpose() * sums.gram * L);
    Choice choice;
    choice.evidence.LU = L * vectors;
    choice.evidence.d = values.cwiseMax(0);
    choice.evidence.b = choice.evidence.LU.transpose() * sums.projection;
    choice.evidence.energy = sums.energy;
    choice.evidence.count = count;
    choose_scale(choice);
    return choice;
}

/// Decays are tried so that the prior falls to a thousandth within 3 % to 300 % of the lags.
void fit_smoothly(const Sums& sums, double count, ImpulseEstimate& estimate) {
    constexpr int kDecays = 16;
    Choice best;
    for (int i = 0; i < kDecays; ++i) {
        const double span = std::pow(100.0, static_cast<double>(i) / (kDecays - 1) - 0.75) * 3;
        const double lambda = std::exp(std::log(1e-3) / (span * static_cast<double>(sums.gram.rows())));
        Choice choice = choice_for(sums, count, lambda);
        if (choice.loss < best.loss) best = std::move(choice);
    }
    const Evidence& e = best.evidence;
    const Vector shrink = best.kappa / (1 + best.kappa * e.d.array());
    estimate.response = e.LU * shrink.cwiseProduct(e.b);
    estimate.noise_variance = e.variance(best.kappa);
    const Matrix squares = e.LU.cwiseAbs2();
    estimate.std = (estimate.noise_variance * (squares * shrink)).cwiseSqrt();
    // scatter of the estimate over noise alone, response zero
    estimate.null_std = (estimate.noise_variance * (squares * shrink.cwiseAbs2().cwiseProduct(e.d))).cwiseSqrt();
}

}  // namespace

void ImpulseestOptions::validate() const {
    if (lags < 0 || lags > kMostLags)
        throw InvalidArgument("impulseest: the number of lags must lie between 1 and " + std::to_string(kMostLags) +
                              ", but it is " + std::to_string(lags) +
                              "; resample the data to a lower rate when the response lasts longer");
    normal_half_width(confidence);
}

ImpulseEstimate impulseest(const IdData& data, const ImpulseestOptions& options) {
    options.validate();
    const IdData record = nonparametric_data("impulseest", data, kFewestSamplesOfImpulseest, false);
    Index shortest = record.sample_count();
    for (const Experiment& experiment : record.experiments) shortest = std::min(shortest, experiment.y.rows());
    const Index n = lags_or_default("impulseest", options.lags, shortest);
    const Sums sums = sums_of(record, n);
    if (!(sums.gram.diagonal().maxCoeff() > 0) || !(sums.energy > 0))
        throw InvalidArgument("impulseest: after the first " + std::to_string(n) +
                              " samples nothing changes any more; use fewer lags");
    ImpulseEstimate estimate;
    estimate.t = Vector::LinSpaced(n + 1, 0, static_cast<double>(n)) * data.Ts;
    options.smooth ? fit_smoothly(sums, free_samples(record, n), estimate) : fit_plainly(record, n, estimate);
    estimate.message = "Impulse response over " + std::to_string(n) + " lags by " +
                       (options.smooth ? "regularised" : "plain") + " least squares.";
    read_dead_time(estimate, data.Ts, normal_half_width(options.confidence));
    const Index tail = std::max<Index>(n / 10, 1);
    if (estimate.response.tail(tail).cwiseAbs().maxCoeff() > 0.1 * estimate.response.cwiseAbs().maxCoeff())
        estimate.warnings.push_back(
            "The response has not died out at the last lag: take more lags, or resample the data to a lower rate.");
    return estimate;
}

}  // namespace dynlab::inline numerics
