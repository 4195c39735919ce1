#include <cmath>
#include <numbers>

#include "figures/confidence_band.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/simulation/lsim.h"
#include "numerics/statistics/distributions.h"
#include "numerics/validation/simulation_spread.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kNoiseSeed = {"seed",
                                    ValueKind::kCount,
                                    about("seed of a separate random stream; by default, the random stream of `randn`"),
                                    {.maximum = kMaxSeed}},
                      kHoldOfData = {"hold", ValueKind::kChoice, kHoldOption.description, {.choices = kHolds}};
constexpr OptionEntry kNoiseOptions[] = {
    {"noise", ValueKind::kFlag,
     about("true adds the noise of the model, which must be an estimated model with one output")},
    {"snr",
     ValueKind::kNumber,
     about("signal-to-noise ratio 20 log10(std(x)/std(v)) of noise v that is added to the noise-free output x"),
     {.unit = "dB"}},
    kNoiseSeed,
    kHoldOfData};
constexpr OptionEntry kSpreadOptions[] = {
    {"runs", ValueKind::kCount, about("number of random models"), {.initial = "200", .minimum = 2}},
    kNoiseSeed,
    kHoldOfData,
    kConfidenceOption};
constexpr OptionTable kNoiseTables[] = {kNoiseOptions}, kSpreadTables[] = {kSpreadOptions};

constexpr ArgumentEntry
    kSimulatedInput = {"u", ValueKind::kAny,
                       about("samples of the input: a vector, or a matrix with a column for each input")},
    kInputPeriod = {"Ts", ValueKind::kNumber, about("sampling time of the input in seconds")},
    kInputData = {"data", ValueKind::kData,
                  about("data object with one experiment, instead of `u` and `Ts`; only the input is used")};
constexpr ArgumentEntry kNoiseArguments[] = {
    {"G", ValueKind::kModel, about("model, with one or several inputs and outputs")},
    kSimulatedInput,
    kInputPeriod,
    kInputData};
constexpr ArgumentEntry kSpreadArguments[] = {
    {"G", ValueKind::kModel, about("estimated model with one output and any number of inputs")},
    kSimulatedInput,
    kInputPeriod,
    kInputData};
constexpr ArgumentEntry kValuesArguments[] = {
    kOneChannelModel,
    {"w", ValueKind::kVector, about("frequencies in rad/s; by default chosen from the poles and zeros")}};

/// What a model is simulated with: (G, u, Ts, options) or (G, data, options).
struct InputSignals {
    Matrix u;  // N x inputs
    Vector t;
    double Ts;  // 0 when sampled irregularly
    Hold hold;
    int options_index;
};

InputSignals input_argument(const Call& call) {
    if (call.given(2) && to_object<IdData>(call.state(), 2) != nullptr) {
        call.at_most(3);
        const IdData& data = signals_of_argument(call, 2, "data");
        if (data.experiments.size() != 1)
            throw InvalidArgument("the data have {} experiments; select one with data:experiment(k)",
                                  data.experiments.size());
        return {data.experiments.front().u, data.time(), data.Ts, data.hold, 3};
    }
    call.at_most(4);
    const Matrix u = call.matrix(2, "u");
    const double Ts = call.number(3, "Ts");
    return {u, Ts * Vector::LinSpaced(u.rows(), 0, static_cast<double>(u.rows() - 1)), Ts, Hold::kZoh, 4};
}

void require_signal_per_input(const Model& model, const InputSignals& input) {
    if (static_cast<std::size_t>(input.u.cols()) != model.inputs())
        throw InvalidArgument("the model has {}, but the number of input signals is {}",
                              plural(model.inputs(), "{} input", "{} inputs"), input.u.cols());
}

Matrix simulated_outputs(const std::vector<TransferFunction>& channels, const InputSignals& input, Hold hold) {
    const auto inputs = static_cast<std::size_t>(input.u.cols());
    if (inputs == 0 || channels.size() % inputs != 0)
        throw InvalidArgument(
            "the model has {}, which cannot be divided among {}; specify one signal for each input of the model",
            plural(channels.size(), "{} channel", "{} channels"), plural(inputs, "{} input", "{} inputs"));
    Matrix y = Matrix::Zero(input.u.rows(), static_cast<Index>(channels.size() / inputs));
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto u = input.u.col(static_cast<Index>(i % inputs));
        y.col(static_cast<Index>(i / inputs)) +=
            input.Ts > 0 ? lsim(channels[i], u, input.Ts, hold) : lsim(channels[i], u, input.t, hold);
    }
    return y;
}

