#include "numerics/fit/closed_loop/loop_signals.h"

#include <algorithm>
#include <cmath>

#include "numerics/criteria/denominator_group.h"
#include "numerics/error.h"
#include "numerics/fit/diagnosis.h"
#include "numerics/linalg/decompositions.h"
#include "numerics/simulation/lsim.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kMinWeights = 8, kMaxWeights = 128;  // of the projection; doubled in between
constexpr double kHeldReference = 1e-10;    // of the largest diagonal: weights that a held reference does not determine
constexpr double kBelievedController = 50;  // per cent of u that C (r - y) must explain
constexpr double kTimesChance = 4;          // times what as many weights explain of anything by chance
constexpr double kLeastExplained = 0.02;    // least part of u's variance

/// Sums over all experiments, each without its means; the reference is zero before its first sample.
struct ProjectionSums {
    Matrix gram;
    Vector products;
    double energy = 0;
};

Matrix lagged_columns(const VectorView& r, Index weights) {
    Matrix columns(r.size(), weights);
    for (Index i = 0; i < weights; ++i) {
        const Index zeros = std::min(i, r.size());
        columns.col(i).head(zeros).setZero();
        columns.col(i).tail(r.size() - zeros) = r.head(r.size() - zeros);
    }
    return columns.rowwise() - columns.colwise().mean();
}

ProjectionSums projection_sums(const IdData& data, Index weights) {
    ProjectionSums sums{Matrix::Zero(weights, weights), Vector::Zero(weights)};
    for (const Experiment& experiment : data.experiments) {
        const Matrix columns = lagged_columns(experiment.r.col(0), weights);
        const Vector u = experiment.u.col(0).array() - experiment.u.col(0).mean();
        sums.gram.noalias() += columns.transpose() * columns;
        sums.products.noalias() += columns.transpose() * u;
        sums.energy += u.squaredNorm();
    }
    return sums;
}

/// The weights of smallest BIC among the first 8, 16, ... of them, and the part of u's variance that they explain.
struct Projection {
    Vector weights;
    double explained = 0;
};
Projection best_projection(const IdData& data) {
    const Index max_weights = std::clamp<Index>(data.sample_count() / 10, 1, kMaxWeights);
    const ProjectionSums sums = projection_sums(data, max_weights);
    const auto N = static_cast<double>(data.sample_count());
    Projection best;
    double least = kInfinity;
    for (Index count = std::min(kMinWeights, max_weights);; count = std::min(2 * count, max_weights)) {
        Matrix gram = sums.gram.topLeftCorner(count, count);
        gram.diagonal().array() += kHeldReference * gram.diagonal().maxCoeff();
        const Vector weights = solve_semidefinite(gram, sums.products.head(count));
        const double left = std::max(sums.energy - weights.dot(sums.products.head(count)), 1e-12 * sums.energy);
        const double bic = N * std::log(left / N) + static_cast<double>(count) * std::log(N);
        if (bic < least) {
            least = bic;
            best = {weights, 1 - left / sums.energy};
        }
        if (count == max_weights) return best;
    }
}

Vector projected(const VectorView& r, const Vector& weights) {
    Vector u = Vector::Zero(r.size());
    for (Index i = 0; i < std::min(weights.size(), r.size()); ++i)
        u.tail(r.size() - i) += weights[i] * r.head(r.size() - i);
    return u;
}

/// The percentage of u that the controller explains from r - y. The controller's state before the first sample, and an
/// offset or a slope of an integrator, are left out.
double explained_by(const LoopController& controller, const IdData& data, Hold hold_r) {
    double missed = 0, total = 0;
    const Hold hold = controller.sampled() ? Hold::kZoh : Hold::kFoh;
    const Index late = controller.computing_delay;
    for (const Experiment& experiment : data.experiments) {
        const auto r = experiment.r.col(0), y = experiment.y.col(0), u = experiment.u.col(0);
        const Vector made = lsim(controller.C, r, data.Ts, controller.sampled() ? Hold::kZoh : hold_r) -
                            lsim(controller.C, y, data.Ts, hold);
        const Index rows = u.size() - late;
        if (rows < 3) continue;
        Matrix line(rows, 2);
        line.col(0).setOnes();
        line.col(1) = Vector::LinSpaced(rows, -1, 1);
        const Vector error = u.tail(rows) - made.head(rows);
        missed += (error - line * solve_by_pivoted_qr(line, error)).squaredNorm();
        total += (u.array() - u.mean()).square().sum();
    }
    return fit_percent_of_sums(missed, total);
}

}  // namespace

