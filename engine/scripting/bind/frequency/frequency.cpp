#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "figures/plots/levels_plot.h"
#include "numerics/estimators/frequency/bla.h"
#include "numerics/simulation/sampled_response.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model.h"
#include "scripting/objects/units.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kInterSamples = {"bl", "zoh", "foh"};  // in the order of InterSample
constexpr OptionEntry kInterSample = {"InterSample",
                                      ValueKind::kChoice,
                                      about("intersample behavior of the input: band-limited, a sum of sines (\"bl\"), "
                                            "zero-order hold (\"zoh\") or linear interpolation (\"foh\")"),
                                      {.choices = kInterSamples}};
constexpr std::array kResponseForms = {"complex", "polar", "dB"};
constexpr OptionEntry kResponseForm = {
    "form",
    ValueKind::kChoice,
    about("meaning of two vectors: real and imaginary part (\"complex\"), magnitude and phase in degrees (\"polar\"), "
          "or decibels and degrees (\"dB\"). By default, the units of the columns returned by `load` determine the "
          "meaning; without units, it is \"complex\""),
    {.choices = kResponseForms}};
constexpr std::array kResponseOptions = {
    kResponseForm,
    OptionEntry{"variance", ValueKind::kVector,
                about("variance of each value, the mean of |error|^2, divided equally between real and imaginary part; "
                      "one number for all values, or one per value")},
    OptionEntry{
        "Ts",
        ValueKind::kNumber,
        about("sampling time, if the response was computed from samples; the frequencies must not exceed pi/Ts"),
        {.unit = "s"}},
    kInterSample,
    option<&FrequencyData::input_name>("InputName", about("name of the input"), {.initial = "\"u1\""}),
    option<&FrequencyData::output_name>("OutputName", about("name of the output"), {.initial = "\"y1\""}),
    option<&FrequencyData::input_unit>("InputUnit", about("unit of the input")),
    option<&FrequencyData::output_unit>("OutputUnit", about("unit of the output"))};
constexpr std::array kBlaOptions = {
    OptionEntry{"period", ValueKind::kCount, about("period of the input in samples, at least 8; required")},
    option<&BlaOptions::realizations>("realizations", about("number of realizations in each experiment"),
                                      {.minimum = 1}),
    option<&BlaOptions::transient>(
        "transient", about("number of periods to omit at the beginning of every realization"), {.member = "transient"}),
    option<&BlaOptions::smooth>(
        "smooth",
        about("number of frequencies on each side over which variances are averaged; by default chosen from the data")),
    option<&BlaOptions::least_input>(
        "least_input",
        about("fraction of the largest amplitude of the input below which a line is treated as not excited")),
    kInterSample};
constexpr OptionTable kResponse[] = {kResponseOptions}, kBla[] = {kBlaOptions};

constexpr std::array kResponseArguments = {
    ArgumentEntry{"H", ValueKind::kAny,
                  about("response: a complex vector, a table {re, im} of two vectors, a list of pairs {{re, im}, ...}, "
                        "or a model with this response")},
    ArgumentEntry{"w", ValueKind::kVector,
                  about("positive, distinct frequencies in rad/s; a column in Hz returned by `load` is converted")}};
constexpr std::array kBlaArguments = {
    ArgumentEntry{"data", ValueKind::kData,
                  about("data object with one input and one output, regularly sampled; each experiment contains one "
                        "realization or several of equal length")}};

std::optional<InterSample> inter_sample_option(const Options& options) {
    if (!options.has(kInterSample.name)) return std::nullopt;
    return static_cast<InterSample>(options.choice(kInterSample));
}

enum class ResponseForm { kComplex, kPolar, kDecibels };

/// Of two vectors in a list: the option's, or as their units say.
ResponseForm form_of(const Call& call, int index, const Options& options) {
    if (options.has(kResponseForm.name)) return static_cast<ResponseForm>(options.choice(kResponseForm));
    lua_State* L = call.state();
    if (call.type(index) != LUA_TTABLE || lua_rawlen(L, index) != 2) return ResponseForm::kComplex;
    std::array<std::string, 2> units;
    for (const int part : {1, 2}) {
        lua_geti(L, index, part);
        units[static_cast<std::size_t>(part - 1)] = column_origin(L, -1).unit;
        lua_pop(L, 1);
    }
    const auto& [size, angle] = units;
    const bool decibels = size == "dB" || size == "db";
    const bool degrees = angle == "deg" || angle == "\u00B0" || angle == "degree" || angle == "degrees";
    if (!decibels && !degrees) return ResponseForm::kComplex;
    if (!degrees)
        throw InvalidArgument(
            "{}: the first vector is in dB, but the unit of the second vector is \"{}\", not degrees. Specify the "
            "phase in degrees and the option form = \"dB\"",
            argument_label(index, "H"), angle);
    call.print(
        localized(
            call,
            decibels
                ? Message(
                      "idfrd: according to the units, the columns contain the magnitude in dB and the phase in degrees")
                : Message(
                      "idfrd: according to the units, the columns contain the magnitude and the phase in degrees")) +
        "\n");
    return decibels ? ResponseForm::kDecibels : ResponseForm::kPolar;
}

