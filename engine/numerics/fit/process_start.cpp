#include "numerics/fit/process_start.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "numerics/filters/transfer_sensitivity.h"
#include "numerics/linalg/decompositions.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kRows = 800;
constexpr std::size_t kStarts = 4;

struct GridPoint {
    std::size_t shape, shift;  // positions on the two grids
    double loss;
};

std::vector<double> logarithmic_grid(double from, double to, double ratio) {
    std::vector<double> grid;
    for (double value = from; value < to * ratio; value *= ratio) grid.push_back(value);
    return grid;
}

std::vector<Vector> real_lags(int count, const std::vector<double>& times) {
    std::vector<Vector> all = {Vector()};
    for (int pole = 0; pole < count; ++pole) {
        std::vector<Vector> longer;
        for (const Vector& shape : all)
            for (const double T : times) {
                if (pole > 0 && T > shape[pole - 1]) continue;
                longer.push_back(Vector(pole + 1));
                longer.back() << shape, T;
            }
        all = std::move(longer);
    }
    return all;
}

// Everything between gain and zero: {T1, T2, T3} in falling order, or {T3, Tw, Zeta}, these at the peaks, too.
std::vector<Vector> shapes(const ProcessStructure& structure, Index N, const Vector& peaks) {
    constexpr double kFastest = 1.0 / 3;
    const double slowest = 3 * static_cast<double>(N);
    constexpr double kRatios[] = {1.5, 2, 2.5};  // the more time constants, the fewer of each
    const double ratio = kRatios[structure.poles - 1];
    if (!structure.underdamped) return real_lags(structure.poles, logarithmic_grid(kFastest, slowest, ratio));
    std::vector<Vector> all;
    std::vector<double> times = logarithmic_grid(kFastest, slowest, structure.poles == 2 ? 1.25 : 1.5);
    for (const double w : peaks) times.push_back(1 / w);
    for (const Vector& lag : real_lags(structure.poles - 2, logarithmic_grid(kFastest, slowest, 4)))
        for (const double T : times)
            for (const double zeta : {0.05, 0.2, 0.5, 1.0}) {
                all.push_back(Vector(lag.size() + 2));
                all.back() << lag, T, zeta;
            }
    return all;
}

// What the grid is laid for: a process model, its output in both ways, and where its parameters are.
struct GridProblem {
    GridProblem(const ProcessStructure& process, const TransferOutput& transfer)
        : structure(process), output(transfer), model(process_output(process, transfer)) {
        parameters = model.parameter_count() - output.linear_count();
        for (std::size_t e = 0; e < output.experiment_count(); ++e) longest = std::max(longest, output.rows(e));
    }
    auto input(std::size_t experiment) const { return output.inputs(experiment).col(0); }
    bool regular(std::size_t experiment) const { return output.times(experiment).size() == 0; }

    const ProcessStructure& structure;
    const TransferOutput& output;
    Reparametrized model;
    Index parameters = 0, longest = 0;  // of the process alone; rows
};

// Whole time units to add to the least delay, in rising order.
std::vector<Index> delay_shifts(const GridProblem& problem, int count, const Vector& likely_delays) {
    constexpr Index kNear = 2;
    if (!problem.structure.delay) return {0};
    const Index last = problem.parameters - 1;
    const double least = problem.model.lower()[last];
    const double range = std::floor(problem.model.upper()[last] - least + 1e-9);
    const double spacing = std::max(1.0, std::ceil(range / std::max(1, count - 1)));
    std::set<Index> shifts;
    for (double shift = 0; shift <= range; shift += spacing) shifts.insert(static_cast<Index>(shift));
    for (const double delay : likely_delays) {
        const auto nearest = static_cast<Index>(std::round(delay - least));
        for (Index shift = nearest - kNear; shift <= nearest + kNear; ++shift)
            if (shift >= 0 && static_cast<double>(shift) <= range) shifts.insert(shift);
    }
    return {shifts.begin(), shifts.end()};
}

