#include <array>
#include <cmath>

#include "base/number_text.h"
#include "numerics/signals/preprocess.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/preprocess_bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"

namespace dynlab::inline scripting {
namespace {

const IdData& data_self(Call& call) {
    return signals_of_argument(call, 1, "data");
}

const Experiment& only_experiment(const IdData& data) {
    if (data.experiments.size() != 1)
        throw InvalidArgument("the data have {} experiments; select one with data:experiment(k)",
                              data.experiments.size());
    return data.experiments.front();
}

template <Matrix Experiment::*kSignals>
int give_channels(Call& call) {
    return give_columns(call, only_experiment(data_self(call)).*kSignals);
}

int give_reference(Call& call) {
    const Experiment& experiment = only_experiment(data_self(call));
    if (experiment.r.cols() == 0)
        throw InvalidArgument("these data have no reference; add one with iddata(y, u, Ts, {Reference = r})");
    return give_columns(call, experiment.r);
}

Vector instants(const IdData& data) {
    only_experiment(data);
    return data.time();
}

const char* hold_text(const IdData& data) {
    return data.hold == Hold::kZoh ? "zoh" : "foh";
}

int part(Call& call) {
    call.at_most(3);
    return give_data(call, data_self(call).range(call.integer(2, "first"), call.integer(3, "last")));
}

Index whole_index(double number) {
    if (number != std::floor(number))
        throw InvalidArgument("sample and channel numbers must be whole numbers, but {} was given", number);
    return index_of_whole(number);
}

/// data[{i, j}]
int part_by_table(Call& call) {
    if (call.type(2) != LUA_TTABLE)
        throw InvalidArgument("write data[{i, j}] for the samples i to j; the signals are data.y, data.u and data.t");
    const VectorMap bounds = call.vector(2, "{first, last}");
    if (bounds.size() != 2)
        throw InvalidArgument("data[{i, j}] needs two numbers, the first and the last sample, not {}",
                              plural(bounds.size(), "{} number", "{} numbers"));
    return give_data(call, data_self(call).range(whole_index(bounds[0]), whole_index(bounds[1])));
}

int experiment(Call& call) {
    call.at_most(2);
    IdData data = data_self(call);
    const Index number = call.integer(2, "experiment");
    if (number < 1 || number > static_cast<Index>(data.experiments.size()))
        throw InvalidArgument("experiment {} does not exist: {}", number, numbered_from_one(data.experiments.size()));
    data.experiments = {data.experiments[static_cast<std::size_t>(number - 1)]};
    return give_data(call, std::move(data));
}

/// data:split(0.6) gives two data objects.
int split(Call& call) {
    call.at_most(2);
    auto [first, second] = data_self(call).split(call.number(2, "fraction"));
    return give_data(call, std::move(first)) + give_data(call, std::move(second));
}

std::vector<Index> channels(Call& call, int index, ArgumentName what) {
    if (call.type(index) == LUA_TNUMBER) return {call.integer(index, what)};
    const VectorMap list = call.vector(index, what);
    std::vector<Index> indices;
    for (const double number : list) indices.push_back(whole_index(number));
    return indices;
}

/// data:select(outputs, inputs)
int select(Call& call) {
    call.at_most(3);
    const IdData& data = data_self(call);
    std::vector<Index> inputs;
    for (Index i = 1; i <= data.input_count(); ++i) inputs.push_back(i);
    if (call.given(3)) inputs = channels(call, 3, "inputs");
    return give_data(call, data.select(channels(call, 2, "outputs"), inputs));
}

int shift(Call& call) {
    call.at_most(2);
    return give_data(call, data_self(call).shifted(call.integer(2, "samples")));
}

int remove_mean_of(Call& call) {
    call.at_most(1);
    return give_data(call, remove_mean(data_self(call)));
}

Message data_text(const IdData& data) {
    const std::size_t experiments = data.experiments.size();
    MessageList properties;
    properties.items.push_back(plural(data.sample_count(), "{} sample", "{} samples"));
    properties.items.push_back(plural(data.output_count(), "{} output", "{} outputs"));
    properties.items.push_back(plural(data.input_count(), "{} input", "{} inputs"));
    properties.items.push_back(data.regular() ? Message("Ts = {} {}", data.Ts, data.time_unit)
                                              : Message("sampled irregularly"));
    if (data.reference_count() > 0)
        properties.items.push_back(plural(data.reference_count(), "{} reference", "{} references"));
    if (experiments > 1)
        properties.items.push_back(plural(static_cast<std::int64_t>(experiments), "{} experiment", "{} experiments"));
    return Message("iddata: {}", properties);
}

constexpr std::array kDataTypeFields = {
    Member{"y", guarded<give_channels<&Experiment::y>>},
    Member{"u", guarded<give_channels<&Experiment::u>>},
    Member{"r", guarded<give_reference>},
    Member{"t", field<IdData, instants>},
    Member{"Ts", field<IdData, &IdData::Ts>},
    Member{"N", field<IdData, [](const IdData& data) { return data.sample_count(); }>},
    Member{"ny", field<IdData, &IdData::output_count>},
    Member{"nu", field<IdData, &IdData::input_count>},
    Member{"experiments", field<IdData, [](const IdData& data) { return data.experiments.size(); }>},
    Member{"InterSample", field<IdData, hold_text>},
    Member{"InputName", field<IdData, &IdData::input_names>},
    Member{"OutputName", field<IdData, &IdData::output_names>},
    Member{"InputUnit", field<IdData, &IdData::input_units>},
    Member{"OutputUnit", field<IdData, &IdData::output_units>},
};
constexpr std::array kDataTypeMethods = {
    Member{"range", guarded<part>},
    Member{"experiment", guarded<experiment>},
    Member{"split", guarded<split>},
    Member{"select", guarded<select>},
    Member{"shift", guarded<shift>},
    Member{"detrend", guarded<detrend_signals>},
    Member{"remove_mean", guarded<remove_mean_of>},
    Member{"merge", guarded<merge_data>},
    Member{"filter", guarded<filter_signals>},
    Member{"resample", guarded<resample_signals>},
    Member{"keep", guarded<keep_parts>},
    Member{"discard", guarded<discard_parts>},
};
constexpr std::array kDataTypeOperators = {Member{"__tostring", localized_field<IdData, data_text>}};

constexpr std::array kDataTypes = {
    TypeEntry{&Userdata<IdData>::type, kDataTypeFields, kDataTypeMethods, kDataTypeOperators, guarded<part_by_table>}};

}  // namespace

TypeEntries data_types() {
    return kDataTypes;
}

}  // namespace dynlab::inline scripting
