#include "numerics/kernels/process_start.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/kernels/transfer_sensitivity.h"

namespace dynlab {

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

// Everything between gain and zero: {T1, T2, T3} in falling order, or {T3, Tw, Zeta}.
std::vector<Vector> shapes(const ProcessStructure& structure, Index N) {
    constexpr double kFastest = 1.0 / 3;
    const double slowest = 3 * static_cast<double>(N);
    constexpr double kRatios[] = {1.5, 2, 2.5};  // the more time constants, the fewer of each
    const double ratio = kRatios[structure.poles - 1];
    if (!structure.underdamped) return real_lags(structure.poles, logarithmic_grid(kFastest, slowest, ratio));
    std::vector<Vector> all;
    const bool alone = structure.poles == 2;
    for (const Vector& lag : real_lags(structure.poles - 2, logarithmic_grid(kFastest, slowest, 4)))
        for (const double T : logarithmic_grid(kFastest, slowest, alone ? 1.25 : 1.5))
            for (const double zeta : {0.05, 0.2, 0.5, 1.0}) {
                all.push_back(Vector(lag.size() + 2));
                all.back() << lag, T, zeta;
            }
    return all;
}

// Whole samples to add to the least delay.
std::vector<Index> delay_shifts(const ProcessOutput& model, int count) {
    if (!model.structure().delay) return {0};
    const Index last = model.model_parameters() - 1;
    const double range = std::floor(model.upper()[last] - model.lower()[last] + 1e-9);
    const double spacing = std::max(1.0, std::ceil(range / std::max(1, count - 1)));
    std::vector<Index> shifts;
    for (double shift = 0; shift <= range; shift += spacing) shifts.push_back(static_cast<Index>(shift));
    return shifts;
}

// What B/A alone makes of the input, seen at any delay: as it is with regular sampling and whole samples, otherwise on
// a fine even grid, the input held or drawn between its samples, and interpolated.
class Responses {
  public:
    Responses(const ProcessOutput& model, const Vector& den, const std::vector<Vector>& nums, double least_delay) {
        const ProcessInput& input = model.input();
        regular_ = input.t.size() == 0;
        const Vector u = regular_ ? input.u : even_input(input);
        columns_.resize(u.size(), static_cast<Index>(nums.size()));
        for (std::size_t i = 0; i < nums.size(); ++i)
            columns_.col(static_cast<Index>(i)) =
                transfer_response(nums[i], den, regular_ ? least_delay : 0, u, regular_ ? 1 : kFineStep, input.hold);
        if (!regular_) later_ = least_delay;
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
            out[i] = interpolated(column, t[i * stride] - later_ - static_cast<double>(shift));
    }

  private:
    static constexpr double kFineStep = 0.25;  // of the mean step

    static Vector even_input(const ProcessInput& input) {
        const Index N = input.u.size();
        const Index count = static_cast<Index>(std::ceil(input.t[N - 1] / kFineStep)) + 2;
        Vector u(count);
        Index now = 0;
        for (Index i = 0; i < count; ++i) {
            const double time = static_cast<double>(i) * kFineStep;
            while (now + 1 < N && input.t[now + 1] <= time) ++now;
            u[i] = input.u[now];
            if (input.hold == Hold::kFoh && now + 1 < N)
                u[i] += (time - input.t[now]) / (input.t[now + 1] - input.t[now]) * (input.u[now + 1] - input.u[now]);
        }
        return u;
    }

    double interpolated(Index column, double time) const {
        if (time < 0) return 0;
        const double position = time / kFineStep;
        const Index left = std::min(static_cast<Index>(position), columns_.rows() - 2);
        const double fraction = position - static_cast<double>(left);
        return columns_(left, column) + fraction * (columns_(left + 1, column) - columns_(left, column));
    }

    bool regular_ = true;
    double later_ = 0;
    Matrix columns_;
};

// The part of the problem that is linear once a shape is chosen: gain (and gain times Tz), initial values, offset.
// Least squares on evenly chosen rows, where only the gain's columns change with the delay.
class LinearPart {
  public:
    LinearPart(const ProcessOutput& model, const VectorView& y, const Vector& shape)
        : model_(model), shape_(shape), gains_(model.structure().zero ? 2 : 1), responses_(responses_for(model)) {
        const Index N = y.size(), values = model.initial_values();
        stride_ = (N + kRows - 1) / kRows;
        fixed_.resize((N + stride_ - 1) / stride_, values + (model.has_offset() ? 1 : 0));
        if (values > 0) fixed_.leftCols(values) = thinned(model.motions(coefficients().den));
        if (model.has_offset()) fixed_.rightCols(1).setOnes();
        y_ = thinned(y);
        const Index count = gains_ + fixed_.cols();
        gram_ = Matrix::Zero(count, count);
        gram_.bottomRightCorner(fixed_.cols(), fixed_.cols()) = fixed_.transpose() * fixed_;
        moment_ = Vector::Zero(count);
        moment_.tail(fixed_.cols()) = fixed_.transpose() * y_;
        varying_.resize(y_.size(), gains_);
    }

    // Solves for a delay of `shift` samples more than the least one; returns the mean square error.
    double solve(Index shift) {
        set_gain_columns(shift);
        Vector scale = gram_.diagonal().cwiseSqrt();
        for (double& value : scale)
            if (!(value > 0)) value = 1;
        Matrix scaled = scale.cwiseInverse().asDiagonal() * gram_ * scale.cwiseInverse().asDiagonal();
        scaled.diagonal().array() += 1e-12;  // keeps columns that look alike from cancelling each other at any size
        solution_ = scaled.ldlt().solve(moment_.cwiseQuotient(scale)).cwiseQuotient(scale);
        const double squares = y_.squaredNorm() - 2 * moment_.dot(solution_) + solution_.dot(gram_ * solution_);
        return std::max(0.0, squares) / static_cast<double>(y_.size());
    }

