#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/linalg/decompositions.h"
#include "numerics/linalg/least_squares.h"
#include "numerics/signals/robust_statistics.h"
#include "numerics/simulation/lsim.h"
#include "numerics/statistics/autoregression.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/model_issues.h"

namespace dynlab::inline numerics {

namespace {

constexpr double kNonlinearLevel = 1e-6;
constexpr double kNonlinearEffect = 0.02;  // of the output's standard deviation
constexpr double kNonlinearShare = 0.05;   // of what linear terms leave of the error's power
constexpr Index kLinearLags = 10;
constexpr Index kMaxErrorMemory = 20;
constexpr double kDependent = 1e-8;  // of its power that a column must keep beside the others

enum class Curve { kInput, kOutput, kInputPlay, kOutputPlay, kGain };

/// Columns of one kind of nonlinearity.
struct Family {
    Curve kind;
    Index first, count;
};

/// The window's error and what might explain it.
struct NonlinearRegression {
    Matrix columns;  // linear ones, then the families', then the error
    Index linear = 0;
    std::vector<Family> families;
};

double range_in(const Vector& x) {
    return x.maxCoeff() - x.minCoeff();
}

double quantile_of(Vector x, double part) {
    const auto place = static_cast<Index>(part * static_cast<double>(x.size() - 1));
    std::nth_element(x.begin(), x.begin() + place, x.end());
    return x[place];
}

/// max(0, x - t), for thresholds over the range: together with x any broken line.
std::vector<Vector> broken_lines(const Vector& x) {
    std::vector<Vector> lines;
    const double low = quantile_of(x, 0.01), high = quantile_of(x, 0.99);
    for (const double part : {0.1, 0.25, 0.4, 0.6, 0.75, 0.9})
        lines.emplace_back((x.array() - (low + part * (high - low))).cwiseMax(0));
    return lines;
}

/// What backlash of several widths makes of x (the play operator), less x.
std::vector<Vector> plays(const Vector& x) {
    std::vector<Vector> all;
    for (const double part : {0.03, 0.08, 0.15}) {
        const double half = part * range_in(x);
        Vector y(x.size());
        double now = x[0];
        for (Index k = 0; k < x.size(); ++k) {
            now = std::clamp(now, x[k] - half, x[k] + half);
            y[k] = now - x[k];
        }
        all.push_back(std::move(y));
    }
    return all;
}

Vector late(const Vector& x, Index lag) {
    Vector y(x.size());
    y.head(lag).setConstant(x[0]);
    y.tail(x.size() - lag) = x.head(x.size() - lag);
    return y;
}

/// Samples in which the simulated output changes much: the spacing of the linear terms.
Index spacing_of(const Vector& x) {
    const double step =
        std::sqrt((x.tail(x.size() - 1) - x.head(x.size() - 1)).squaredNorm() / static_cast<double>(x.size() - 1));
    const double spread = standard_deviation(x);
    return std::clamp<Index>(static_cast<Index>(0.35 * spread / step), 1, std::max<Index>(1, x.size() / 100));
}

/// The simulated response to w, from rest at its first value.
Vector response_to(const FittedData& fit, const Vector& w) {
    const IdData& window = fit.window.data;
    return lsim(fit.model(), w.array() - w[0], window.Ts, window.hold);
}

NonlinearRegression nonlinear_regression(const FittedData& fit) {
    const IdData& window = fit.window.data;
    const Vector u = window.experiments.front().u.col(0);
    const Vector x = response_to(fit, u);
    const Index N = u.size(), spacing = spacing_of(x);
    std::vector<Vector> columns{Vector::Ones(N), Vector::LinSpaced(N, -1, 1)};
    for (Index i = 0; i < kLinearLags; ++i) {
        columns.push_back(late(u, i * spacing));
        columns.push_back(late(x, i * spacing));
    }
    columns.push_back(late(u, 1));
    columns.push_back(late(x, 1));
    NonlinearRegression regression;
    regression.linear = static_cast<Index>(columns.size());
    const auto add = [&](Curve kind, std::vector<Vector> family) {
        regression.families.push_back({kind, static_cast<Index>(columns.size()), static_cast<Index>(family.size())});
        for (Vector& column : family) columns.push_back(std::move(column));
    };
    const auto responses = [&](std::vector<Vector> family) {
        for (Vector& column : family) column = response_to(fit, column);
        return family;
    };
    add(Curve::kInput, responses(broken_lines(u)));
    add(Curve::kOutput, broken_lines(x));
    add(Curve::kInputPlay, responses(plays(u)));
    add(Curve::kOutputPlay, plays(x));
    const Vector t = Vector::LinSpaced(N, -1, 1);
    add(Curve::kGain, {x.cwiseProduct(t), x.cwiseProduct(t.cwiseAbs2())});
    columns.emplace_back(fit.error(Eigen::seqN(fit.window.first, N, fit.window.step)));
    const Index skipped = std::min(N / 10, kLinearLags * spacing);
    regression.columns.resize(N - skipped, static_cast<Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
        regression.columns.col(static_cast<Index>(i)) = columns[i].tail(N - skipped);
    return regression;
}

/// Eliminates columns from sums of products in sequence; columns that are nearly equal to earlier ones are left out.
class Elimination {
  public:
    explicit Elimination(Matrix gram) : gram_(std::move(gram)), power_(gram_.diagonal()) {}

    Index eliminate(Index first, Index count) {
        Index taken = 0;
        for (Index i = first; i < first + count; ++i) {
            if (!(gram_(i, i) > kDependent * power_[i])) continue;
            const Vector row = gram_.row(i);
            gram_.noalias() -= row * row.transpose() / row[i];
            ++taken;
        }
        return taken;
    }
    double left_of_last() const { return gram_(gram_.rows() - 1, gram_.cols() - 1); }

  private:
    Matrix gram_;
    Vector power_;
};

struct CheckOutcome {
    const Family* family = nullptr;
    double statistic = 0;  // chi-squared in excess of its degrees
    double share = 0;      // of the error left by linear terms
};

/// The error after all columns, from which its memory is learnt. With few samples, so many columns would explain part
/// of that memory, and after the linear ones alone it is safe.
Vector unexplained(const NonlinearRegression& regression) {
    constexpr Index kRowsPerColumn = 20;
    const Index all = regression.columns.cols() - 1;
    const Index d = regression.columns.rows() < kRowsPerColumn * all ? regression.linear : all;
    Matrix basis = regression.columns.leftCols(d);
    const Vector scale = basis.colwise().norm().transpose().cwiseMax(1e-300);
    basis *= scale.cwiseInverse().asDiagonal();
    Matrix gram = basis.transpose() * basis;
    gram.diagonal().array() += 1e-9;
    const Vector e = regression.columns.col(all);
    return e - basis * solve_semidefinite(gram, basis.transpose() * e);
}

CheckOutcome best_family(const NonlinearRegression& regression) {
    const Index rows = regression.columns.rows(), d = regression.columns.cols();
    const Autoregression memory =
        fit_autoregression(unexplained(regression), {rows}, kMaxErrorMemory, AutoregressiveOrder::kBic);
    Matrix white(rows - memory.order(), d);
    for (Index i = 0; i < d; ++i) white.col(i) = filtered_past(memory, regression.columns.col(i));
    Elimination linear(white.transpose() * white);
    linear.eliminate(0, regression.linear);
    const double before = linear.left_of_last();
    CheckOutcome best;
    for (const Family& family : regression.families) {
        Elimination with = linear;
        const Index degrees = with.eliminate(family.first, family.count);
        const double left = with.left_of_last();
        if (degrees == 0 || !(left > 0)) continue;
        const double freedom = static_cast<double>(white.rows() - regression.linear - degrees);
        const double statistic = freedom * (before - left) / before;  // the score test: safe with few samples
        if (chi_squared_upper_tail(statistic, static_cast<double>(degrees)) > kNonlinearLevel / 5) continue;
        if (statistic - static_cast<double>(degrees) < best.statistic) continue;
        best = {&family, statistic - static_cast<double>(degrees), 1 - left / before};
    }
    return best;
}

/// rms of what the family adds to the linear terms.
double effect_of(const NonlinearRegression& regression, const Family& family) {
    Elimination all(regression.columns.transpose() * regression.columns);
    all.eliminate(0, regression.linear);
    const double before = all.left_of_last();
    all.eliminate(family.first, family.count);
    return std::sqrt(std::max(0.0, before - all.left_of_last()) / static_cast<double>(regression.columns.rows()));
}

/// Slopes of the broken line y = f(x) through the window, by least squares, over the parts between the thresholds.
Vector slopes_of_curve(const FittedData& fit) {
    const IdData& window = fit.window.data;
    const Vector x = response_to(fit, window.experiments.front().u.col(0));
    const std::vector<Vector> lines = broken_lines(x);
    const auto parts = static_cast<Index>(lines.size()) + 1;
    Matrix A(x.size(), parts + 1);
    A.col(0).setOnes();
    A.col(1) = x;
    for (Index i = 1; i < parts; ++i) A.col(i + 1) = lines[static_cast<std::size_t>(i - 1)];
    const Vector y = x + fit.error(Eigen::seqN(fit.window.first, x.size(), fit.window.step));
    const Vector bends = solve_least_squares(A, y).solution.tail(parts);
    Vector slopes = bends;
    for (Index i = 1; i < parts; ++i) slopes[i] += slopes[i - 1];
    return slopes;
}

/// Straight in the middle and nearly flat at one end or both: a limit.
bool runs_into_a_limit(const Vector& slopes) {
    constexpr double kFlat = 0.4, kEven = 0.4;
    const Index parts = slopes.size();
    const Vector inner = slopes.segment(2, parts - 4);
    const double usual = inner.mean(), ends = std::min(slopes[0], slopes[parts - 1]);
    return ends < kFlat * usual && inner.maxCoeff() - inner.minCoeff() < kEven * usual;
}

Number in_percent(double effect) {
    return rounded(100 * effect, 1);
}

DataIssue curve_at_output(const FittedData& fit, double effect) {
    if (runs_into_a_limit(slopes_of_curve(fit))) {
        return about(fit, "saturation", Weight::kWarning,
                     Message("{} flattens while a linear model continues to rise: the signal saturates at a limit that "
                             "is hidden by the noise ({} % of its movement is missing). Exclude the saturated samples "
                             "with data:discard, or repeat the experiment with a smaller amplitude.",
                             fit.output(), in_percent(effect)),
                     effect);
    }
    return about(fit, "nonlinear", Weight::kWarning,
                 Message("{} is a nonlinear function of a linear model's output (such as a square law or a limit): "
                         "this effect is {} % of the variation of {}, which no linear model can represent. Use a "
                         "smaller amplitude, or correct the output with the inverse characteristic of its sensor.",
                         fit.output(), in_percent(effect), fit.output()),
                 effect);
}

DataIssue nonlinear_finding(const FittedData& fit, Curve kind, double effect) {
    switch (kind) {
        case Curve::kInput:
            return about(
                fit, "nonlinear", Weight::kWarning,
                Message(
                    "{} acts through a nonlinear characteristic (such as a dead band, a square law or a limit): this "
                    "effect is {} % of the variation of {}, which no linear model can represent. Use a smaller "
                    "amplitude around one operating point, or estimate the characteristic with hammerstein.",
                    fit.input(), in_percent(effect), fit.output()),
                effect);
        case Curve::kInputPlay:
            return about(
                fit, "nonlinear", Weight::kWarning,
                Message("{} acts through backlash or friction, so its effect depends on the direction of movement. "
                        "This effect is {} % of the variation of {}, which no linear model can represent. Use "
                        "movements in one direction only, remove the backlash, or use much larger amplitudes.",
                        fit.input(), in_percent(effect), fit.output()),
                effect);
        case Curve::kOutputPlay:
            return about(fit, "nonlinear", Weight::kWarning,
                         Message("{} shows backlash or friction: it does not follow the movement immediately after a "
                                 "reversal. This effect is {} % of the variation of {}, which no linear model can "
                                 "represent. Remove the backlash, or use much larger amplitudes.",
                                 fit.output(), in_percent(effect), fit.output()),
                         effect);
        case Curve::kGain:
            return about(fit, "changing_gain", Weight::kWarning,
                         Message("The gain from {} to {} changes during the experiment: this effect is {} % of the "
                                 "variation of {}. Fit the parts separately (data:range), and identify the cause, such "
                                 "as a change in temperature, load or supply voltage.",
                                 fit.input(), fit.output(), in_percent(effect), fit.output()),
                         effect);
        case Curve::kOutput:
            break;
    }
    return curve_at_output(fit, effect);
}

}  // namespace

bool gain_explains_error(const FittedData& fit) {
    constexpr double kMainShare = 0.7;
    const Vector& x = fit.simulation.output;
    const Vector t = Vector::LinSpaced(x.size(), -1, 1);
    Matrix columns(x.size(), 5);
    columns << Vector::Ones(x.size()), t, x, x.cwiseProduct(t), x.cwiseProduct(t.cwiseAbs2());
    if (!columns.allFinite() || !fit.error.allFinite()) return false;
    const double line = solve_least_squares(columns.leftCols(3), fit.error).residuals.squaredNorm();
    return solve_least_squares(columns, fit.error).residuals.squaredNorm() < (1 - kMainShare) * line;
}

void find_nonlinearity(const FittedData& fit, DataIssues& findings) {
    const NonlinearRegression regression = nonlinear_regression(fit);
    if (!regression.columns.allFinite()) return;
    const CheckOutcome outcome = best_family(regression);
    if (outcome.family == nullptr || !(outcome.share > kNonlinearShare)) return;
    const double effect = effect_of(regression, *outcome.family) / fit.deviation();
    if (effect > kNonlinearEffect) findings.push_back(nonlinear_finding(fit, outcome.family->kind, effect));
}

}  // namespace dynlab::inline numerics
