#include <array>
#include <cmath>

#include "base/number_text.h"
#include "data_io/values/model_descriptions.h"
#include "numerics/estimators/frequency/bla.h"
#include "numerics/simulation/frequency_response.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

const FrequencyData& response_self(Call& call) {
    return object_argument<FrequencyData>(call, 1, "F");
}

/// A vector, or nil where it is not known.
template <auto kGet>
int give_known(Call& call) {
    const Vector values = std::invoke(kGet, response_self(call));
    if (values.size() > 0) return call.give_vector(values);
    lua_pushnil(call.state());
    return 1;
}

template <OutputLevels FrequencyData::*kLevels>
int give_levels(Call& call) {
    const OutputLevels& levels = response_self(call).*kLevels;
    give_table(call, "w", levels.w, "power", levels.power);
    if (levels.noise.size() > 0) set_field(call, "noise", levels.noise);
    if (levels.distortion.size() > 0) set_field(call, "distortion", levels.distortion);
    return 1;
}

template <double LevelSums::*kSum>
int give_sum(Call& call) {
    const double sum = level_sums(response_self(call)).*kSum;
    if (std::isfinite(sum) && response_self(call).excited.w.size() > 0) return call.give(sum);
    lua_pushnil(call.state());
    return 1;
}

int give_warnings(Call& call) {
    return give_value(call, localized(call, response_self(call).warnings));
}

Vector standard_errors(const FrequencyData& data) {
    return (0.5 * data.variance).cwiseSqrt();
}

const char* inter_sample_text(const FrequencyData& data) {
    return names_of(data.inter_sample)[static_cast<std::size_t>(data.inter_sample)];
}

Message response_text(const FrequencyData& data) {
    if (data.w.size() == 0) return Message("idfrd: no frequencies");
    MessageList properties;
    properties.items.push_back(plural(data.w.size(), "{} frequency from {} to {} rad/s",
                                      "{} frequencies from {} to {} rad/s", data.w[0], data.w[data.w.size() - 1]));
    if (data.Ts > 0) properties.items.push_back(Message("Ts = {} s", data.Ts));
    if (!data.method.empty()) properties.items.push_back(Message("by {}", data.method));
    properties.items.push_back(data.variance.size() > 0 ? Message("with variances") : Message("variances unknown"));
    return Message("idfrd: {}", properties);
}

constexpr std::array kResponseFields = {
    Member{"w", field<FrequencyData, &FrequencyData::w>},
    Member{"H", field<FrequencyData, &FrequencyData::response>},
    Member{"response", field<FrequencyData, &FrequencyData::response>},
    Member{"magnitude", field<FrequencyData, [](const FrequencyData& d) { return Vector(d.response.cwiseAbs()); }>},
    Member{"phase", field<FrequencyData, [](const FrequencyData& d) { return phase_degrees_unwrapped(d.response); }>},
    Member{"variance", guarded<give_known<&FrequencyData::variance>>},
    Member{"std", guarded<give_known<standard_errors>>},
    Member{"Ts", field<FrequencyData, &FrequencyData::Ts>},
    Member{"InterSample", field<FrequencyData, inter_sample_text>},
    Member{"InputName", field<FrequencyData, &FrequencyData::input_name>},
    Member{"OutputName", field<FrequencyData, &FrequencyData::output_name>},
    Member{"InputUnit", field<FrequencyData, &FrequencyData::input_unit>},
    Member{"OutputUnit", field<FrequencyData, &FrequencyData::output_unit>},
    Member{"noise_variance", guarded<give_known<&FrequencyData::noise_variance>>},
    Member{"distortion", guarded<give_known<&FrequencyData::distortion>>},
    Member{"coherence", guarded<give_known<&FrequencyData::coherence>>},
    Member{"noise_spectrum", guarded<give_known<&FrequencyData::noise_spectrum>>},
    Member{"excited", guarded<give_levels<&FrequencyData::excited>>},
    Member{"odd", guarded<give_levels<&FrequencyData::odd>>},
    Member{"even", guarded<give_levels<&FrequencyData::even>>},
    Member{"output_power", guarded<give_sum<&LevelSums::power>>},
    Member{"noise_power", guarded<give_sum<&LevelSums::noise>>},
    Member{"distortion_power", guarded<give_sum<&LevelSums::distortion>>},
    Member{"method", field<FrequencyData, &FrequencyData::method>},
    Member{"message", localized_field<FrequencyData, &FrequencyData::message>},
    Member{"warnings", guarded<give_warnings>},
};
constexpr std::array kResponseOperators = {
    Member{"__tostring", localized_field<FrequencyData, response_text>},
    Member{"__len", field<FrequencyData, [](const FrequencyData& d) { return d.w.size(); }>}};

constexpr std::array kResponseTypes = {
    TypeEntry{&Userdata<FrequencyData>::type, kResponseFields, {}, kResponseOperators}};

}  // namespace

TypeEntries response_types() {
    return kResponseTypes;
}

}  // namespace dynlab::inline scripting
