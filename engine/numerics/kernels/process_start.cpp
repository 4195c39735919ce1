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

// Everything between gain and delay: {T}, {T1, T2} with T1 >= T2, or {Tw, Zeta}.
std::vector<Vector> shapes(const ProcessStructure& structure, Index N) {
    const double fastest = 1.0 / 3, slowest = 3 * static_cast<double>(N);
    std::vector<Vector> all;
    if (structure.poles == 1) {
        for (double T : logarithmic_grid(fastest, slowest, 1.5)) all.push_back(Vector{{T}});
    } else if (structure.underdamped) {
        for (double T : logarithmic_grid(fastest, slowest, 1.25))
            for (double zeta : {0.05, 0.2, 0.5, 1.0}) all.push_back(Vector{{T, zeta}});
    } else {
        const std::vector<double> times = logarithmic_grid(fastest, slowest, 2);
        for (double T1 : times)
            for (double T2 : times)
                if (T2 <= T1) all.push_back(Vector{{T1, T2}});
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

// The part of the problem that is linear once a shape is chosen: gain, initial values, offset. Least squares on
// evenly chosen rows, where only the gain's column changes with the delay.
class LinearPart {
  public:
    LinearPart(const ProcessOutput& model, const VectorView& y, const Vector& shape) : model_(model), shape_(shape) {
        const Index N = y.size(), values = model.initial_values();
        stride_ = (N + kRows - 1) / kRows;
        const ProcessCoefficients c =
            process_coefficients(model.structure(), theta_at(0).head(model.model_parameters()));
        response_ = transfer_response(c.num, c.den, c.delay, model.input(), 1, model.hold());
        fixed_.resize((N + stride_ - 1) / stride_, values + (model.has_offset() ? 1 : 0));
        if (values > 0) fixed_.leftCols(values) = thinned(free_responses(c.den, N, 1));
        if (model.has_offset()) fixed_.rightCols(1).setOnes();
        y_ = thinned(y);
        const Index count = 1 + fixed_.cols();
        gram_ = Matrix::Zero(count, count);
        gram_.bottomRightCorner(fixed_.cols(), fixed_.cols()) = fixed_.transpose() * fixed_;
        moment_ = Vector::Zero(count);
        moment_.tail(fixed_.cols()) = fixed_.transpose() * y_;
    }

    // Solves for a delay of `shift` samples more than the least one; returns the mean square error.
    double solve(Index shift) {
        set_gain_column(shift);
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
        theta.tail(solution_.size() - 1) = solution_.tail(solution_.size() - 1);
        return theta;
    }

  private:
    Matrix thinned(const Matrix& all) const { return all(Eigen::seq(0, all.rows() - 1, stride_), Eigen::all); }

    Vector theta_at(Index shift) const {
        Vector theta = Vector::Zero(model_.parameter_count());
        theta[0] = 1;
        theta.segment(1, shape_.size()) = shape_;
        const Index last = model_.model_parameters() - 1;
        if (model_.structure().delay) theta[last] = model_.lower()[last] + static_cast<double>(shift);
        return theta;
    }

    void set_gain_column(Index shift) {
        using Thinned = Eigen::Map<const Vector, 0, Eigen::InnerStride<>>;
        const Index silent = std::min(y_.size(), (shift + stride_ - 1) / stride_), rest = y_.size() - silent;
        Vector column = Vector::Constant(y_.size(), model_.resting_input());
        if (rest > 0)
            column.tail(rest) +=
                Thinned(response_.data() + silent * stride_ - shift, rest, Eigen::InnerStride<>(stride_));
        gram_(0, 0) = column.squaredNorm();
        gram_.row(0).tail(fixed_.cols()) = column.transpose() * fixed_;
        gram_.col(0).tail(fixed_.cols()) = gram_.row(0).tail(fixed_.cols()).transpose();
        moment_[0] = column.dot(y_);
    }

    const ProcessOutput& model_;
    Vector shape_, response_;
    Index stride_ = 1;
    Matrix fixed_, gram_;
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