/// A complex vector; {re, im} of two vectors, {{re, im}, ...} of pairs, or a matrix of two columns.
ComplexVector complex_argument(const Call& call, int index, ArgumentName what, const Options& options) {
    if (const ComplexVector* values = to_object<ComplexVector>(call.state(), index)) return *values;
    if (call.type(index) != LUA_TTABLE && to_matrix(call.state(), index) == nullptr)
        wrong_argument(call.state(), index, what,
                       Message("a complex vector, as returned by freqresp, or a table {re, im} of two vectors"));
    const ResponseForm form = form_of(call, index, options);  // of the list, which becomes a matrix
    const MatrixMap parts = call.matrix(index, what);
    if (parts.cols() != 2)
        throw InvalidArgument("{} needs a real and an imaginary part: a table {re, im} of two vectors, not {}",
                              argument_label(index, what), plural(parts.cols(), "{} column", "{} columns"));
    ComplexVector values(parts.rows());
    if (form == ResponseForm::kComplex) {
        values.real() = parts.col(0), values.imag() = parts.col(1);
        return values;
    }
    constexpr double kDegree = std::numbers::pi / 180, kDecibels = 20;
    for (Index i = 0; i < parts.rows(); ++i) {
        const double part = parts(i, 0);
        const double magnitude = form == ResponseForm::kPolar ? part : std::pow(10, part / kDecibels);
        values[i] = magnitude * std::exp(Complex(0, parts(i, 1) * kDegree));
    }
    return values;
}

/// In rad/s.
Vector frequencies_argument(const Call& call) {
    const VectorMap w = call.vector(2, "w");
    if (column_origin(call.state(), 2).unit != "Hz") return w;
    call.print(localized(call, Message("idfrd: the frequencies are in Hz and are converted to rad/s")) + "\n");
    return 2 * std::numbers::pi * w;
}

/// Where a response comes from: an analyser, unless the options say samples; the samples of a discrete-time model.
struct Sampling {
    double Ts = 0;
    InterSample inter_sample = InterSample::kBandLimited;
};
Sampling sampling_options(const Options& options, const std::optional<TransferFunction>& G) {
    const bool discrete = G && !G->continuous();
    const Sampling own{discrete ? G->Ts() : 0, discrete ? InterSample::kZoh : InterSample::kBandLimited};
    const Sampling requested{options.number("Ts", own.Ts), inter_sample_option(options).value_or(own.inter_sample)};
    if (discrete && std::abs(requested.Ts - own.Ts) > 1e-9 * own.Ts)
        throw InvalidArgument(
            "option 'Ts' is {} s, but the model has {} s: omit the option, or convert the model with d2c and c2d",
            requested.Ts, own.Ts);
    return requested;
}

int make_response(Call& call) {
    call.at_most(3);
    const Options options(call, 3, kResponse);
    std::optional<TransferFunction> G;
    if (holds_model(call, 1)) G = model_argument(call, 1, "G").G;
    const auto [Ts, inter_sample] = sampling_options(options, G);
    const Vector w = frequencies_argument(call);
    const ComplexVector H =
        G ? response_between_samples(*G, w, Ts, inter_sample) : complex_argument(call, 1, "H", options);
    Vector variance;
    if (options.has("variance")) {
        const bool one = lua_type(call.state(), options.push("variance")) == LUA_TNUMBER;
        variance =
            one ? Vector(Vector::Constant(1, options.number("variance", 0))) : Vector(options.vector("variance"));
    }
    FrequencyData data = frequency_data(H, w, variance, Ts, inter_sample);
    options.read(data);
    push_object(call.state(), std::move(data));
    return 1;
}

int approximate(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, kBla);
    BlaOptions requested;
    requested.period = options.size("period", 0);
    requested.inter_sample = inter_sample_option(options);
    options.read(requested);
    requested.cancel = call.cancel();
    const FrequencyData response = bla(data, requested);
    std::vector<Message> all = {response.message};
    all.insert(all.end(), response.warnings.begin(), response.warnings.end());
    call.print(localized(call, sentences(std::move(all))) + "\n");
    push_object(call.state(), response);
    return 1 + give_figure(call, levels_plot(response));
}

constexpr FunctionEntry kFrequencyFunctions[] = {
    {"idfrd", "nonparametric", "idfrd(H, w, {options}) -> F",
     "Create a frequency-response data object from a measured response", guarded<make_response>, kResponse,
     kResponseArguments},
    {"bla", "nonparametric", "bla(data, {options}) -> F, fig",
     "Estimate the best linear approximation and the levels of noise and nonlinear distortion",
     guarded<memoized_call<approximate>>, kBla, kBlaArguments},
};

}  // namespace

FunctionEntries frequency_functions() {
    return kFrequencyFunctions;
}

}  // namespace dynlab::inline scripting
