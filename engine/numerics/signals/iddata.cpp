#include "numerics/signals/iddata.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/error.h"
#include "numerics/signals/checks.h"

namespace dynlab::inline numerics {

namespace {

void check_channels(const Matrix& y, const Matrix& u) {
    if (y.cols() == 0 && u.cols() == 0)
        throw InvalidArgument("iddata: the data need at least one output, or, for a simulation, at least one input");
    if (u.cols() > 0 && u.rows() != y.rows())
        throw InvalidArgument("iddata: the output has {}, but the input has {}",
                              plural(y.rows(), "{} sample", "{} samples"), u.rows());
    if (y.cols() > 0) {
        check_samples("iddata", SignalName::kOutput, y);
        check_magnitudes("iddata", SignalName::kOutput, y);
    }
    if (u.cols() == 0) return;
    check_samples("iddata", SignalName::kInput, u);
    check_magnitudes("iddata", SignalName::kInput, u);
}

std::vector<std::string> numbered_names(const std::string& stem, Index count) {
    std::vector<std::string> names;
    for (Index i = 1; i <= count; ++i) names.push_back(stem + std::to_string(i));
    return names;
}

enum class Channels { kInputs, kOutputs };

/// Of the channels of a part of a merger, where both are known.
void check_same_units(const std::vector<std::string>& first, const std::vector<std::string>& units, Channels kind,
                      std::size_t part) {
    for (std::size_t i = 0; i < std::min(first.size(), units.size()); ++i) {
        if (first[i].empty() || units[i].empty() || first[i] == units[i]) continue;
        if (kind == Channels::kInputs)
            throw InvalidArgument(
                "merge: in part {}, the unit of input {} is {}, but in the first part it is {}. Convert the input to "
                "the same unit",
                part, i + 1, units[i], first[i]);
        throw InvalidArgument(
            "merge: in part {}, the unit of output {} is {}, but in the first part it is {}. Convert the output to the "
            "same unit",
            part, i + 1, units[i], first[i]);
    }
}

const Experiment& only_experiment(const IdData& data, const std::string& caller) {
    if (data.experiments.size() != 1)
        throw InvalidArgument(
            "{}: the data must have one experiment, but they have {}; select one with data:experiment(k)", caller,
            data.experiments.size());
    return data.experiments.front();
}

/// Copies rows first, first + 1, ... (0-based) of one experiment.
Experiment cut(const IdData& data, const Experiment& experiment, Index first, Index count) {
    Experiment part;
    part.y = experiment.y.middleRows(first, count);
    part.u = experiment.u.middleRows(first, count);
    if (experiment.r.cols() > 0) part.r = experiment.r.middleRows(first, count);
    part.name = experiment.name;
    part.start_time = experiment.start_time + static_cast<double>(first) * data.Ts;
    if (experiment.t.size() > 0) {
        part.t = experiment.t.segment(first, count);
        part.start_time = part.t(0);
    }
    return part;
}

template <class Value>
std::vector<Value> pick(const std::vector<Value>& values, const std::vector<Index>& chosen) {
    std::vector<Value> picked;
    for (const Index channel : chosen) picked.push_back(values[static_cast<std::size_t>(channel - 1)]);
    return picked;
}

Matrix pick_columns(const Matrix& signals, const std::vector<Index>& chosen) {
    Matrix picked(signals.rows(), static_cast<Index>(chosen.size()));
    for (std::size_t i = 0; i < chosen.size(); ++i) picked.col(static_cast<Index>(i)) = signals.col(chosen[i] - 1);
    return picked;
}

void check_selection(const std::vector<Index>& chosen, Index count, Channels kind) {
    for (const Index channel : chosen) {
        if (channel >= 1 && channel <= count) continue;
        if (kind == Channels::kInputs)
            throw InvalidArgument("select: unknown input {}; the data have {}", channel,
                                  plural(count, "{} input", "{} inputs"));
        throw InvalidArgument("select: unknown output {}; the data have {}", channel,
                              plural(count, "{} output", "{} outputs"));
    }
}

}  // namespace

IdData::IdData() = default;
IdData::IdData(const IdData&) = default;
IdData::IdData(IdData&&) noexcept = default;
IdData& IdData::operator=(const IdData&) = default;
IdData& IdData::operator=(IdData&&) noexcept = default;
IdData::~IdData() = default;

IdData::IdData(Matrix y, Matrix u, double sampling_time) : Ts(sampling_time) {
    check_sampling_time("iddata", Ts);
    check_channels(y, u);
    if (u.cols() == 0) u.resize(y.rows(), 0);
    input_names = numbered_names("u", u.cols());
    output_names = numbered_names("y", y.cols());
    input_units.resize(input_names.size());
    output_units.resize(output_names.size());
    experiments.push_back({std::move(y), std::move(u), Vector(), 0, ""});
}

IdData::IdData(Matrix y, Matrix u, const VectorView& t) : IdData(std::move(y), std::move(u), 1.0) {
    Experiment& experiment = experiments.front();
    if (t.size() != experiment.y.rows())
        throw InvalidArgument("iddata: the output has {}, but the time vector has {}",
                              plural(experiment.y.rows(), "{} sample", "{} samples"), t.size());
    check_instants("iddata", t);
    Ts = 0;
    experiment.t = t;
    experiment.start_time = t(0);
}

Index IdData::sample_count() const {
    Index count = 0;
    for (const Experiment& experiment : experiments) count += experiment.y.rows();
    return count;
}

Vector IdData::time(std::size_t experiment) const {
    const Experiment& data_set = experiments.at(experiment);
    if (data_set.t.size() > 0) return data_set.t;
    Vector t(data_set.y.rows());
    for (Index k = 0; k < t.size(); ++k) t(k) = data_set.start_time + static_cast<double>(k) * Ts;
    return t;
}

double IdData::duration(std::size_t experiment) const {
    const Experiment& data_set = experiments.at(experiment);
    if (data_set.t.size() > 0) return data_set.t[data_set.t.size() - 1] - data_set.t[0];
    return static_cast<double>(data_set.y.rows() - 1) * Ts;
}

double IdData::mean_step() const {
    if (regular()) return Ts;
    double total = 0;
    for (std::size_t e = 0; e < experiments.size(); ++e) total += duration(e);
    const Index steps = sample_count() - static_cast<Index>(experiments.size());
    return steps > 0 ? total / static_cast<double>(steps) : 1;
}

IdData IdData::range(Index first, Index last) const {
    const Experiment& experiment = only_experiment(*this, "range");
    const Index count = experiment.y.rows();
    if (first < 1 || last > count || first > last)
        throw InvalidArgument(
            "range: {} to {} is not a valid range; the data have samples 1 to {}. The first sample must not be after "
            "the last sample",
            first, last, count);
    IdData part = *this;
    part.experiments.front() = cut(*this, experiment, first - 1, last - first + 1);
    return part;
}

IdData IdData::with_reference(Matrix r) const {
    const Index count = only_experiment(*this, "iddata").y.rows();
    if (r.rows() != count)
        throw InvalidArgument("iddata: the data have {}, but the reference has {}",
                              plural(count, "{} sample", "{} samples"), r.rows());
    check_samples("iddata", SignalName::kReference, r);
    check_magnitudes("iddata", SignalName::kReference, r);
    IdData result = *this;
    result.experiments.front().r = std::move(r);
    return result;
}

IdData IdData::select(const std::vector<Index>& outputs, const std::vector<Index>& inputs) const {
    check_selection(outputs, output_count(), Channels::kOutputs);
    check_selection(inputs, input_count(), Channels::kInputs);
    if (outputs.empty()) throw InvalidArgument("select: choose at least one output");
    IdData part = *this;
    for (Experiment& experiment : part.experiments) {
        experiment.y = pick_columns(experiment.y, outputs);
        experiment.u = pick_columns(experiment.u, inputs);
    }
    part.input_names = pick(input_names, inputs);
    part.input_units = pick(input_units, inputs);
    part.output_names = pick(output_names, outputs);
    part.output_units = pick(output_units, outputs);
    return part;
}

std::pair<IdData, IdData> IdData::split(double fraction) const {
    const Index count = only_experiment(*this, "split").y.rows();
    const double requested = std::round(fraction * static_cast<double>(count));
    if (!(requested >= 1) || !(requested < static_cast<double>(count)))
        throw InvalidArgument(
            "split: the fraction must leave at least one sample in each part of the data (number of samples: {}), but "
            "it is {}",
            count, fraction);
    const Index first_part = static_cast<Index>(requested);
    return {range(1, first_part), range(first_part + 1, count)};
}

IdData IdData::shifted(Index samples) const {
    if (!regular())
        throw InvalidArgument(
            "shift: irregularly sampled data cannot be shifted by whole samples; interpolate them first (interp1)");
    IdData result = *this;
    for (Experiment& experiment : result.experiments) {
        const Index lost = std::abs(samples), kept = experiment.y.rows() - lost;
        if (kept < 1)
            throw InvalidArgument("shift: a shift by {} would remove all samples, because an experiment has only {}",
                                  plural(samples, "{} sample", "{} samples"),
                                  plural(experiment.y.rows(), "{} sample", "{} samples"));
        const Matrix u = experiment.u.middleRows(samples >= 0 ? 0 : lost, kept);
        experiment = cut(*this, experiment, samples >= 0 ? lost : 0, kept);
        experiment.u = u;
    }
    return result;
}

IdData IdData::merge(const std::vector<IdData>& parts) {
    if (parts.empty()) throw InvalidArgument("merge: specify at least one data object");
    IdData merged = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const IdData& part = parts[i];
        if (part.output_count() != merged.output_count() || part.input_count() != merged.input_count())
            throw InvalidArgument(
                "merge: part {} has {} and {}, but the first part has {} and {}. Select the same channels in both "
                "parts with data:select",
                i + 1, plural(part.output_count(), "{} output", "{} outputs"),
                plural(part.input_count(), "{} input", "{} inputs"), merged.output_count(), merged.input_count());
        if (part.reference_count() != merged.reference_count())
            throw InvalidArgument(
                "merge: part {} has {}, but the number of references in the first part is {}. Add the reference to all "
                "parts or to none",
                i + 1, plural(part.reference_count(), "{} reference", "{} references"), merged.reference_count());
        if (part.regular() && !merged.regular())
            throw InvalidArgument(
                "merge: part {} is sampled regularly, but the first part is sampled irregularly. Interpolate the first "
                "part at equally spaced instants (interp1)",
                i + 1);
        if (!part.regular() && merged.regular())
            throw InvalidArgument(
                "merge: part {} is sampled irregularly, but the first part is sampled regularly. Interpolate part {} "
                "at "
                "equally spaced instants (interp1)",
                i + 1, i + 1);
        if (part.Ts != merged.Ts)
            throw InvalidArgument(
                "merge: part {} has a sampling time of {} {}, but the first part has {} {}: convert both to the same "
                "sampling time with resample or interp1",
                i + 1, part.Ts, part.time_unit, merged.Ts, merged.time_unit);
        if (part.time_unit != merged.time_unit)
            throw InvalidArgument(
                "merge: part {} has the time unit {}, but the first part has {}. Convert the time of one part, and "
                "specify the same time unit",
                i + 1, part.time_unit, merged.time_unit);
        if (part.hold == Hold::kZoh && merged.hold != Hold::kZoh)
            throw InvalidArgument(
                "merge: the input of part {} has a zero-order hold (zoh), but the input of the first part is linearly "
                "interpolated (foh). Specify the same interpolation for both parts",
                i + 1);
        if (part.hold != Hold::kZoh && merged.hold == Hold::kZoh)
            throw InvalidArgument(
                "merge: the input of part {} is linearly interpolated (foh), but the input of the first part has a "
                "zero-order hold (zoh). Specify the same interpolation for both parts",
                i + 1);
        check_same_units(merged.input_units, part.input_units, Channels::kInputs, i + 1);
        check_same_units(merged.output_units, part.output_units, Channels::kOutputs, i + 1);
        merged.experiments.insert(merged.experiments.end(), part.experiments.begin(), part.experiments.end());
    }
    return merged;
}

}  // namespace dynlab::inline numerics
