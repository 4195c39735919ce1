#include "numerics/models/transfer_structure.h"

#include <algorithm>
#include <cmath>

#include "numerics/error.h"

namespace dynlab::inline numerics {

namespace {

constexpr int kMaxPoles = 30;

template <class Value>
bool of_channels(const std::vector<Value>& list, std::size_t channels) {
    return list.size() == 1 || list.size() == channels;
}

template <class Value>
Value entry(const std::vector<Value>& list, std::size_t channel) {
    return list.size() == 1 ? list.front() : list[channel];
}

void check_lists(const std::vector<int>& poles, const std::vector<int>& zeros, const std::vector<double>& delays,
                 std::size_t channels) {
    const Message count = plural(static_cast<Index>(channels), "{} channel", "{} channels");
    if (!of_channels(poles, channels))
        throw InvalidArgument(
            "The model has {}, so the number of poles must be one value or one value for each channel, but {} were "
            "given",
            count, poles.size());
    if (!of_channels(zeros, channels))
        throw InvalidArgument(
            "The model has {}, so the number of zeros must be one value or one value for each channel, but {} were "
            "given",
            count, zeros.size());
    if (!of_channels(delays, channels))
        throw InvalidArgument(
            "The model has {}, so the delay must be one value or one value for each channel, but {} were given", count,
            delays.size());
}

Index denominator_of(Denominators sharing, Index output, Index input, Index inputs) {
    if (sharing == Denominators::kCommon) return 0;
    return sharing == Denominators::kPerOutput ? output : output * inputs + input;
}

}  // namespace

TransferStructure TransferStructure::single(int poles, int zeros, double delay) {
    return grid(1, 1, Denominators::kCommon, {poles}, {zeros}, {delay});
}

TransferStructure TransferStructure::grid(Index outputs, Index inputs, Denominators sharing,
                                          const std::vector<int>& poles, const std::vector<int>& zeros,
                                          const std::vector<double>& delays) {
    TransferStructure structure;
    structure.outputs = outputs;
    structure.inputs = inputs;
    const std::size_t count = static_cast<std::size_t>(outputs * inputs);
    check_lists(poles, zeros, delays, count);
    for (std::size_t i = 0; i < count; ++i) {
        const Index place = static_cast<Index>(i);
        const Index denominator = denominator_of(sharing, place / inputs, place % inputs, inputs);
        const int n = entry(poles, i);
        if (static_cast<std::size_t>(denominator) == structure.poles.size())
            structure.poles.push_back(n);
        else if (structure.poles[static_cast<std::size_t>(denominator)] != n)
            throw InvalidArgument(
                "Channels with a common denominator need the same number of poles, but {} and {} were given",
                structure.poles[static_cast<std::size_t>(denominator)], n);
        structure.channels.push_back({denominator, entry(zeros, i), entry(delays, i)});
    }
    structure.validate();
    return structure;
}

bool TransferStructure::inputs_share_denominator(Index output) const {
    for (Index input = 1; input < inputs; ++input)
        if (channel(output, input).denominator != channel(output, 0).denominator) return false;
    return true;
}

bool TransferStructure::outputs_share_denominator() const {
    return poles.size() < static_cast<std::size_t>(outputs);
}

const TransferChannel& TransferStructure::channel(Index output, Index input) const {
    return channels[static_cast<std::size_t>(output * inputs + input)];
}

Index TransferStructure::parameter_count() const {
    Index count = 0;
    for (const int n : poles) count += n;
    for (const TransferChannel& channel : channels) count += channel.zeros + 1 + (free_delays ? 1 : 0);
    return count;
}

Index TransferStructure::denominator_start(Index denominator) const {
    Index place = 0;
    for (Index d = 0; d < denominator; ++d) place += poles[static_cast<std::size_t>(d)];
    for (const TransferChannel& channel : channels)
        if (channel.denominator < denominator) place += channel.zeros + 1 + (free_delays ? 1 : 0);
    return place;
}

Index TransferStructure::numerator_start(Index output, Index input) const {
    const std::size_t position = static_cast<std::size_t>(output * inputs + input);
    const Index denominator = channels[position].denominator;
    Index place = denominator_start(denominator) + poles[static_cast<std::size_t>(denominator)];
    for (std::size_t i = 0; i < position; ++i)
        if (channels[i].denominator == denominator) place += channels[i].zeros + 1 + (free_delays ? 1 : 0);
    return place;
}

Index TransferStructure::delay_index(Index output, Index input) const {
    return free_delays ? numerator_start(output, input) + channel(output, input).zeros + 1 : -1;
}

std::vector<std::string> TransferStructure::parameter_names() const {
    std::vector<std::string> names(static_cast<std::size_t>(parameter_count()));
    const auto set = [&](Index place, const std::string& name) { names[static_cast<std::size_t>(place)] = name; };
    const auto suffix = [&](bool with_output, Index output, bool with_input, Index input) {
        std::string text;
        if (with_output && outputs > 1) text += "y" + std::to_string(output + 1);
        if (with_input && inputs > 1) text += "u" + std::to_string(input + 1);
        return text.empty() ? text : "_" + text;
    };
    for (Index output = 0; output < outputs; ++output) {
        for (Index input = 0; input < inputs; ++input) {
            const TransferChannel& here = channel(output, input);
            const bool of_output = channels.front().denominator != channels.back().denominator;
            const bool of_input = inputs > 1 && channels[0].denominator != channels[1].denominator;
            for (int i = 1; i <= poles[static_cast<std::size_t>(here.denominator)]; ++i)
                set(denominator_start(here.denominator) + i - 1,
                    "a" + std::to_string(i) + suffix(of_output, output, of_input, input));
            for (int j = 0; j <= here.zeros; ++j)
                set(numerator_start(output, input) + j, "b" + std::to_string(j) + suffix(true, output, true, input));
            if (free_delays) set(delay_index(output, input), "Td" + suffix(true, output, true, input));
        }
    }
    return names;
}

Vector TransferStructure::denominator(const VectorView& theta, Index output, Index input) const {
    const Index place = channel(output, input).denominator, n = poles[static_cast<std::size_t>(place)];
    Vector den(n + 1);
    den << 1, theta.segment(denominator_start(place), n);
    return den;
}

Vector TransferStructure::numerator(const VectorView& theta, Index output, Index input) const {
    return theta.segment(numerator_start(output, input), channel(output, input).zeros + 1);
}

double TransferStructure::delay(const VectorView& theta, Index output, Index input) const {
    return free_delays ? theta[delay_index(output, input)] : channel(output, input).delay;
}

std::vector<TransferFunction> TransferStructure::models(const VectorView& theta) const {
    std::vector<TransferFunction> result;
    for (Index output = 0; output < outputs; ++output)
        for (Index input = 0; input < inputs; ++input)
            result.emplace_back(numerator(theta, output, input), denominator(theta, output, input), 0,
                                delay(theta, output, input));
    return result;
}

void TransferStructure::validate() const {
    if (inputs < 1)
        throw InvalidArgument(
            "A transfer function needs an input, but the data have no input: add an input with iddata");
    if (outputs < 1 || channels.size() != static_cast<std::size_t>(outputs * inputs))
        throw InvalidArgument(
            "A model needs at least one output, and one channel for each pair of an input and an output");
    for (const int n : poles)
        if (n < 1 || n > kMaxPoles)
            throw InvalidArgument("The number of poles must be between 1 and {}, but is {}", kMaxPoles, n);
    for (const TransferChannel& channel : channels) {
        if (channel.denominator < 0 || static_cast<std::size_t>(channel.denominator) >= poles.size())
            throw InvalidArgument("A channel of the model refers to a missing denominator");
        const int n = poles[static_cast<std::size_t>(channel.denominator)];
        if (channel.zeros < 0 || channel.zeros > n)
            throw InvalidArgument("The number of zeros must be between 0 and the number of poles, {}, but is {}", n,
                                  channel.zeros);
        if (!(channel.delay >= 0) || !std::isfinite(channel.delay))
            throw InvalidArgument("A delay must be nonnegative, but is {} s", channel.delay);
    }
}

TransferStructure TransferStructure::of_models(const std::vector<TransferFunction>& models, Index outputs,
                                               Vector& theta) {
    TransferStructure structure;
    structure.outputs = outputs;
    structure.inputs = static_cast<Index>(models.size()) / outputs;
    std::vector<Vector> denominators;
    for (const TransferFunction& G : models) {
        if (G.Ts() > 0)
            throw InvalidArgument(
                "a start model must be a continuous-time model, but this model is a discrete-time model; convert it "
                "with d2c(G)");
        const Vector den = G.den() / G.den()[0];
        const auto known = std::find(denominators.begin(), denominators.end(), den);
        structure.channels.push_back({known - denominators.begin(), static_cast<int>(G.zero_count()), G.delay()});
        if (known != denominators.end()) continue;
        denominators.push_back(den);
        structure.poles.push_back(static_cast<int>(G.pole_count()));
    }
    structure.free_delays = std::any_of(models.begin(), models.end(), [](const auto& G) { return G.delay() > 0; });
    structure.validate();
    theta.resize(structure.parameter_count());
    for (Index output = 0; output < outputs; ++output)
        for (Index input = 0; input < structure.inputs; ++input) {
            const TransferFunction& G = models[static_cast<std::size_t>(output * structure.inputs + input)];
            const TransferChannel& channel = structure.channel(output, input);
            theta.segment(structure.denominator_start(channel.denominator), G.pole_count()) =
                G.den().tail(G.pole_count()) / G.den()[0];
            theta.segment(structure.numerator_start(output, input), channel.zeros + 1) = G.num() / G.den()[0];
            if (structure.free_delays) theta[structure.delay_index(output, input)] = channel.delay;
        }
    return structure;
}

}  // namespace dynlab::inline numerics
