#include <array>

#include "figures/histogram.h"
#include "figures/plots/bode_plot.h"
#include "figures/plots/nyquist_plot.h"
#include "figures/plots/pole_zero_map.h"
#include "figures/plots/time_response_plots.h"
#include "numerics/simulation/frequency_response.h"
#include "numerics/simulation/lsim.h"
#include "numerics/simulation/time_response.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/grey_object.h"
#include "scripting/objects/model.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kLsimOptions = {
    kHoldOption,
    OptionEntry{
        "x0", ValueKind::kVector,
        about("state at the first sample; for a transfer function, the state of its controllable canonical form")}};
constexpr std::array kSvfOptions = {
    OptionEntry{"Ts", ValueKind::kNumber, about("sampling time; required"), {.unit = "s"}},
    OptionEntry{"hold",
                ValueKind::kChoice,
                about("intersample behavior of the signal: linear interpolation (\"foh\") for measured outputs, or "
                      "zero-order hold (\"zoh\") for piecewise constant inputs"),
                {.initial = "\"foh\"", .choices = kHolds}}};
constexpr std::array kModelNameOptions = {
    OptionEntry{"labels", ValueKind::kAny, about("legend labels: list with one string per model")}};
constexpr std::array kRegionOptions = {
    OptionEntry{"confidence",
                ValueKind::kAny,
                about("confidence level of the bands or regions of estimated continuous-time models; false for none"),
                {.initial = "0.99"}}};
constexpr std::array kHistogramOptions = {
    option<&HistogramOptions::bins>("bins", about("number of bins; 0 for a number based on the spread of the values")),
    option<&HistogramOptions::truth>("truth", about("value to mark with a line")),
    OptionEntry{"xlabel", ValueKind::kText, about("x-axis label")},
    OptionEntry{"label", ValueKind::kText, about("name of the bars in the legend")},
    OptionEntry{
        "truth_label", ValueKind::kText, about("name of the line in the legend"), {.initial = "\"true value\""}}};
constexpr OptionTable kLsimTables[] = {kLsimOptions}, kSvfTables[] = {kSvfOptions},
                      kNamedTables[] = {kModelNameOptions}, kRegionTables[] = {kModelNameOptions, kRegionOptions},
                      kHistogramTables[] = {kHistogramOptions};

constexpr ArgumentEntry kOneModel = {"G", ValueKind::kModel, about("model")},
                        kDrawnModels = {"G1, G2, ...", ValueKind::kModel, about("models to plot")},
                        kDrawnFrequencies = {"w", ValueKind::kVector, about("vector of frequencies in rad/s")},
                        kDrawnInstants = {"t", ValueKind::kVector,
                                          about("vector of nonnegative, increasing instants in seconds")};
constexpr std::array kLsimArguments = {
    ArgumentEntry{"G", ValueKind::kModel, about("model with at least as many poles as zeros")},
    ArgumentEntry{"u", ValueKind::kVector,
                  about("vector of N samples; for several inputs, a matrix with one column per input")},
    ArgumentEntry{
        "t_or_Ts", ValueKind::kVector,
        about("sampling time in seconds, or a vector of N increasing instants in seconds, which need not be equally "
              "spaced")}};
constexpr std::array kSvfArguments = {
    ArgumentEntry{"x", ValueKind::kVector, about("vector of N samples")},
    ArgumentEntry{"n", ValueKind::kCount, about("order of the filter, 1 to 50")},
    ArgumentEntry{"lambda", ValueKind::kNumber, about("cutoff frequency of the filter in rad/s")}};
constexpr std::array kFreqrespArguments = {kOneChannelModel, kDrawnFrequencies};
constexpr std::array kTimeResponseArguments = {kOneModel, kDrawnInstants, kDrawnModels};
constexpr std::array kNyquistArguments = {kDrawnModels, kDrawnFrequencies};
constexpr std::array kBodeArguments = {
    ArgumentEntry{"G1, G2, ...", ValueKind::kModel,
                  about("models, and measured frequency responses (idfrd, bla, spa, etfe), in any order")},
    kDrawnFrequencies};
constexpr std::array kPzmapArguments = {
    ArgumentEntry{"G1, G2, ...", ValueKind::kModel, about("models, all continuous-time or all discrete-time")}};
constexpr std::array kHistogramArguments = {
    ArgumentEntry{"values", ValueKind::kVector, about("vector of finite values")}};