// What B/A alone makes of the input, seen at any delay, and the free motions: as they are with regular sampling and
// whole samples, otherwise on a fine even grid, the input held or drawn between its samples, and interpolated.
class Responses {
  public:
    Responses(const GridProblem& problem, std::size_t experiment, const Vector& den, const std::vector<Vector>& nums,
              double least_delay) {
        regular_ = problem.regular(experiment);
        const Hold hold = problem.output.hold();
        const Vector u = regular_ ? Vector(problem.input(experiment))
                                  : even_input(problem.input(experiment), problem.output.times(experiment), hold);
        columns_.resize(u.size(), static_cast<Index>(nums.size()));
        for (std::size_t i = 0; i < nums.size(); ++i)
            columns_.col(static_cast<Index>(i)) =
                transfer_response(nums[i], den, regular_ ? least_delay : 0, u, regular_ ? 1 : kFineStep, hold);
        if (!regular_) later_ = least_delay;
    }

    // The motions from unit values of y, dy/dt, ... at the rows 0, stride, ...
    static Matrix motions(const GridProblem& problem, std::size_t experiment, const Vector& den, Index stride) {
        const Index N = problem.output.rows(experiment);
        const auto chosen = Eigen::seq(0, N - 1, stride);
        if (problem.regular(experiment)) return free_responses(den, N, 1)(chosen, Eigen::all);
        const Matrix even = free_responses(den, even_count(problem.output.times(experiment)), kFineStep);
        const Vector t = problem.output.times(experiment)(chosen);
        Matrix rows(t.size(), even.cols());
        for (Index j = 0; j < even.cols(); ++j)
            for (Index i = 0; i < t.size(); ++i) rows(i, j) = interpolated(even.col(j), t[i]);
        return rows;
    }

    // The rows 0, stride, 2 stride, ... for `shift` samples more than the least delay.
    void rows(Index column, Index stride, const Vector& t, Index shift, Eigen::Ref<Vector> out) const {
        if (regular_) {
            using Thinned = Eigen::Map<const Vector, 0, Eigen::InnerStride<>>;
            const Index silent = std::min(out.size(), (shift + stride - 1) / stride), rest = out.size() - silent;
            out.head(silent).setZero();
            const double* first = columns_.col(column).data() + silent * stride - shift;
            if (rest > 0) out.tail(rest) = Thinned(first, rest, Eigen::InnerStride<>(stride));
            return;
        }
        for (Index i = 0; i < out.size(); ++i)
            out[i] = interpolated(columns_.col(column), t[i * stride] - later_ - static_cast<double>(shift));
    }

  private:
    static constexpr double kFineStep = 0.25;  // of the mean step

    static Index even_count(const Vector& t) { return static_cast<Index>(std::ceil(t[t.size() - 1] / kFineStep)) + 2; }

    static Vector even_input(const VectorView& input, const Vector& t, Hold hold) {
        const Index N = input.size(), count = even_count(t);
        Vector u(count);
        Index now = 0;
        for (Index i = 0; i < count; ++i) {
            const double time = static_cast<double>(i) * kFineStep;
            while (now + 1 < N && t[now + 1] <= time) ++now;
            u[i] = input[now];
            if (hold == Hold::kFoh && now + 1 < N)
                u[i] += (time - t[now]) / (t[now + 1] - t[now]) * (input[now + 1] - input[now]);
        }
        return u;
    }

    static double interpolated(const VectorView& even, double time) {
        if (time < 0) return 0;
        const double position = time / kFineStep;
        const Index left = std::min(static_cast<Index>(position), even.size() - 2);
        const double fraction = position - static_cast<double>(left);
        return even[left] + fraction * (even[left + 1] - even[left]);
    }

    bool regular_ = true;
    double later_ = 0;
    Matrix columns_;
};

// The part of the problem that is linear once a shape is chosen: gain (and gain times Tz), initial values, offset.
// Least squares on evenly chosen rows, where only the gain's columns change with the delay.
class LinearPart {
  public:
    LinearPart(const GridProblem& problem, const VectorView& y, const Vector& shape)
        : problem_(problem), output_(problem.output), shape_(shape), gains_(problem.structure.zero ? 2 : 1) {
        stride_ = (y.size() + kRows - 1) / kRows;
        Index rows = 0;
        for (std::size_t e = 0; e < output_.experiment_count(); ++e) {
            first_rows_.push_back(rows);
            rows += (output_.rows(e) + stride_ - 1) / stride_;
        }
        first_rows_.push_back(rows);
        rest_ = Matrix::Zero(rows, output_.linear_count() + 1);
        varying_.resize(rows, gains_);
        set_responses();
        for (std::size_t e = 0; e < output_.experiment_count(); ++e) set_rest(e, y);
        const Index count = gains_ + rest_.cols() - 1;
        gram_ = Matrix::Zero(count, count);
        moment_ = Vector::Zero(count);
        const Matrix products = rest_.transpose() * rest_;
        gram_.bottomRightCorner(fixed(), fixed()) = products.topLeftCorner(fixed(), fixed());
        moment_.tail(fixed()) = products.col(fixed()).head(fixed());
        power_ = products(fixed(), fixed());
    }