/// The standard deviation of a model's own white noise e.
double own_noise_std(const Model* model) {
    if (model == nullptr || !model->estimate)
        throw InvalidArgument("this model was not estimated, so its noise is unknown: specify the option snr in dB");
    if (model->estimate->carx)
        throw InvalidArgument(
            "{} estimates an equation error, not the noise of the output: specify the option snr in dB",
            model->estimate->method);
    if (const std::optional<double> variance = model->estimate->report().number("noise_variance");
        variance && *variance >= 0)
        return std::sqrt(*variance);
    throw InvalidArgument("{} does not estimate the variance of the noise: specify the option snr in dB",
                          model->estimate->method);
}

/// The script's own random stream, or a separate one from the option seed.
class DrawnNumbers {
  public:
    DrawnNumbers(const Call& call, const Options& options) : stream_(&call.context().random) {
        if (!options.has("seed")) return;
        own_ = RandomStream(static_cast<std::uint32_t>(options.whole("seed", 0)));
        stream_ = &*own_;
    }
    DrawnNumbers(const DrawnNumbers&) = delete;
    RandomStream& stream() { return *stream_; }

  private:
    std::optional<RandomStream> own_;
    RandomStream* stream_;
};

int simulate_with_noise(Call& call) {
    const NoisyModel model = noisy_model_argument(call, 1, "G");
    InputSignals input = input_argument(call);
    if (const Model* object = to_object<Model>(call.state(), 1)) require_signal_per_input(*object, input);
    input.u = driving_input(call, 1, input.u);
    const Options options(call, input.options_index, kNoiseTables);
    const Matrix y = simulated_outputs(model.channels, input, hold_option(options, input.hold));
    const auto snr = options.optional_number("snr");
    if (!options.flag("noise", snr.has_value()))
        return y.cols() == 1 ? call.give_vector(y.col(0)) : call.give_matrix(y);
    if (y.cols() != 1)
        throw InvalidArgument(
            "noise can be simulated only for one output, but the model has {}: simulate one of its channels", y.cols());
    if (model.noise_Ts > 0 && std::abs(model.noise_Ts - input.Ts) > 1e-9 * model.noise_Ts)
        throw InvalidArgument(
            "the sampling time of the noise model is {} s, but the sampling time of the input is {} s. The sampling "
            "times must be equal",
            significant(model.noise_Ts, 10), significant(input.Ts, 10));
    const ColoredNoise noise = noise_of(model);
    const double sigma =
        snr ? noise_std_of_snr(y.col(0), *snr) / noise.gain() : own_noise_std(to_object<Model>(call.state(), 1));
    const Vector v = noise.draw(y.rows(), sigma, DrawnNumbers(call, options).stream());
    return call.give_vector(y.col(0) + v) + call.give_vector(v);
}

/// The structure whose parameters an estimate of coefficients in continuous time holds, of all inputs of one output;
/// nothing for other estimates.
std::optional<TransferStructure> structure_of_estimate(const Model& model) {
    if (model.estimate && !model.polynomial && !model.estimate->of_coefficients)
        throw InvalidArgument(
            "random models cannot be generated from a model that was estimated with option 'Integration' or by "
            "hammerstein: its covariance does not apply to the coefficients. Use a model that was estimated by srivc "
            "or tfsrivc");
    if (!model.G.continuous() || model.process || model.system || !model.estimate->of_coefficients) return std::nullopt;
    Vector theta;
    TransferStructure structure = TransferStructure::of_models(channels_of(model), 1, theta);
    for (const bool free : {false, true}) {
        structure.free_delays = free;
        if (structure.parameter_count() == model.estimate->theta.size()) return structure;
    }
    return std::nullopt;
}

void require_model_sampling(double model_Ts, const InputSignals& input) {
    if (std::abs(model_Ts - input.Ts) > 1e-9 * model_Ts)
        throw InvalidArgument(
            "the sampling time of the model is {} s, but the sampling time of the input is {} s. The sampling times "
            "must be equal",
            significant(model_Ts, 10), significant(input.Ts, 10));
}

