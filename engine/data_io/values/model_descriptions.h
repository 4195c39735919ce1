#pragma once
#include <algorithm>
#include <string>

#include "data_io/values/array_descriptions.h"
#include "data_io/values/message_values.h"
#include "numerics/error.h"
#include "numerics/models/frequency_data.h"
#include "numerics/models/polynomial_model.h"
#include "numerics/models/process_model.h"
#include "numerics/models/state_space.h"
#include "numerics/models/transfer_function.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline data_io {

/// Data and models of numerics as described.h stores them.

constexpr std::array<const char*, 2> names_of(Hold) {
    return {"zoh", "foh"};
}

DYNLAB_DESCRIBE(Experiment, y, u, t, start_time, name, r)
DYNLAB_DESCRIBE(IdData, experiments, Ts, hold, input_names, output_names, input_units, output_units, time_unit)
void check_value(const IdData& data, const ValueLimits& limits);

constexpr std::array<const char*, 3> names_of(InterSample) {
    return {"bl", "zoh", "foh"};
}

DYNLAB_DESCRIBE(OutputLevels, w, power, noise, distortion)
DYNLAB_DESCRIBE(FrequencyData, w, response, variance, Ts, inter_sample, input_name, output_name, input_unit,
                output_unit, neighbors_share_errors, noise_variance, distortion, realized, coherence, noise_spectrum,
                excited, odd, even, method, message, warnings)
void check_value(const FrequencyData& data, const ValueLimits& limits);

/// Read by the constructor, which leaves what another one made as it is.
struct TransferFunctionMembers {
    Vector num, den;
    double Ts = 0, delay = 0;
};

DYNLAB_DESCRIBE(TransferFunctionMembers, num, den, Ts, delay)
void check_value(const TransferFunctionMembers& members, const ValueLimits& limits);

template <>
struct StoredAs<TransferFunction> {
    using Form = TransferFunctionMembers;
    static Form form(const TransferFunction& G) { return {G.num(), G.den(), G.Ts(), G.delay()}; }
    static TransferFunction value(Form&& form) { return TransferFunction(form.num, form.den, form.Ts, form.delay); }
};

template <>
struct StoredAs<ProcessStructure> {
    using Form = std::string;
    static Form form(const ProcessStructure& structure) { return structure.text(); }
    static ProcessStructure value(Form&& text) { return ProcessStructure::parse(text); }
};

DYNLAB_DESCRIBE(ProcessModel, structure, parameters)
void check_value(const ProcessModel& model, const ValueLimits& limits);

DYNLAB_DESCRIBE(PolynomialModel, A, C, D, B, F, Ts)
void check_value(const PolynomialModel& model, const ValueLimits& limits);

DYNLAB_DESCRIBE(StateSpace, A, B, C, D, Ts)
void check_value(const StateSpace& system, const ValueLimits& limits);

template <>
inline ProcessModel blank() {
    return {ProcessStructure{}, Vector::Zero(2)};
}
template <>
inline PolynomialModel blank() {
    return {PolynomialOrders::arx(1, {1}, {1}), Vector::Zero(2), 1};
}

}  // namespace dynlab::inline data_io