    // Solves for a delay of `shift` samples more than the least one; returns the mean square error.
    double solve(Index shift) {
        set_gain_columns(shift);
        Vector scale = gram_.diagonal().cwiseSqrt();
        for (double& value : scale)
            if (!(value > 0)) value = 1;
        Matrix scaled = scale.cwiseInverse().asDiagonal() * gram_ * scale.cwiseInverse().asDiagonal();
        scaled.diagonal().array() += 1e-12;  // keeps columns that look alike from canceling each other at any size
        solution_ = solve_semidefinite(scaled, moment_.cwiseQuotient(scale)).cwiseQuotient(scale);
        const double squares = power_ - 2 * moment_.dot(solution_) + solution_.dot(gram_ * solution_);
        return std::max(0.0, squares) / static_cast<double>(rest_.rows());
    }

    // All parameters of the model as the last solve found them.
    Vector theta(Index shift) const {
        Vector theta = theta_at(shift);
        theta[0] = solution_[0];
        if (gains_ == 2 && solution_[0] != 0) theta[zero_index()] = solution_[1] / solution_[0];
        theta.tail(fixed()) = solution_.tail(fixed());
        return theta.cwiseMax(problem_.model.lower()).cwiseMin(problem_.model.upper());
    }

  private:
    Index fixed() const { return rest_.cols() - 1; }
    Index row_count(std::size_t experiment) const { return first_rows_[experiment + 1] - first_rows_[experiment]; }
    Index zero_index() const { return problem_.parameters - 1 - (problem_.structure.delay ? 1 : 0); }

    Vector theta_at(Index shift) const {
        Vector theta = Vector::Zero(problem_.model.parameter_count());
        theta[0] = 1;
        theta.segment(1, shape_.size()) = shape_;
        const Index last = problem_.parameters - 1;
        if (problem_.structure.delay) theta[last] = problem_.model.lower()[last] + static_cast<double>(shift);
        return theta;
    }

    ProcessCoefficients coefficients() const {
        return process_coefficients(problem_.structure, theta_at(0).head(problem_.parameters));
    }

    // For unit gain; with a zero also the derivative of that response.
    void set_responses() {
        const ProcessCoefficients c = coefficients();
        const double g = c.num.tail(1)[0];
        std::vector<Vector> nums = {Vector{{g}}};
        if (gains_ == 2) nums.push_back(Vector{{g, 0.0}});
        for (std::size_t e = 0; e < output_.experiment_count(); ++e)
            responses_.emplace_back(problem_, e, c.den, nums, c.delay);
    }

    // The chosen rows of what does not change with the delay: free motions and constants, and y.
    void set_rest(std::size_t experiment, const VectorView& y) {
        const auto chosen = Eigen::seq(0, output_.rows(experiment) - 1, stride_);
        auto own = rest_.middleRows(first_rows_[experiment], row_count(experiment));
        const Index before = output_.parameter_count() - output_.linear_count(), values = output_.initial_count(0);
        if (values > 0)
            own.middleCols(output_.initial_start(experiment, 0) - before, values) =
                Responses::motions(problem_, experiment, coefficients().den, stride_);
        if (output_.has_offset()) own.col(output_.offset_index(experiment, 0) - before).setOnes();
        own.col(fixed()) = y.segment(output_.row(experiment, 0), output_.rows(experiment))(chosen);
    }