SimulationSpread spread_of(const Model& model, const InputSignals& input, Hold hold, Index runs, RandomStream& random) {
    if (input.Ts == 0)
        throw InvalidArgument(
            "the input must be sampled regularly; interpolate the input at equally spaced instants with interp1");
    require_signal_per_input(model, input);
    if (const auto uncertain = uncertain_model(model))
        return simulation_spread(*uncertain, input.u.col(0), input.Ts, hold, runs, random);
    if (model.estimate && model.outputs == 1 && model.estimate->covariance().size() > 0) {
        const Matrix covariance = model.estimate->trusted_covariance();
        if (model.polynomial) require_model_sampling(model.polynomial->Ts, input);
        if (model.polynomial) return simulation_spread(*model.polynomial, covariance, input.u, runs, random);
        if (const auto structure = structure_of_estimate(model))
            return simulation_spread(*structure, model.estimate->theta, covariance, input.u, input.Ts, hold, runs,
                                     random);
    }
    throw InvalidArgument(
        "simsd requires a model with one output and a parameter covariance; use an estimated model, such as the result "
        "of srivc");
}

Figure spread_figure(const std::string& name, const SimulationSpread& spread, const Vector& t, double level) {
    Figure figure;
    Panel& panel = figure.panels.emplace_back();
    Curve curve;
    curve.x = t;
    curve.y = spread.output;
    curve.label = Message::verbatim(name);
    panel.curves.push_back(std::move(curve));
    panel.x_label = axis_label(Message("time"), "s");
    panel.y_label = Message("output");
    fix_colors(panel);
    add_confidence_band(panel, 0, normal_half_width(level) * spread.std, level);
    return figure;
}

int simulate_spread(Call& call) {
    const Model* object = to_object<Model>(call.state(), 1);
    const Model model = object != nullptr ? *object : model_argument(call, 1, "G");
    const InputSignals input = input_argument(call);
    const Options options(call, input.options_index, kSpreadTables);
    const double level = confidence_option(options);
    const SimulationSpread spread = spread_of(model, input, hold_option(options, input.hold), options.size("runs", 200),
                                              DrawnNumbers(call, options).stream());
    give_figure(call, spread_figure(model.estimate->method, spread, input.t, level));
    give_table(call, "output", spread.output, "std", spread.std, "drawn", spread.drawn, "unstable", spread.unstable);
    return 2;
}

/// bode_values(G, w) -> mag, ph, w, sdmag, sdph
int frequency_values(Call& call) {
    call.at_most(2);
    const Model model = model_argument(call, 1, "G");
    const Vector w = call.given(2) ? Vector(call.vector(2, "w")) : natural_frequency_grid(model.G);
    const Vector magnitude = frequency_response(model.G, w).cwiseAbs();
    const int given = call.give_vector(magnitude) + call.give_vector(phase_degrees(model.G, w)) + call.give_vector(w);
    const auto uncertain = uncertain_model(model);
    if (!uncertain) return given;
    const auto [decibels, degrees] = frequency_response_std(*uncertain, w);
    return given + call.give_vector(std::numbers::ln10 / 20 * magnitude.cwiseProduct(decibels)) +
           call.give_vector(degrees);
}

constexpr FunctionEntry kNoisySimulationFunctions[] = {
    {"sim", "simulation", "sim(G, u, Ts, {options}) -> y, v; sim(G, data, {...})",
     "Simulate a model with its estimated noise or with noise of a specified SNR", guarded<simulate_with_noise>,
     kNoiseTables, kNoiseArguments},
    {"simsd", "simulation", "simsd(G, u, Ts, {options}) -> fig, table; simsd(G, data, {...})",
     "Plot a simulated output with its uncertainty", guarded<simulate_spread>, kSpreadTables, kSpreadArguments},
    {"bode_values", "simulation", "bode_values(G, w) -> mag, ph, w, sdmag, sdph",
     "Magnitude and phase of the frequency response, with standard deviations", guarded<frequency_values>, kNoOptions,
     kValuesArguments},
};

}  // namespace

FunctionEntries noisy_simulation_functions() {
    return kNoisySimulationFunctions;
}

}  // namespace dynlab::inline scripting
