#include "scripting/arguments/estimator_arguments.h"

#include <cmath>

#include "numerics/fit/integrated_input.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kLargestOrder = 1e6;

int checked_order(double value, int index, std::span<const OrderEntry> entries, const char* name) {
    if (std::floor(value) != value || value < 0 || value > kLargestOrder)
        throw InvalidArgument("argument {} (orders) must be {}, but {} is {}; specify an integer from 0 to 1000000",
                              index, meaning_of(entries), name, significant(value, 10));
    return static_cast<int>(value);
}

/// The number, table or vector on top of the stack as a list.
std::vector<int> entry_list(lua_State* L, int index, std::span<const OrderEntry> entries, const char* name) {
    if (lua_type(L, -1) == LUA_TNUMBER) return {checked_order(lua_tonumber(L, -1), index, entries, name)};
    std::vector<int> list;
    if (NumericBlock* vector = to_vector(L, -1)) {
        for (const double value : vector->vector()) list.push_back(checked_order(value, index, entries, name));
        return list;
    }
    if (lua_type(L, -1) != LUA_TTABLE)
        throw InvalidArgument("argument {} (orders) must be {}, but {} is {}", index, meaning_of(entries), name,
                              given_value(L, lua_gettop(L)));
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, -1));
    if (count == 0)
        throw InvalidArgument("argument {} (orders) must be {}, but {} is an empty table", index, meaning_of(entries),
                              name);
    for (lua_Integer i = 1; i <= count; ++i) {
        lua_rawgeti(L, -1, i);
        if (lua_type(L, -1) != LUA_TNUMBER)
            throw InvalidArgument("argument {} (orders) must be {}, but {} contains {}", index, meaning_of(entries),
                                  name, given_value(L, lua_gettop(L)));
        list.push_back(checked_order(lua_tonumber(L, -1), index, entries, name));
        lua_pop(L, 1);
    }
    return list;
}

}  // namespace

Message meaning_of(std::span<const OrderEntry> entries) {
    std::vector<std::string> names;
    MessageList meanings{{}, Join::kSemicolon};
    for (const OrderEntry& entry : entries) {
        names.emplace_back(entry.name);
        meanings.items.push_back(Message("{}: {}", entry.name, entry.meaning()));
    }
    return Message("{{}} ({})", listed(names), meanings);
}

std::vector<std::vector<int>> order_lists(const Call& call, int index, std::span<const OrderEntry> entries) {
    lua_State* L = call.state();
    const auto wrong_count = [&](Index count) {
        const Message has = plural(count, "{} entry", "{} entries");
        if (count > static_cast<Index>(entries.size()) + 1)
            throw InvalidArgument(
                "argument {} (orders) must be {}, but the list has {}. With several inputs, an entry is a list with "
                "one value per input, such as {1, 1}",
                index, meaning_of(entries), has);
        throw InvalidArgument("argument {} (orders) must be {}, but the list has {}", index, meaning_of(entries), has);
    };
    std::vector<std::vector<int>> lists;
    if (index <= call.count()) {
        if (NumericBlock* vector = to_vector(L, index)) {
            const auto values = vector->vector();
            if (values.size() != static_cast<Index>(entries.size())) wrong_count(values.size());
            for (Index i = 0; i < values.size(); ++i)
                lists.push_back({checked_order(values[i], index, entries, entries[static_cast<std::size_t>(i)].name)});
            return lists;
        }
        if (call.type(index) == LUA_TTABLE) {
            const auto count = static_cast<std::size_t>(lua_rawlen(L, index));
            if (count != entries.size()) wrong_count(static_cast<Index>(count));
            for (std::size_t i = 0; i < count; ++i) {
                lua_rawgeti(L, index, static_cast<lua_Integer>(i + 1));
                lists.push_back(entry_list(L, index, entries, entries[i].name));
                lua_pop(L, 1);
            }
            return lists;
        }
    }
    if (!call.given(index))
        throw InvalidArgument("argument {} (orders) must be {}, but it is missing", index, meaning_of(entries));
    throw InvalidArgument("argument {} (orders) must be {}, but {} was given", index, meaning_of(entries),
                          given_value(L, index));
}

