#include "numerics/criteria/transfer_output.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"
#include "numerics/filters/transfer_filters.h"
#include "numerics/linalg/polynomial.h"
#include "numerics/linalg/side_by_side.h"

namespace dynlab::inline numerics {

namespace {

constexpr Index kWorthSharing = 5'000;  // samples of inputs: filters run over fewer take less than cores need to meet
constexpr double kFastest = 1e5;        // per time unit: data cannot show faster motions

std::vector<Index> denominators_of(const TransferStructure& structure, Index output) {
    std::vector<Index> different;
    for (Index input = 0; input < structure.inputs; ++input) {
        const Index denominator = structure.channel(output, input).denominator;
        if (std::ranges::find(different, denominator) == different.end()) different.push_back(denominator);
    }
    return different;
}

}  // namespace

Sampling TransferOutput::ExperimentData::sampling() const {
    return {t.size() == 0 ? 1.0 : 0.0, SampleView(t.data(), t.size())};
}

struct TransferOutput::Block {
    const ExperimentData& data_set;
    Eigen::Ref<Vector> output;
    Matrix* sensitivities;
    Index row;

    Eigen::Block<Matrix> columns(Index first, Index count) {
        return sensitivities->block(row, first, output.size(), count);
    }
};

TransferOutput::TransferOutput(const TransferStructure& structure, const StartCondition& condition, const IdData& data,
                               double least_delay, double largest_delay, AtRest at_rest)
    : structure_(structure),
      condition_(condition),
      own_gains_(at_rest == AtRest::kOwnGain && condition.state != InitialState::kZero),
      hold_(data.hold),
      time_unit_(data.mean_step()) {
    if (data.output_count() != structure.outputs || data.input_count() != structure.inputs)
        throw InvalidArgument(
            "The model has {} and {}, but the data have {} and {}", plural(structure.inputs, "{} input", "{} inputs"),
            plural(structure.outputs, "{} output", "{} outputs"), data.input_count(), data.output_count());
    for (Index output = 0; output < structure.outputs; ++output)
        denominators_.push_back(denominators_of(structure, output));
    Index row = 0;
    for (const Experiment& experiment : data.experiments) {
        ExperimentData data_set{experiment.u, experiment.y, Vector::Zero(structure.inputs), {}, row};
        if (condition.state != InitialState::kZero && at_rest != AtRest::kNothing)
            data_set.resting = data_set.u.row(0).transpose();
        data_set.u.rowwise() -= data_set.resting.transpose();
        if (!data.regular()) data_set.t = (experiment.t.array() - experiment.t[0]) / time_unit_;
        row += data_set.y.size();
        samples_ += data_set.y.rows();
        experiments_.push_back(std::move(data_set));
    }
    weights_ = Vector::Ones(structure.outputs);
    set_parameter_count();
    for (Index output = 0; output < structure.outputs; ++output) {
        for (Index input = 0; input < structure.inputs; ++input) set_channel(output, input, least_delay, largest_delay);
        for (std::size_t e = 0; e < experiments_.size(); ++e) set_initial_units(e, output);
    }
}

void TransferOutput::set_parameter_count() {
    const Index experiments = static_cast<Index>(experiments_.size());
    Index count = initial_start(0, 0) + (condition_.offset ? experiments * structure_.outputs : 0);
    for (Index output = 0; output < structure_.outputs; ++output) count += experiments * initial_count(output);
    set_free(count);
    seconds_ = Vector::Ones(count);
}

void TransferOutput::set_channel(Index output, Index input, double least_delay, double largest_delay) {
    const TransferChannel& channel = structure_.channel(output, input);
    const int n = structure_.poles[static_cast<std::size_t>(channel.denominator)];
    for (int i = 1; i <= n; ++i)
        seconds_[structure_.denominator_start(channel.denominator) + i - 1] = std::pow(time_unit_, -i);
    for (int j = 0; j <= channel.zeros; ++j)
        seconds_[structure_.numerator_start(output, input) + j] = std::pow(time_unit_, channel.zeros - j - n);
    if (!structure_.free_delays) return;
    const Index place = structure_.delay_index(output, input);
    lower_[place] = least_delay / time_unit_;
    upper_[place] = largest_delay / time_unit_;
    seconds_[place] = time_unit_;
}

void TransferOutput::set_initial_units(std::size_t experiment, Index output) {
    if (condition_.state != InitialState::kEstimate) return;
    Index place = initial_start(experiment, output);
    for (const Index denominator : denominators_[static_cast<std::size_t>(output)])
        for (int j = 0; j < structure_.poles[static_cast<std::size_t>(denominator)]; ++j)
            seconds_[place++] = std::pow(time_unit_, -j);
}

Index TransferOutput::initial_count(Index output) const {
    if (condition_.state != InitialState::kEstimate) return 0;
    Index count = 0;
    for (const Index denominator : denominators_[static_cast<std::size_t>(output)])
        count += structure_.poles[static_cast<std::size_t>(denominator)];
    return count;
}

Index TransferOutput::initial_start(std::size_t experiment, Index output) const {
    Index of_all = 0, before = 0;
    for (Index o = 0; o < structure_.outputs; ++o) {
        if (o < output) before += initial_count(o);
        of_all += initial_count(o);
    }
    const Index gains = own_gains_ ? structure_.outputs * structure_.inputs : 0;
    return structure_.parameter_count() + gains + static_cast<Index>(experiment) * of_all + before;
}

Index TransferOutput::gain_index(Index output, Index input) const {
    return structure_.parameter_count() + output * structure_.inputs + input;
}

Index TransferOutput::offset_index(std::size_t experiment, Index output) const {
    return initial_start(experiments_.size(), 0) + static_cast<Index>(experiment) * structure_.outputs + output;
}

Index TransferOutput::row(std::size_t experiment, Index output) const {
    return experiments_[experiment].row + output * rows(experiment);
}

std::vector<bool> TransferOutput::bears_on(Index output) const {
    std::vector<bool> bears(static_cast<std::size_t>(parameter_count()), false);
    const auto mark = [&](Index first, Index count) { std::fill_n(bears.begin() + first, count, true); };
    for (Index input = 0; input < structure_.inputs; ++input) {
        const TransferChannel& channel = structure_.channel(output, input);
        mark(structure_.denominator_start(channel.denominator),
             structure_.poles[static_cast<std::size_t>(channel.denominator)]);
        mark(structure_.numerator_start(output, input), channel.zeros + 1 + (structure_.free_delays ? 1 : 0));
        if (own_gains_) mark(gain_index(output, input), 1);
    }
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        mark(initial_start(e, output), initial_count(output));
        if (condition_.offset) mark(offset_index(e, output), 1);
    }
    return bears;
}

