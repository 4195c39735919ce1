#include <array>

#include "figures/plots/impulse_estimate_plot.h"
#include "figures/plots/spectral_plot.h"
#include "numerics/estimators/cra.h"
#include "numerics/estimators/frequency/etfe.h"
#include "numerics/estimators/frequency/spa.h"
#include "numerics/estimators/impulseest.h"
#include "scripting/arguments/simulation_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

constexpr OptionEntry kQuietEstimate = {"quiet",
                                        ValueKind::kFlag,
                                        about("true suppresses the text and the figure; the returned figure is nil"),
                                        {.initial = "false"}};
constexpr OptionEntry kReadingConfidence = {
    "confidence",
    ValueKind::kNumber,
    about("confidence level of the band and of the test that detects the dead time"),
    {.initial = "0.99"}};
constexpr MessageId<> kMeanRemoval = about("true removes the means of both signals before the estimation");

constexpr std::array kEtfeOptions = {
    option<&EtfeOptions::smooth>("smooth",
                                 about("number of frequencies on each side in a weighted mean; 0 for no smoothing")),
    option<&EtfeOptions::remove_mean>("remove_mean", kMeanRemoval), kConfidenceOption, kLabelsOption, kQuietEstimate};
constexpr std::array kSpaOptions = {
    option<&SpaOptions::window>(
        "window",
        about("length of the lag window in samples, from 2 to N - 1 for N samples; 0 for the smaller of 30 and "
              "N/10")),
    option<&SpaOptions::w>("w", about("frequencies, at most pi/Ts; by default, 128 frequencies"), {.unit = "rad/s"}),
    option<&SpaOptions::remove_mean>("remove_mean", kMeanRemoval),
    kConfidenceOption,
    kLabelsOption,
    kQuietEstimate};
constexpr std::array kKernels = {"TC", "DC", "SS"};
constexpr std::array kImpulseestOptions = {
    option<&ImpulseestOptions::kernel>("Kernel",
                                       about("regularization kernel, the prior covariance of the impulse response"),
                                       {.initial = "\"TC\"", .choices = kKernels}),
    option<&ImpulseestOptions::lags>("lags", about("length of the response in samples, as an alternative to the "
                                                   "argument `n`; 0 for the smaller of 70 and N/5 for N samples")),
    option<&ImpulseestOptions::smooth>("smooth", about("true uses regularized least squares, for a smooth and decaying "
                                                       "response, instead of ordinary least squares")),
    kReadingConfidence, kLabelsOption};
constexpr std::array kCraOptions = {
    option<&CraOptions::lags>("lags", about("number of lags; 0 for the smaller of 70 and N/5 for N samples")),
    option<&CraOptions::whitening>("whitening",
                                   about("order of the autoregressive filter; 0 for an input that is already white"),
                                   {.maximum = 100}),
    kReadingConfidence, kLabelsOption};
constexpr OptionTable kEtfeTables[] = {kEtfeOptions}, kSpaTables[] = {kSpaOptions},
                      kImpulseestTables[] = {kImpulseestOptions}, kCraTables[] = {kCraOptions};

constexpr ArgumentEntry
    kOneExperiment = {"data", ValueKind::kData,
                      about("data object with one input, one output and one experiment, sampled regularly")},
    kSingleData = {"data", ValueKind::kData,
                   about("data object with one input and one output, sampled regularly; experiments are combined")},
    kComparedModels = {"G1, ...", ValueKind::kModel, about("models to plot with the estimate")};
constexpr std::array kEtfeArguments = {kOneExperiment, kComparedModels},
                     kSpectralArguments = {kSingleData, kComparedModels};
constexpr ArgumentEntry kImpulseArguments[] = {
    kSingleData,
    {"n", ValueKind::kCount,
     about("length of the response in samples, 1 to 400; by default the smaller of 70 and N/5 for N samples")},
    kComparedModels};

/// (data, G1, G2, ..., {options}): the models to draw over the estimate, and the index of the options.
struct SpectralModels {
    const IdData& data;
    std::vector<NamedModel> models;
    int options;
};

SpectralModels comparison_arguments(const Call& call) {
    SpectralModels read{object_argument<IdData>(call, 1, "data"), {}, 2};
    for (; holds_model(call, read.options); ++read.options) {
        const Model* model = to_object<Model>(call.state(), read.options);
        const Message name = model != nullptr && model->estimate ? Message::verbatim(model->estimate->method)
                                                                 : Message("model {}", read.options - 1);
        read.models.push_back({name, model_argument(call, read.options, "G").G});
    }
    call.at_most(read.options);
    return read;
}

void name_models(const Options& options, std::vector<NamedModel>& models) {
    const std::vector<std::string> labels = labels_option(options, models.size());
    for (std::size_t i = 0; i < labels.size(); ++i) models[i].name = Message::verbatim(labels[i]);
}

