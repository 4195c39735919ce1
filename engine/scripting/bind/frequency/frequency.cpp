#include <cmath>
#include <optional>

#include "figures/plots/levels_plot.h"
#include "numerics/estimators/frequency/bla.h"
#include "numerics/simulation/sampled_response.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

InterSample inter_sample_option(const Options& options, InterSample fallback) {
    return static_cast<InterSample>(
        options.choice("InterSample", {"bl", "zoh", "foh"}, static_cast<std::size_t>(fallback)));
}

/// A complex vector; {re, im} of two vectors, {{re, im}, ...} of pairs, or a matrix of two columns.
ComplexVector complex_argument(const Call& call, int index, ArgumentName what) {
    if (const ComplexVector* values = to_object<ComplexVector>(call.state(), index)) return *values;
    if (call.type(index) != LUA_TTABLE && to_matrix(call.state(), index) == nullptr)
        wrong_argument(call.state(), index, what,
                       Message("a complex vector, as freqresp gives it, or {re, im} of two vectors"));
    const MatrixMap parts = call.matrix(index, what);
    if (parts.cols() != 2)
        throw InvalidArgument("{} needs a real and an imaginary part: {re, im} of two vectors, not {}",
                              argument_label(index, what), plural(parts.cols(), "{} column", "{} columns"));
    ComplexVector values(parts.rows());
    values.real() = parts.col(0), values.imag() = parts.col(1);
    return values;
}

void read_names(const Options& options, FrequencyData& data) {
    data.input_name = options.text("InputName", data.input_name);
    data.output_name = options.text("OutputName", data.output_name);
    data.input_unit = options.text("InputUnit", data.input_unit);
    data.output_unit = options.text("OutputUnit", data.output_unit);
}

/// Where a response comes from: an analyser, unless the options say samples; the samples of a discrete-time model.
struct Sampling {
    double Ts = 0;
    InterSample inter_sample = InterSample::kBandLimited;
};
Sampling sampling_options(const Options& options, const std::optional<TransferFunction>& G) {
    const bool discrete = G && !G->continuous();
    const Sampling own{discrete ? G->Ts() : 0, discrete ? InterSample::kZoh : InterSample::kBandLimited};
    const Sampling wanted{options.number("Ts", own.Ts), inter_sample_option(options, own.inter_sample)};
    if (discrete && std::abs(wanted.Ts - own.Ts) > 1e-9 * own.Ts)
        throw InvalidArgument(
            "option 'Ts' is {} s, but the model is sampled every {} s: leave the option out, or convert the model with "
            "d2c and c2d",
            wanted.Ts, own.Ts);
    return wanted;
}

/// idfrd(H, w, {options}), or of a model idfrd(G, w, {options})
int make_response(Call& call) {
    call.at_most(3);
    const Options options(call, 3,
                          {"variance", "Ts", "InterSample", "InputName", "OutputName", "InputUnit", "OutputUnit"});
    std::optional<TransferFunction> G;
    if (holds_model(call, 1)) G = model_argument(call, 1, "G").G;
    const auto [Ts, inter_sample] = sampling_options(options, G);
    const VectorMap w = call.vector(2, "w");
    const ComplexVector H = G ? response_between_samples(*G, w, Ts, inter_sample) : complex_argument(call, 1, "H");
    Vector variance;
    if (options.has("variance")) {
        const bool one = lua_type(call.state(), options.push("variance")) == LUA_TNUMBER;
        variance =
            one ? Vector(Vector::Constant(1, options.number("variance", 0))) : Vector(options.vector("variance"));
    }
    FrequencyData data = frequency_data(H, w, variance, Ts, inter_sample);
    read_names(options, data);
    push_object(call.state(), std::move(data));
    return 1;
}

int approximate(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, {"period", "realisations", "transient", "smooth", "least_input", "InterSample"});
    BlaOptions wanted;
    wanted.period = options.size("period", 0);
    wanted.realisations = options.size("realisations", 1);
    wanted.transient = options.size("transient", 0);
    wanted.least_input = options.number("least_input", wanted.least_input);
    if (options.has("smooth")) wanted.smooth = options.size("smooth", 0);
    if (options.has("InterSample")) wanted.inter_sample = inter_sample_option(options, InterSample::kZoh);
    wanted.cancel = call.cancel();
    const FrequencyData response = bla(data, wanted);
    std::vector<Message> all = {response.message};
    all.insert(all.end(), response.warnings.begin(), response.warnings.end());
    call.print(localized(call, sentences(std::move(all))) + "\n");
    push_object(call.state(), response);
    return 1 + give_figure(call, levels_plot(response));
}

constexpr FunctionEntry kFrequencyFunctions[] = {
    {"idfrd", "nonparametric", "idfrd(H, w, {variance =, Ts =, InterSample =, ...}) -> F",
     "a measured frequency response as data, with the variances of its errors", guarded<make_response>},
    {"bla", "nonparametric", "bla(data, {period =, realisations =, transient =, ...}) -> F, fig",
     "best linear approximation from periodic records, with the levels of noise and distortion",
     guarded<memoized_call<approximate>>},
};

}  // namespace

FunctionEntries frequency_functions() {
    return kFrequencyFunctions;
}

}  // namespace dynlab::inline scripting