    // All parameters of the model as the last solve found them.
    Vector theta(Index shift) const {
        Vector theta = theta_at(shift);
        theta[0] = solution_[0];
        if (gains_ == 2 && solution_[0] != 0) theta[zero_place()] = solution_[1] / solution_[0];
        theta.tail(fixed_.cols()) = solution_.tail(fixed_.cols());
        return theta.cwiseMax(model_.lower()).cwiseMin(model_.upper());
    }

  private:
    Matrix thinned(const Matrix& all) const { return all(Eigen::seq(0, all.rows() - 1, stride_), Eigen::all); }
    Index zero_place() const { return model_.model_parameters() - 1 - (model_.structure().delay ? 1 : 0); }

    Vector theta_at(Index shift) const {
        Vector theta = Vector::Zero(model_.parameter_count());
        theta[0] = 1;
        theta.segment(1, shape_.size()) = shape_;
        const Index last = model_.model_parameters() - 1;
        if (model_.structure().delay) theta[last] = model_.lower()[last] + static_cast<double>(shift);
        return theta;
    }

    ProcessCoefficients coefficients() const {
        return process_coefficients(model_.structure(), theta_at(0).head(model_.model_parameters()));
    }

    // For unit gain; with a zero also the derivative of that response.
    Responses responses_for(const ProcessOutput& model) const {
        const ProcessCoefficients c = coefficients();
        const double g = c.num.tail(1)[0];
        std::vector<Vector> nums = {Vector{{g}}};
        if (gains_ == 2) nums.push_back(Vector{{g, 0.0}});
        return Responses(model, c.den, nums, c.delay);
    }

    void set_gain_columns(Index shift) {
        for (Index column = 0; column < gains_; ++column)
            responses_.rows(column, stride_, model_.input().t, shift, varying_.col(column));
        varying_.col(0).array() += model_.resting_input();
        gram_.topLeftCorner(gains_, gains_) = varying_.transpose() * varying_;
        gram_.topRightCorner(gains_, fixed_.cols()) = varying_.transpose() * fixed_;
        gram_.bottomLeftCorner(fixed_.cols(), gains_) = gram_.topRightCorner(gains_, fixed_.cols()).transpose();
        moment_.head(gains_) = varying_.transpose() * y_;
    }

    const ProcessOutput& model_;
    Vector shape_;
    Index gains_;
    Responses responses_;
    Index stride_ = 1;
    Matrix fixed_, gram_, varying_;
    Vector y_, moment_, solution_;
};

bool alike(const Vector& a, const Vector& b) {
    for (Index i = 0; i < a.size(); ++i)
        if (std::abs(std::log(a[i] / b[i])) > std::log(2.5)) return false;
    return true;
}

// The best points that differ in their shape or by more than two steps of the delay's grid.
std::vector<GridPoint> best_that_differ(std::vector<GridPoint> points, const std::vector<Vector>& shapes) {
    std::sort(points.begin(), points.end(), [](const GridPoint& a, const GridPoint& b) { return a.loss < b.loss; });
    std::vector<GridPoint> chosen;
    for (const GridPoint& point : points) {
        if (chosen.size() == kStarts) break;
        const auto close = [&](const GridPoint& other) {
            const std::size_t apart = std::max(point.shift, other.shift) - std::min(point.shift, other.shift);
            return apart <= 2 && alike(shapes[point.shape], shapes[other.shape]);
        };
        if (std::none_of(chosen.begin(), chosen.end(), close)) chosen.push_back(point);
    }
    return chosen;
}

}  // namespace

ProcessScan scan_process_grid(const ProcessOutput& model, const VectorView& y, int delay_count) {
    const std::vector<Vector> all_shapes = shapes(model.structure(), y.size());
    const std::vector<Index> shifts = delay_shifts(model, delay_count);
    Vector losses = Vector::Constant(static_cast<Index>(shifts.size()), std::numeric_limits<double>::infinity());
    std::vector<GridPoint> points;
    points.reserve(all_shapes.size() * shifts.size());
    for (std::size_t shape = 0; shape < all_shapes.size(); ++shape) {
        LinearPart linear(model, y, all_shapes[shape]);
        for (std::size_t i = 0; i < shifts.size(); ++i) {
            const double loss = linear.solve(shifts[i]);
            if (!std::isfinite(loss)) continue;
            double& best = losses[static_cast<Index>(i)];
            best = std::min(best, loss);
            points.push_back({shape, i, loss});
        }
    }
    ProcessScan scan;
    for (const GridPoint& point : best_that_differ(std::move(points), all_shapes)) {
        LinearPart linear(model, y, all_shapes[point.shape]);
        linear.solve(shifts[point.shift]);
        scan.starts.push_back(linear.theta(shifts[point.shift]));
    }
    if (!model.structure().delay) return scan;
    const double least_delay = model.lower()[model.model_parameters() - 1];
    scan.losses = losses;
    scan.delays.resize(losses.size());
    for (Index i = 0; i < losses.size(); ++i)
        scan.delays[i] = least_delay + static_cast<double>(shifts[static_cast<std::size_t>(i)]);
    return scan;
}

}  // namespace dynlab