void check_loop_data(const std::string& method, const IdData& data, const TransferStructure& structure) {
    if (data.reference_count() == 0)
        throw InvalidArgument(
            "{} needs the reference of the loop, but the data have none: add it with iddata(y, u, Ts, {Reference = r})",
            method);
    if (data.reference_count() > 1 || data.input_count() != 1 || data.output_count() != 1)
        throw InvalidArgument(
            "{} requires a loop with one input, one output and one reference, but the data have {}, {} and {}", method,
            data.input_count(), data.output_count(), data.reference_count());
    if (!data.regular())
        throw InvalidArgument(
            "{} needs regularly sampled data, but these data are sampled irregularly: interpolate them at equally "
            "spaced instants first (interp1)",
            method);
    if (structure.free_delays)
        throw InvalidArgument(
            "{}: this method does not estimate delays; determine the delay in samples in an open-loop experiment, or "
            "compare several delays",
            method);
    const bool constant = std::all_of(data.experiments.begin(), data.experiments.end(),
                                      [](const Experiment& one) { return (one.r.array() == one.r(0, 0)).all(); });
    if (constant)
        throw InvalidArgument(
            "{}: the reference never changes, so the plant's response cannot be separated from the controller's: vary "
            "the reference, for instance with prbs",
            method);
    check_transfer_data(method, data, structure);
}

LoopSignals::LoopSignals(const std::string& method, const IdData& data, const LoopKnowledge& known)
    : method_(method), data_(data), controller_(known.controller), hold_r_(known.hold_r) {
    if (controller_) check_controller(known.find_computing_delay);
}

void LoopSignals::check_controller(bool find_delay) {
    ClosedLoop(TransferFunction(Vector::Zero(1), Vector::Ones(1)), *controller_, data_.Ts);  // says what does not fit
    double explained = explained_by(*controller_, data_, hold_r_);
    if (find_delay && controller_->sampled()) {
        LoopController slower = *controller_;
        slower.computing_delay += 1;
        const double later = explained_by(slower, data_, hold_r_);
        if (later > explained) {
            controller_ = slower;
            explained = later;
        }
    }
    if (!(explained > kBelievedController))
        warning_ = Message(
            "With this controller, reference minus output explains only {} % of the measured input. Check the sign, "
            "gain and sampling time of the controller, and whether an offset or a trend was removed from the signals.",
            significant(std::max(explained, 0.0), 2));
}

LoopSignals::All LoopSignals::of_model(const TransferFunction& model) const {
    All all;
    std::optional<ClosedLoop> loop;
    if (controller_) loop.emplace(model, *controller_, data_.Ts, hold_r_);
    all.in_loop = loop && loop->stable();
    if (all.in_loop) {
        for (const Experiment& experiment : data_.experiments) {
            ClosedLoop::Response response = loop->to_reference(experiment.r.col(0));
            all.experiments.push_back({std::move(response.u), std::move(response.x)});
        }
        return all;
    }
    const TransferFunction held(model.num(), reflect_unstable_roots(model.den()), 0, model.delay());
    for (const Vector& u : projected_inputs()) all.experiments.push_back({u, lsim(held, u, data_.Ts, data_.hold)});
    return all;
}

const std::vector<Vector>& LoopSignals::projected_inputs() const {
    if (!projected_.empty()) return projected_;
    const Projection projection = best_projection(data_);
    const double chance =
        kTimesChance * static_cast<double>(projection.weights.size()) / static_cast<double>(data_.sample_count());
    if (!(projection.explained > std::max(kLeastExplained, chance)))
        throw InvalidArgument(
            "{}: the reference explains no more than {} % of the input, so it cannot be used for estimation: check "
            "that the reference belongs to this loop",
            method_, significant(100 * std::max(projection.explained, 0.0), 2));
    for (const Experiment& experiment : data_.experiments)
        projected_.push_back(projected(experiment.r.col(0), projection.weights));
    return projected_;
}

IdData with_projected_inputs(const IdData& data, const LoopSignals& signals) {
    IdData result = data;
    for (std::size_t e = 0; e < result.experiments.size(); ++e)
        result.experiments[e].u.col(0) = signals.projected_inputs()[e];
    return result;
}

}  // namespace dynlab::inline numerics