    void set_gain_columns(Index shift) {
        for (std::size_t e = 0; e < responses_.size(); ++e)
            for (Index column = 0; column < gains_; ++column) {
                auto own = varying_.col(column).segment(first_rows_[e], row_count(e));
                responses_[e].rows(column, stride_, output_.times(e), shift, own);
                if (column == 0) own.array() += output_.resting_inputs(e)[0];
            }
        for (Index column = 0; column < gains_; ++column) {
            const Vector products = rest_.transpose() * varying_.col(column);
            gram_.col(column).tail(fixed()) = products.head(fixed());
            gram_.row(column).tail(fixed()) = products.head(fixed()).transpose();
            moment_[column] = products[fixed()];
            for (Index other = 0; other <= column; ++other)
                gram_(column, other) = gram_(other, column) = varying_.col(column).dot(varying_.col(other));
        }
    }

    const GridProblem& problem_;
    const TransferOutput& output_;
    Vector shape_;
    Index gains_, stride_ = 1;
    std::vector<Responses> responses_;
    std::vector<Index> first_rows_;  // of the chosen ones of each experiment, and their number
    Matrix rest_, gram_, varying_;
    Vector moment_, solution_;
    double power_ = 0;
};

bool alike(const ProcessStructure& structure, const Vector& a, const Vector& b) {
    constexpr double kAlike = 2.5, kSamePeak = 1.3, kResonant = 0.3;
    const Index last = a.size() - 1;
    if (structure.underdamped && std::max(a[last], b[last]) < kResonant &&
        std::abs(std::log(a[last - 1] / b[last - 1])) > std::log(kSamePeak))
        return false;
    for (Index i = 0; i < a.size(); ++i)
        if (std::abs(std::log(a[i] / b[i])) > std::log(kAlike)) return false;
    return true;
}

// The best points that differ in their shape or by more than two steps of the delay's grid.
std::vector<GridPoint> best_that_differ(const ProcessStructure& structure, std::vector<GridPoint> points,
                                        const std::vector<Vector>& shapes) {
    std::sort(points.begin(), points.end(), [](const GridPoint& a, const GridPoint& b) { return a.loss < b.loss; });
    std::vector<GridPoint> chosen;
    for (const GridPoint& point : points) {
        if (chosen.size() == kStarts) break;
        const auto close = [&](const GridPoint& other) {
            const std::size_t apart = std::max(point.shift, other.shift) - std::min(point.shift, other.shift);
            return apart <= 2 && alike(structure, shapes[point.shape], shapes[other.shape]);
        };
        if (std::none_of(chosen.begin(), chosen.end(), close)) chosen.push_back(point);
    }
    return chosen;
}

}  // namespace

ProcessScan scan_process_grid(const ProcessStructure& structure, const TransferOutput& output, int delay_count,
                              const Vector& likely_delays, const Vector& peaks) {
    const GridProblem problem(structure, output);
    const Vector y = output.target();
    const std::vector<Vector> all_shapes = shapes(structure, problem.longest, peaks);
    const std::vector<Index> shifts = delay_shifts(problem, delay_count, likely_delays);
    Vector losses = Vector::Constant(static_cast<Index>(shifts.size()), std::numeric_limits<double>::infinity());
    std::vector<GridPoint> points;
    points.reserve(all_shapes.size() * shifts.size());
    for (std::size_t shape = 0; shape < all_shapes.size(); ++shape) {
        LinearPart linear(problem, y, all_shapes[shape]);
        for (std::size_t i = 0; i < shifts.size(); ++i) {
            const double loss = linear.solve(shifts[i]);
            if (!std::isfinite(loss)) continue;
            double& best = losses[static_cast<Index>(i)];
            best = std::min(best, loss);
            points.push_back({shape, i, loss});
        }
    }
    ProcessScan scan;
    for (const GridPoint& point : best_that_differ(structure, std::move(points), all_shapes)) {
        LinearPart linear(problem, y, all_shapes[point.shape]);
        linear.solve(shifts[point.shift]);
        scan.starts.push_back(linear.theta(shifts[point.shift]));
    }
    if (!structure.delay) return scan;
    const double least_delay = problem.model.lower()[problem.parameters - 1];
    scan.losses = losses;
    scan.delays.resize(losses.size());
    for (Index i = 0; i < losses.size(); ++i)
        scan.delays[i] = least_delay + static_cast<double>(shifts[static_cast<std::size_t>(i)]);
    return scan;
}

}  // namespace dynlab::inline numerics