/// Several inputs or outputs: columns of a matrix.
int simulate_system(Call& call, const StateSpace& system, const Options& options, const VectorView& x0) {
    const Matrix y = lsim(system, call.matrix(2, "u"), call.number(3, "Ts"), hold_option(options, Hold::kZoh), x0);
    return y.cols() == 1 ? call.give_vector(y.col(0)) : call.give_matrix(y);
}

/// From rest or from x0. Of a model without inputs u says by its length how many samples are wanted.
int simulate_freely(Call& call, const FreeRunModel& model, const Options& options, const VectorView& x0) {
    const MatrixMap u = call.matrix(2, "u");
    const IdData data = inputs_alone(model.input_count() == 0 ? Matrix(u.rows(), 0) : Matrix(u), call.number(3, "Ts"),
                                     hold_option(options, Hold::kZoh));
    const FreeRun run = model.free_run(data, 0, x0);
    if (run.lost_at) throw InvalidArgument(divergence_text(data, 0, *run.lost_at));
    return run.output.cols() == 1 ? call.give_vector(run.output.col(0)) : call.give_matrix(run.output);
}

/// Simulates a grey-box model by its equations.
int simulate_grey_box(Call& call, const GreyFit& grey, const Options& options, const Vector& x0) {
    GreyInputs inputs{call.matrix(2, "u"), {}, hold_option(options, Hold::kZoh)};
    const Index N = inputs.u.rows();
    if (call.type(3) == LUA_TNUMBER)
        inputs.t = call.number(3, "Ts") * Vector::LinSpaced(N, 0, static_cast<double>(N - 1));
    else
        inputs.t = call.vector(3, Message("t or Ts"));
    return give_columns(call, grey_response(grey, inputs, x0));
}

int simulate(Call& call) {
    call.at_most(4);
    if (call.given(2) && !call.given(3))
        throw InvalidArgument(
            "argument 3 (t or Ts) is missing; write the sampling time in seconds, such as lsim(G, u, 0.1), or the time "
            "vector");
    const Options options(call, 4, kLsimTables);
    const Vector x0 = options.has("x0") ? Vector(options.vector("x0")) : Vector();
    if (const GreyEstimate grey = to_grey_box(call, 1)) return simulate_grey_box(call, *grey, options, x0);
    if (const SimulatedModel* model = simulated_model(call, 1)) return simulate_freely(call, *model->run, options, x0);
    if (const StateSpace* system = to_object<StateSpace>(call.state(), 1))
        return simulate_system(call, *system, options, x0);
    const Model model = model_argument(call, 1, "G");
    const VectorMap u = call.vector(2, "u");
    const Hold hold = hold_option(options, Hold::kZoh);
    if (call.type(3) == LUA_TNUMBER) return call.give_vector(lsim(model.G, u, call.number(3, "Ts"), hold, x0));
    return call.give_vector(lsim(model.G, u, call.vector(3, Message("t or Ts")), hold, x0));
}

int filter_states(Call& call) {
    call.at_most(4);
    const Options options(call, 4, kSvfTables);
    const auto Ts = options.optional_number("Ts");
    if (!Ts) throw InvalidArgument("svf needs the sampling time: svf(x, n, lambda, {Ts = 0.01})");
    const VectorMap x = call.vector(1, "x");
    return call.give_matrix(state_variable_filter(x, static_cast<int>(call.size(2, "n")), call.number(3, "lambda"), *Ts,
                                                  hold_option(options, Hold::kFoh)));
}

int frequency_response_of(Call& call) {
    call.at_most(2);
    const Model model = model_argument(call, 1, "G");
    push_object(call.state(), frequency_response(model.G, call.vector(2, "w")));
    return 1;
}

/// G1, G2, ... up to the vector of instants or frequencies, or the options, that end the arguments.
std::vector<NamedModel> models_to_draw(const Call& call, int& next) {
    std::vector<NamedModel> models;
    for (next = 1; holds_model(call, next); ++next) models.push_back({{}, model_argument(call, next, "G").G});
    if (models.empty()) wrong_argument(call.state(), 1, "G", with_article("model"));
    return models;
}

Message usual_name(const Call& call, int index) {
    const std::string method = method_of_model(call, index);
    return method.empty() ? Message("model {}", index) : Message::verbatim(method);
}

