#include "numerics/criteria/grey_output.h"

#include <utility>

#include "numerics/simulation/sensitivity_solver.h"

namespace dynlab::inline numerics {
namespace {

std::vector<Index> places_of(const std::vector<bool>& marked) {
    std::vector<Index> places;
    for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i]) places.push_back(static_cast<Index>(i));
    return places;
}

const IdData& checked(const IdData& data, const GreyModel& model) {
    if (data.experiments.empty() || data.output_count() < 1)
        throw InvalidArgument("A grey-box model needs data with at least one output");
    if (data.input_count() < model.inputs)
        throw InvalidArgument("The model has {}, but the data have {}", plural(model.inputs, "{} input", "{} inputs"),
                              data.input_count());
    return data;
}

}  // namespace

GreyOutput::GreyOutput(const IdData& data, const GreyModel& model, const Vector& parameters,
                       std::optional<Matrix> initial, const Vector& weights, double relative_tolerance)
    : model_(model),
      parameters_(parameters),
      weights_(weights),
      initial_(std::move(initial)),
      free_(model.free_parameters()),
      estimated_(places_of(model.estimated_initial)),
      simulator_(model, checked(data, model).output_count(), {free_, estimated_}, relative_tolerance) {
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        inputs_.push_back({data.experiments[k].u.leftCols(model.inputs), data.time(k), data.hold});
        measured_.push_back(data.experiments[k].y);
    }
    set_free(free_count() + static_cast<Index>(estimated_.size() * measured_.size()));
    for (Index q = 0; q < free_count(); ++q) {
        const GreyParameter& parameter = model.parameters[static_cast<std::size_t>(free_[static_cast<std::size_t>(q)])];
        lower_[q] = parameter.lower;
        upper_[q] = parameter.upper;
    }
}

Vector GreyOutput::measured() const {
    Index rows = 0;
    for (const Matrix& y : measured_) rows += y.size();
    Vector all(rows);
    Index first = 0;
    for (const Matrix& y : measured_) {
        all.segment(first, y.size()) = (y * weights_.asDiagonal()).reshaped();
        first += y.size();
    }
    return all;
}

Vector GreyOutput::parameters(const Vector& theta) const {
    Vector all = parameters_;
    for (std::size_t q = 0; q < free_.size(); ++q) all[free_[q]] = theta[static_cast<Index>(q)];
    return all;
}

Vector GreyOutput::start() const {
    Vector theta(parameter_count());
    for (std::size_t q = 0; q < free_.size(); ++q) theta[static_cast<Index>(q)] = parameters_[free_[q]];
    const Vector own = simulator_.initial_state(parameters_);
    Index next = free_count();
    for (std::size_t k = 0; k < measured_.size(); ++k)
        for (const Index state : estimated_)
            theta[next++] = initial_ ? (*initial_)(state, static_cast<Index>(k)) : own[state];
    return theta;
}

Matrix GreyOutput::initial_states(const Vector& theta) const {
    const auto experiments = static_cast<Index>(measured_.size());
    Matrix all = initial_ ? *initial_ : simulator_.initial_state(parameters(theta)).replicate(1, experiments);
    Index next = free_count();
    for (Index k = 0; k < experiments; ++k)
        for (const Index state : estimated_) all(state, k) = theta[next++];
    return all;
}

std::vector<GreyTrajectory> GreyOutput::trajectories(const Vector& theta, bool sensitivities) const {
    const Vector all = parameters(theta);
    const auto states = static_cast<Index>(estimated_.size());
    std::vector<GreyTrajectory> runs;
    for (std::size_t k = 0; k < inputs_.size(); ++k) {
        const auto experiment = static_cast<Index>(k);
        const Vector replaced = initial_ ? Vector(initial_->col(experiment)) : Vector();
        runs.push_back(
            simulator_.run(all, inputs_[k],
                           {initial_ ? &replaced : nullptr, theta.segment(free_count() + experiment * states, states)},
                           sensitivities));
    }
    return runs;
}

void GreyOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    Index rows = 0;
    for (const Matrix& y : measured_) rows += y.size();
    output = Vector::Constant(rows, kNaN);
    if (sensitivities != nullptr) *sensitivities = Matrix::Zero(rows, parameter_count());
    std::vector<GreyTrajectory> runs;
    try {
        runs = trajectories(theta, sensitivities != nullptr);
    } catch (const SimulationBreakdown&) {
        return;
    }
    const auto states = static_cast<Index>(estimated_.size());
    Index first = 0, values = free_count();
    for (const GreyTrajectory& run : runs) {
        const Index N = run.y.rows();
        for (Index i = 0; i < run.y.cols(); ++i) {
            output.segment(first, N) = weights_[i] * run.y.col(i);
            if (sensitivities != nullptr) {
                const auto rows_of_output = run.sensitivities.middleRows(i * N, N);
                sensitivities->block(first, 0, N, free_count()) = weights_[i] * rows_of_output.leftCols(free_count());
                sensitivities->block(first, values, N, states) = weights_[i] * rows_of_output.rightCols(states);
            }
            first += N;
        }
        values += states;
    }
}

}  // namespace dynlab::inline numerics