void print_message(const Call& call, const Message& message, const std::vector<Message>& warnings) {
    std::vector<Message> all = {message};
    all.insert(all.end(), warnings.begin(), warnings.end());
    call.print(localized(call, sentences(std::move(all))) + "\n");
}

int give_spectral(const Call& call, const Options& options, SpectralModels& read, SpectralEstimate estimate,
                  const char* method, bool smoothed) {
    const double confidence = confidence_option(options);
    if (!has_known_phase(estimate, confidence))
        estimate.warnings.push_back(Message(
            "The response does not differ significantly from zero at any frequency, so its phase is unknown. Use more "
            "samples or a stronger input."));
    name_models(options, read.models);
    for (NamedModel& model : read.models) model.beside = {read.data.Ts, inter_sample_of(read.data.hold)};
    if (options.flag("quiet", false)) {
        lua_pushnil(call.state());
    } else {
        print_message(call, estimate.message, estimate.warnings);
        give_figure(call, spectral_plot(estimate, Message::verbatim(method), read.models, confidence));
    }
    push_object(call.state(), frequency_data_of(estimate, read.data, method, smoothed));
    return 2;
}

int give_impulse(const Call& call, const Options& options, SpectralModels& read, const ImpulseEstimate& estimate) {
    name_models(options, read.models);
    print_message(call, estimate.message, estimate.warnings);
    give_figure(call, impulse_estimate_plot(estimate, read.data.Ts, read.models, confidence_option(options)));
    give_table(call, "t", estimate.t, "response", estimate.response, "std", estimate.std, "chance", estimate.null_std,
               "noise_variance", estimate.noise_variance);
    if (estimate.first) set_field(call, "first", *estimate.first, "dead_time", *estimate.dead_time);
    set_field(call, "message", localized(call, estimate.message), "warnings", localized(call, estimate.warnings));
    return 2;
}

int ratio_of_transforms(Call& call) {
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, kEtfeTables);
    EtfeOptions requested;
    options.read(requested);
    return give_spectral(call, options, read, etfe(read.data, requested), "etfe", requested.smooth > 0);
}

int spectral_analysis(Call& call) {
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, kSpaTables);
    SpaOptions requested;
    options.read(requested);
    return give_spectral(call, options, read, spa(read.data, requested), "spa", true);
}

/// Removes the number of lags after the data from the arguments and returns it; 0 if there is none.
Index take_lags(Call& call) {
    if (call.type(2) != LUA_TNUMBER) return 0;
    const Index lags = call.size(2, "lags");
    lua_remove(call.state(), 2);
    call = Call(call.state());
    return lags;
}

int regression_on_past_inputs(Call& call) {
    const Index lags = take_lags(call);
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, kImpulseestTables);
    ImpulseestOptions requested;
    requested.lags = lags;
    options.read(requested);
    if (!requested.smooth && options.has("Kernel"))
        throw InvalidArgument("option 'Kernel' applies only to the smooth estimate, but option 'smooth' is false");
    requested.confidence = confidence_option(options);
    const RegressedResponse result = impulseest(read.data, requested);
    give_impulse(call, options, read, result);
    set_field(call, "covariance", result.covariance);
    if (!result.prior) return 2;
    set_field(call, "scale", result.prior_scale, "decay", result.prior->decay);
    if (requested.kernel == ResponseKernel::kDc) set_field(call, "correlation", result.prior->correlation);
    return 2;
}

int correlation_analysis(Call& call) {
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, kCraTables);
    CraOptions requested;
    options.read(requested);
    requested.confidence = confidence_option(options);
    const CorrelationAnalysis result = cra(read.data, requested);
    give_impulse(call, options, read, result.impulse);
    set_field(call, "whitening_filter", result.whitening_filter, "input_correlation", result.input_correlation);
    return 2;
}

constexpr FunctionEntry kNonparametricFunctions[] = {
    {"etfe", "nonparametric", "etfe(data, G1, ..., {options}) -> fig, F",
     "Estimate the frequency response as a ratio of Fourier transforms", guarded<ratio_of_transforms>, kEtfeTables,
     kEtfeArguments},
    {"spa", "nonparametric", "spa(data, G1, ..., {options}) -> fig, F",
     "Estimate the frequency response with standard errors by spectral analysis", guarded<spectral_analysis>,
     kSpaTables, kSpectralArguments},
    {"impulseest", "nonparametric", "impulseest(data, n, G1, ..., {options}) -> fig, H",
     "Estimate the impulse response and the dead time by regression", guarded<regression_on_past_inputs>,
     kImpulseestTables, kImpulseArguments},
    {"cra", "nonparametric", "cra(data, G1, ..., {options}) -> fig, H",
     "Estimate the impulse response by correlation analysis", guarded<correlation_analysis>, kCraTables,
     kSpectralArguments},
};

}  // namespace

FunctionEntries nonparametric_functions() {
    return kNonparametricFunctions;
}

}  // namespace dynlab::inline scripting