void name_models(const Call& call, const Options& options, std::vector<NamedModel>& models) {
    const std::vector<std::string> labels = labels_option(options, models.size());
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (!labels.empty())
            models[i].name = Message::verbatim(labels[i]);
        else if (models.size() > 1)
            models[i].name = usual_name(call, static_cast<int>(i + 1));
    }
}

/// Option confidence: a probability, or false for none; default: 99 %.
std::optional<double> confidence_level(const Options& options) {
    constexpr double kUsual = 0.99;
    lua_State* L = options.call().state();
    const bool flag = lua_isboolean(L, options.push("confidence")), requested = lua_toboolean(L, -1);
    lua_pop(L, 1);
    if (flag) return requested ? std::optional(kUsual) : std::nullopt;
    const double level = options.number("confidence", kUsual);
    if (level > 0 && level < 1) return level;
    refuse_option("confidence", Message("a confidence level between 0 and 1, such as 0.99, or false"),
                  Message("{}", significant(level, 10)));
}

std::optional<ModelConfidence> confidence_of(const Call& call, int index, const std::optional<double>& level) {
    const Model* model = level ? to_object<Model>(call.state(), index) : nullptr;
    if (model == nullptr) return std::nullopt;
    auto uncertain = uncertain_model(*model);
    if (!uncertain) return std::nullopt;
    return ModelConfidence{std::move(*uncertain), *level};
}

void add_confidence(const Call& call, const Options& options, std::vector<NamedModel>& models) {
    const std::optional<double> level = confidence_level(options);
    for (std::size_t i = 0; i < models.size(); ++i)
        models[i].confidence = confidence_of(call, static_cast<int>(i + 1), level);
}

/// As step(G, 5) of MATLAB, a final time.
void refuse_last_value(const Call& call, int index, bool of_frequency) {
    if (call.type(index) != LUA_TNUMBER) return;
    const std::string name = call.function_name();
    if (of_frequency)
        throw InvalidArgument(
            "specify all frequencies in rad/s instead of a single number, such as w = logspace(-2, 2, 300). {}(G, w) "
            "returns a figure, and freqresp(G, w) returns numbers",
            name);
    throw InvalidArgument(
        "specify all instants instead of only the last, such as x = linspace(0, {}, 300). {}(G, x) returns numbers, "
        "and plot(x, {}(G, x)) returns a figure",
        significant(call.number(index, "t"), 6), name, name);
}

void refuse_option_texts(const Call& call, int index) {
    if (call.type(index) == LUA_TSTRING)
        throw InvalidArgument(
            "write options as a table: {confidence = 0.99} for the bands; bode_values(G, w) and step(G, t) return "
            "standard deviations as numbers");
}

template <Figure (*kPlot)(const std::vector<NamedModel>&, const Vector&), bool kBands>
int draw_models(Call& call) {
    int next = 0;
    std::vector<NamedModel> models = models_to_draw(call, next);
    const Vector grid = call.holds_vector(next) ? Vector(call.vector(next++, Message("t or w"))) : Vector();
    refuse_last_value(call, next, kPlot == nyquist_plot);
    if (kBands) refuse_option_texts(call, next);
    call.at_most(next);
    const Options options(call, next, kBands ? OptionTables(kRegionTables) : OptionTables(kNamedTables));
    name_models(call, options, models);
    if (kBands) add_confidence(call, options, models);
    return give_figure(call, kPlot(models, grid));
}

/// bode(G1, F1, ...): models and measured responses in any order.
int draw_bode(Call& call) {
    int count = 0;
    while (holds_model(call, count + 1) || holds_response(call, count + 1)) ++count;
    if (count == 0) wrong_argument(call.state(), 1, "G", with_article("model"));
    int next = count + 1;
    const Vector grid = call.holds_vector(next) ? Vector(call.vector(next++, "w")) : Vector();
    refuse_option_texts(call, next);
    call.at_most(next);
    const Options options(call, next, kRegionTables);
    const std::vector<std::string> labels = labels_option(options, static_cast<std::size_t>(count));
    const std::optional<double> level = confidence_level(options);
    std::vector<NamedModel> models;
    std::vector<NamedResponse> responses;
    for (int i = 1; i <= count; ++i) {
        Message name = labels.empty() ? Message() : Message::verbatim(labels[static_cast<std::size_t>(i - 1)]);
        if (holds_response(call, i)) {
            FrequencyData data = object_argument<FrequencyData>(call, i, "F");
            if (labels.empty()) name = data.method.empty() ? Message("measured") : Message::verbatim(data.method);
            if (!level) data.variance.resize(0);
            responses.push_back({name, std::move(data), level.value_or(0.99)});
        } else {
            if (labels.empty() && count > 1) name = usual_name(call, i);
            models.push_back({name, model_argument(call, i, "G").G, confidence_of(call, i, level)});
        }
    }
    return give_figure(call, bode_plot(models, grid, responses));
}

