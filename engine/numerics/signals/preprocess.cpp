#include "numerics/signals/preprocess.h"

#include <cmath>
#include <string>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

struct Line {
    Vector offset, slope;
};

/// Takes the mean or the least-squares line off each column; `t` counts from the first sample.
Line remove_line(Matrix& signals, const Vector& t, TrendKind kind) {
    const Eigen::RowVectorXd mean = signals.colwise().mean();
    signals.rowwise() -= mean;
    if (kind == TrendKind::kConstant) return {mean.transpose(), Vector::Zero(signals.cols())};
    const double mean_time = t.mean();
    const Vector centred = t.array() - mean_time;
    const Eigen::RowVectorXd slope = centred.transpose() * signals / centred.squaredNorm();
    signals -= centred * slope;
    return {(mean - mean_time * slope).transpose(), slope.transpose()};
}

constexpr double kStays = 0.05;  // part of an input's range within which it counts as not yet changed
constexpr Index kFewestLeft = 3;

/// Samples before the first change of any input; all of them when none changes.
Index samples_before_change(const Matrix& u) {
    for (Index k = 0; k < u.rows(); ++k)
        for (Index i = 0; i < u.cols(); ++i) {
            const double range = u.col(i).maxCoeff() - u.col(i).minCoeff();
            if (std::abs(u(k, i) - u(0, i)) > kStays * range) return k;
        }
    return u.rows();
}

Index initial_stretch(const Experiment& experiment, Index samples) {
    if (samples > experiment.y.rows())
        throw InvalidArgument("detrend: the level of the first " + std::to_string(samples) +
                              " samples was asked for, but the experiment has " + std::to_string(experiment.y.rows()));
    if (samples > 0) return samples;
    if (experiment.u.cols() == 0)
        throw InvalidArgument(
            "detrend: without an input nothing tells where the calm beginning ends; say how many "
            "samples it has, as in detrend(data, \"start\", {samples = 20})");
    const Index found = samples_before_change(experiment.u);
    if (found >= kFewestLeft) return found;
    throw InvalidArgument(
        "detrend: the input changes already at sample " + std::to_string(found + 1) +
        ", so the record shows no level from before; remove the mean instead, or say how many samples "
        "to take, as in detrend(data, \"start\", {samples = 20})");
}

/// Takes off each column the mean of its first `count` samples.
Vector remove_first_level(Matrix& signals, Index count) {
    const Eigen::RowVectorXd level = signals.topRows(count).colwise().mean();
    signals.rowwise() -= level;
    return level.transpose();
}

}  // namespace

Detrended remove_initial_level(const IdData& data, Index samples) {
    Detrended result{data, {}};
    for (Experiment& experiment : result.data.experiments) {
        const Index count = initial_stretch(experiment, samples);
        const Vector output = remove_first_level(experiment.y, count), input = remove_first_level(experiment.u, count);
        Trend trend{output, Vector::Zero(output.size()), input, Vector::Zero(input.size())};
        if (experiment.r.cols() > 0) {
            trend.reference_offset = remove_first_level(experiment.r, count);
            trend.reference_slope = Vector::Zero(experiment.r.cols());
        }
        result.removed.push_back(std::move(trend));
    }
    return result;
}

Detrended detrend(const IdData& data, TrendKind kind) {
    Detrended result{data, {}};
    for (std::size_t i = 0; i < data.experiments.size(); ++i) {
        Experiment& experiment = result.data.experiments[i];
        if (kind == TrendKind::kLinear && experiment.y.rows() < 2)
            throw InvalidArgument("detrend: a straight line needs at least 2 samples, but the experiment has 1");
        const Vector time = data.time(i);
        const Vector since_start = time.array() - time(0);
        const Line output = remove_line(experiment.y, since_start, kind);
        const Line input = remove_line(experiment.u, since_start, kind);
        const Line reference = experiment.r.cols() > 0 ? remove_line(experiment.r, since_start, kind) : Line();
        result.removed.push_back(
            {output.offset, output.slope, input.offset, input.slope, reference.offset, reference.slope});
    }
    return result;
}

}  // namespace dynlab::inline numerics
