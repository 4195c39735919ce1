#include "numerics/signals/preprocess.h"

#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

/// Takes the mean or the least-squares line off each column; `t` counts from the first sample.
void remove_line(Matrix& signals, const Vector& t, TrendKind kind) {
    const Eigen::RowVectorXd mean = signals.colwise().mean();
    signals.rowwise() -= mean;
    if (kind == TrendKind::kConstant) return;
    const Vector centered = t.array() - t.mean();
    const Eigen::RowVectorXd slope = centered.transpose() * signals / centered.squaredNorm();
    signals -= centered * slope;
}

constexpr double kStays = 0.05;  // part of an input's range within which it counts as not yet changed
constexpr Index kMinRemaining = 3;

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
        throw InvalidArgument("detrend: the level of the first {} samples was requested, but the experiment has {}",
                              samples, experiment.y.rows());
    if (samples > 0) return samples;
    if (experiment.u.cols() == 0)
        throw InvalidArgument(
            "detrend: without an input, the end of the initial rest is unknown; specify the number of samples, as in "
            "detrend(data, \"start\", {samples = 20})");
    const Index found = samples_before_change(experiment.u);
    if (found >= kMinRemaining) return found;
    throw InvalidArgument(
        "detrend: the input already changes at sample {}, so the data contain no initial level. Remove the mean "
        "instead, or specify the number of samples to use, as in detrend(data, \"start\", {samples = 20})",
        found + 1);
}

/// Takes off each column the mean of its first `count` samples.
void remove_first_level(Matrix& signals, Index count) {
    const Eigen::RowVectorXd level = signals.topRows(count).colwise().mean();
    signals.rowwise() -= level;
}

}  // namespace

IdData remove_initial_level(IdData data, Index samples) {
    for (Experiment& experiment : data.experiments) {
        const Index count = initial_stretch(experiment, samples);
        for (Matrix* signals : {&experiment.y, &experiment.u, &experiment.r})
            if (signals->cols() > 0) remove_first_level(*signals, count);
    }
    return data;
}

IdData detrend(IdData data, TrendKind kind) {
    for (std::size_t i = 0; i < data.experiments.size(); ++i) {
        Experiment& experiment = data.experiments[i];
        if (kind == TrendKind::kLinear && experiment.y.rows() < 2)
            throw InvalidArgument("detrend: a linear trend needs at least 2 samples, but the experiment has 1");
        const Vector time = data.time(i);
        const Vector since_start = time.array() - time(0);
        for (Matrix* signals : {&experiment.y, &experiment.u, &experiment.r})
            if (signals->cols() > 0) remove_line(*signals, since_start, kind);
    }
    return data;
}

}  // namespace dynlab::inline numerics