void TransferOutput::set_weights(const Vector& weights) {
    weights_ = weights;
}

Vector TransferOutput::target() const {
    Vector y(samples_ * structure_.outputs);
    for (std::size_t e = 0; e < experiments_.size(); ++e)
        for (Index output = 0; output < structure_.outputs; ++output) {
            y.segment(row(e, output), rows(e)) = weights_[output] * experiments_[e].y.col(output);
            y.segment(row(e, output), experiments_[e].silent).setZero();
        }
    return y;
}

void TransferOutput::mask_start(double seconds) {
    const double units = seconds / time_unit_;
    for (ExperimentData& data_set : experiments_) {
        const Index N = data_set.y.rows();
        data_set.silent = 0;
        while (data_set.silent < N &&
               (data_set.t.size() > 0 ? data_set.t[data_set.silent] : static_cast<double>(data_set.silent)) < units)
            ++data_set.silent;
    }
}

Index TransferOutput::masked_rows() const {
    Index rows = 0;
    for (const ExperimentData& data_set : experiments_) rows += data_set.silent * structure_.outputs;
    return rows;
}

bool TransferOutput::usable(const Vector& theta) const {
    for (std::size_t d = 0; d < structure_.poles.size(); ++d) {
        const Index place = structure_.denominator_start(static_cast<Index>(d));
        for (int i = 1; i <= structure_.poles[d]; ++i)
            if (!(std::abs(theta[place + i - 1]) <= std::pow(kFastest, i))) return false;
        if (stable_only_ && !is_hurwitz(monic(theta.segment(place, structure_.poles[d])))) return false;
    }
    return true;
}

void TransferOutput::keep_stable() {
    constexpr double kSlowest = 1e-9;  // per time unit: the i-th coefficient of the slowest poles is its i-th power
    stable_only_ = true;
    // Necessary for stable poles, and bounds can be followed where rejected points cannot.
    for (std::size_t d = 0; d < structure_.poles.size(); ++d)
        for (int i = 1; i <= structure_.poles[d]; ++i)
            lower_[structure_.denominator_start(static_cast<Index>(d)) + i - 1] = std::pow(kSlowest, i);
}