int draw_poles_and_zeros(Call& call) {
    int next = 0;
    std::vector<NamedModel> models = models_to_draw(call, next);
    call.at_most(next);
    const Options options(call, next, kRegionTables);
    name_models(call, options, models);
    add_confidence(call, options, models);
    return give_figure(call, pole_zero_map(models));
}

/// step(G, t) with a vector of instants gives the response, without it a figure.
template <TimeResponse (*kResponse)(const TransferFunction&, const VectorView&),
          Figure (*kPlot)(const std::vector<NamedModel>&, const Vector&), bool kBands>
int time_response(Call& call) {
    if (!(holds_model(call, 1) && call.holds_vector(2))) return draw_models<kPlot, kBands>(call);
    call.at_most(2);
    const Model model = model_argument(call, 1, "G");
    const TimeResponse response = kResponse(model.G, call.vector(2, "t"));
    const int given = call.give_vector(response.y) + call.give_vector(response.t);
    const auto uncertain = kBands ? uncertain_model(model) : std::nullopt;
    return uncertain ? given + call.give_vector(step_response_std(*uncertain, response.t)) : given;
}

int draw_histogram(Call& call) {
    call.at_most(2);
    const Options options(call, 2, kHistogramTables);
    HistogramOptions requested;
    options.read(requested);
    requested.label = Message::verbatim(options.text("label", ""));
    requested.x_label = Message::verbatim(options.text("xlabel", ""));
    if (options.has("truth_label")) requested.truth_label = Message::verbatim(options.text("truth_label", ""));
    return give_figure(call, histogram(call.vector(1, "values"), requested));
}

constexpr const char* kFigures = "figures";
constexpr FunctionEntry kSimulationFunctions[] = {
    {"lsim", "simulation", "lsim(G, u, t_or_Ts, {options}) -> y", "Simulate the response of a model to an input",
     guarded<simulate>, kLsimTables, kLsimArguments},
    {"svf", "simulation", "svf(x, n, lambda, {options}) -> matrix",
     "Compute filtered derivatives with the state-variable filter", guarded<filter_states>, kSvfTables, kSvfArguments},
    {"step", "simulation", "step(G, t) -> y, t, sd; step(G1, G2, ..., {options}) -> fig",
     "Compute or plot the response to a unit step", guarded<time_response<step_response, step_plot, true>>,
     kRegionTables, kTimeResponseArguments},
    {"impulse", "simulation", "impulse(G, t) -> y, t; impulse(G1, G2, ..., {options}) -> fig",
     "Compute or plot the response to a unit impulse", guarded<time_response<impulse_response, impulse_plot, false>>,
     kNamedTables, kTimeResponseArguments},
    {"freqresp", "simulation", "freqresp(G, w) -> complex vector", "Frequency response at w (rad/s)",
     guarded<frequency_response_of>, kNoOptions, kFreqrespArguments},
    {"bode", kFigures, "bode(G1, G2, ..., w, {options}) -> fig", "Plot magnitude and phase versus frequency",
     guarded<draw_bode>, kRegionTables, kBodeArguments},
    {"nyquist", kFigures, "nyquist(G1, G2, ..., w, {options}) -> fig",
     "Plot the frequency response in the complex plane", guarded<draw_models<nyquist_plot, false>>, kNamedTables,
     kNyquistArguments},
    {"pzmap", kFigures, "pzmap(G1, G2, ..., {options}) -> fig", "Plot poles and zeros in the complex plane",
     guarded<draw_poles_and_zeros>, kRegionTables, kPzmapArguments},
    {"histogram", kFigures, "histogram(values, {options}) -> fig", "Plot a histogram", guarded<draw_histogram>,
     kHistogramTables, kHistogramArguments},
};

}  // namespace

FunctionEntries simulation_functions() {
    return kSimulationFunctions;
}

}  // namespace dynlab::inline scripting