namespace {

/// Orders of all channels as they are, those of inputs repeated for each output.
template <class Value>
std::vector<Value> for_channels(const std::vector<Value>& of_inputs, const IdData& data) {
    const auto channels = static_cast<std::size_t>(data.output_count() * data.input_count());
    if (of_inputs.size() == 1 || of_inputs.size() == channels) return of_inputs;
    std::vector<Value> all;
    for (Index output = 0; output < data.output_count(); ++output)
        all.insert(all.end(), of_inputs.begin(), of_inputs.end());
    return all;
}

/// A whole number, or a list of one for each input or for each channel.
std::vector<int> counts_argument(const Call& call, int index, ArgumentName what) {
    if (call.type(index) != LUA_TTABLE && !call.holds_vector(index)) return {static_cast<int>(call.size(index, what))};
    const auto values = call.vector(index, what);
    std::vector<int> counts;
    for (const double value : values) {
        if (!(value >= 0) || value != std::floor(value))
            throw InvalidArgument("{} must contain nonnegative integers, but it contains {}",
                                  argument_label(index, what), significant(value, 10));
        counts.push_back(static_cast<int>(value));
    }
    return counts;
}

/// A number of seconds or one for each input or channel.
std::vector<double> seconds_option(const Options& options, const char* name) {
    if (options.push(name) && lua_type(options.call().state(), -1) == LUA_TNUMBER) return {options.number(name, 0)};
    const auto delays = options.vector(name);
    return {delays.begin(), delays.end()};
}

std::size_t index_of_entry(std::span<const OrderEntry> entries, std::string_view name) {
    std::size_t index = 0;
    while (index < entries.size() && name != entries[index].name) ++index;
    return index;
}

/// At least one pole, and as many coefficients as a proper model has; lists of unequal lengths are paired as
/// TransferStructure::grid() does or refuses to.
void check_coefficients(std::span<const OrderEntry> entries, std::string_view poles_name, const std::vector<int>& poles,
                        const std::vector<int>& coefficients) {
    for (const int n : poles)
        if (n < 1)
            throw InvalidArgument("argument {} (orders) must be {}, but {} is {}; specify at least 1", 2,
                                  meaning_of(entries), poles_name, n);
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        const int nb = coefficients[i];
        const int n = i < poles.size() ? poles[i] : poles.back();
        if (nb < 1 || nb > n + 1)
            throw InvalidArgument(
                "argument {} (orders) must be {}, but {} is {}; with {} = {}, specify a value between 1 and {}", 2,
                meaning_of(entries), kNb.name, nb, poles_name, n, n + 1);
    }
}

std::vector<double> delays_of(const std::vector<int>& samples, const IdData& data) {
    std::vector<double> delays;
    for (const int nk : samples) {
        if (nk > 0 && !data.regular())
            throw InvalidArgument(
                "nk is a delay in samples, which is undefined for irregularly sampled data; specify nk = 0");
        delays.push_back(nk * data.Ts);
    }
    return delays;
}

TransferStructure structure_for(const IdData& data, Denominators sharing, const std::vector<int>& poles,
                                const std::vector<int>& zeros, const std::vector<double>& delays) {
    return TransferStructure::grid(data.output_count(), data.input_count(), sharing, for_channels(poles, data),
                                   for_channels(zeros, data), for_channels(delays, data));
}

}  // namespace

StructureMaker structure_of_orders(std::span<const OrderEntry> entries, const std::vector<std::vector<int>>& orders,
                                   Denominators sharing) {
    const std::string_view poles_entry = index_of_entry(entries, kNa.name) < entries.size() ? kNa.name : kNf.name;
    const auto list = [&](std::string_view name) { return orders[index_of_entry(entries, name)]; };
    check_coefficients(entries, poles_entry, list(poles_entry), list(kNb.name));
    std::vector<int> zeros = list(kNb.name);
    for (int& count : zeros) --count;
    return [poles = list(poles_entry), zeros, samples = list(kNk.name), sharing](const IdData& data) {
        return structure_for(data, sharing, poles, zeros, delays_of(samples, data));
    };
}

StructureMaker structure_of_counts(const Call& call, const Options& options, const FitOptions& requested) {
    std::vector<double> delays{requested.least_delay};
    if (options.has("IODelay")) delays = seconds_option(options, "IODelay");
    const bool free_delays = !options.has("IODelay") && requested.largest_delay.value_or(1) > requested.least_delay;
    return [poles = counts_argument(call, 2, "np"), zeros = counts_argument(call, 3, "nz"), delays,
            sharing = sharing_of(options), free_delays](const IdData& data) {
        TransferStructure structure = structure_for(data, sharing, poles, zeros, delays);
        structure.free_delays = free_delays;
        return structure;
    };
}

StartedStructure started_structure(const Call& call, const Options& options, const FitOptions& requested) {
    if (!holds_model(call, 2)) {
        StartedStructure started{structure_of_counts(call, options, requested), {}};
        if (options.has("Td0")) started.aids.delays = seconds_option(options, "Td0");
        return started;
    }
    for (const char* name : {"IODelay", "Td0"})
        if (options.has(name))
            throw InvalidArgument(
                "option '{}' cannot be combined with a start model, which already includes a delay; omit the option",
                name);
    SearchAids aids;
    const auto outputs = static_cast<Index>(object_argument<Model>(call, 2, Message("start model")).outputs);
    const auto structure =
        TransferStructure::of_models(channels_argument(call, 2, Message("start model")), outputs, aids.start);
    return {[structure](const IdData& data) {
                if (data.input_count() != structure.inputs || data.output_count() != structure.outputs)
                    throw InvalidArgument("the start model has {} and {}, but the data have {} and {}",
                                          plural(structure.inputs, "{} input", "{} inputs"),
                                          plural(structure.outputs, "{} output", "{} outputs"),
                                          plural(data.input_count(), "{} input", "{} inputs"),
                                          plural(data.output_count(), "{} output", "{} outputs"));
                return structure;
            },
            aids};
}

Denominators sharing_of(const Options& options) {
    return options.flag("CommonDenominator", false) ? Denominators::kCommon : Denominators::kPerChannel;
}

void read_fit_options(const Options& options, FitOptions& requested) {
    options.read(requested);
    requested.extend_iterations = !options.has("MaxIter");
    requested.cancel = options.call().cancel();
    requested.validate();
    if (requested.integration) requested = options_with_integrator(std::move(requested));
}

FitOptions fit_options(const Options& options, Purpose purpose) {
    FitOptions requested;
    if (purpose == Purpose::kStudy) requested = requested.from_rest();
    read_fit_options(options, requested);
    return requested;
}

}  // namespace dynlab::inline scripting