void TransferOutput::fix(const std::map<std::string, double>& values) {
    const std::vector<std::string> names = structure_.parameter_names();
    for (const auto& [name, value] : values) {
        const auto known = std::ranges::find(names, name);
        if (known == names.end())
            throw InvalidArgument("{}: the model has no parameter {}; its parameters are {}", OptionName{"fixed"}, name,
                                  listed(names));
        const Index place = known - names.begin();
        lower_[place] = upper_[place] = value / seconds_[place];
    }
}

void TransferOutput::simulate(const Vector& theta, Vector& output, Matrix* sensitivities) const {
    output.setZero(samples_ * structure_.outputs);
    if (!usable(theta)) {
        if (sensitivities) sensitivities->setZero(output.size(), parameter_count());
        output.setConstant(kInfinity);
        return;
    }
    if (sensitivities) sensitivities->resize(output.size(), parameter_count());
    side_by_side(
        experiments_.size(), [&](std::size_t e) { simulate_experiment(theta, e, output, sensitivities); },
        samples_ * structure_.inputs >= kWorthSharing);
}

void TransferOutput::simulate_experiment(const Vector& theta, std::size_t e, Vector& output,
                                         Matrix* sensitivities) const {
    for (Index o = 0; o < structure_.outputs; ++o) {
        Block block{experiments_[e], output.segment(row(e, o), rows(e)), sensitivities, row(e, o)};
        if (sensitivities) block.columns(0, parameter_count()).setZero();
        for (Index input = 0; input < structure_.inputs; ++input) add_channel(theta, o, input, block);
        if (condition_.state == InitialState::kEstimate) {
            Index place = initial_start(e, o);
            for (const Index denominator : denominators_[static_cast<std::size_t>(o)]) {
                add_free_motion(theta, denominator, place, block);
                place += structure_.poles[static_cast<std::size_t>(denominator)];
            }
        }
        if (condition_.offset) {
            block.output.array() += theta[offset_index(e, o)];
            if (sensitivities) block.columns(offset_index(e, o), 1).setOnes();
        }
        if (weights_[o] != 1) {
            block.output *= weights_[o];
            if (sensitivities) block.columns(0, parameter_count()) *= weights_[o];
        }
        const Index silent = experiments_[e].silent;
        block.output.head(silent).setZero();
        if (sensitivities) sensitivities->middleRows(row(e, o), silent).setZero();
    }
}

void TransferOutput::add_channel(const Vector& theta, Index output, Index input, Block& block) const {
    const Vector num = structure_.numerator(theta, output, input), den = structure_.denominator(theta, output, input);
    const TransferChannel& channel = structure_.channel(output, input);
    const double delay =
        structure_.free_delays ? theta[structure_.delay_index(output, input)] : channel.delay / time_unit_;
    const Index n = den.size() - 1, m = num.size() - 1;
    const Index a = structure_.denominator_start(channel.denominator), b = structure_.numerator_start(output, input);
    const auto u = block.data_set.u.col(input);
    const double resting = block.data_set.resting[input];
    const double gain = own_gains_ ? theta[gain_index(output, input)] : num[m] / den[n];
    if (resting != 0) block.output.array() += gain * resting;
    if (!block.sensitivities) {
        block.output += transfer_filters().response(num, den, delay, u, block.data_set.sampling(), hold_);
        return;
    }
    const Matrix all = transfer_filters().sensitivities(num, den, delay, u, block.data_set.sampling(), hold_);
    block.output += all.col(0);
    block.columns(a, n) += all.middleCols(1, n);
    block.columns(b, m + 1) = all.middleCols(n + 1, m + 1);
    if (structure_.free_delays) block.columns(structure_.delay_index(output, input), 1) = all.rightCols(1);
    if (own_gains_) block.columns(gain_index(output, input), 1).setConstant(resting);
    if (resting == 0 || own_gains_) return;
    block.columns(a + n - 1, 1).array() -= gain / den[n] * resting;
    block.columns(b + m, 1).array() += resting / den[n];
}

void TransferOutput::add_free_motion(const Vector& theta, Index denominator, Index place, Block& block) const {
    const Index n = structure_.poles[static_cast<std::size_t>(denominator)],
                a = structure_.denominator_start(denominator);
    Vector den(n + 1);
    den << 1, theta.segment(a, n);
    const Vector initial = theta.segment(place, n);
    const Sampling sampling = block.data_set.sampling();
    const Index N = block.output.size();
    const Matrix motions = transfer_filters().free_responses(den, N, sampling);
    block.output += motions * initial;
    if (!block.sensitivities) return;
    block.columns(place, n) = motions;
    if (initial.isZero(0)) return;
    block.columns(a, n) += transfer_filters().free_sensitivities(den, initial, N, sampling);
}

}  // namespace dynlab::inline numerics
