#include <array>

#include "figures/plots/impulse_estimate_plot.h"
#include "figures/plots/spectral_plot.h"
#include "numerics/estimators/cra.h"
#include "numerics/estimators/frequency/etfe.h"
#include "numerics/estimators/frequency/spa.h"
#include "numerics/estimators/impulseest.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/frequency_object.h"
#include "scripting/objects/model.h"

namespace dynlab::inline scripting {
namespace {

/// (data, G1, G2, ..., {options}): the models to draw over the estimate, and where the options stand.
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
    const std::vector<std::string> labels = options.texts("labels");
    if (labels.empty()) return;
    if (labels.size() != models.size())
        throw InvalidArgument("option 'labels' has {} for {}", plural(labels.size(), "{} text", "{} texts"),
                              plural(models.size(), "{} model", "{} models"));
    for (std::size_t i = 0; i < models.size(); ++i) models[i].name = Message::verbatim(labels[i]);
}

double confidence_of(const Options& options) {
    const double level = options.number("confidence", 0.99);
    if (level > 0 && level < 1) return level;
    refuse_option("confidence", Message("a probability between 0 and 1, such as 0.99"),
                  Message("{}", significant(level, 10)));
}

void print_message(const Call& call, const Message& message, const std::vector<Message>& warnings) {
    std::vector<Message> all = {message};
    all.insert(all.end(), warnings.begin(), warnings.end());
    call.print(localized(call, sentences(std::move(all))) + "\n");
}

int give_spectral(const Call& call, const Options& options, SpectralModels& read, const SpectralEstimate& estimate,
                  const char* method, bool smoothed) {
    name_models(options, read.models);
    for (NamedModel& model : read.models) model.beside = {read.data.Ts, inter_sample_of(read.data.hold)};
    if (options.flag("quiet", false)) {
        lua_pushnil(call.state());
    } else {
        print_message(call, estimate.message, estimate.warnings);
        give_figure(call, spectral_plot(estimate, Message::verbatim(method), read.models, confidence_of(options)));
    }
    push_object(call.state(), frequency_data_of(estimate, read.data, method, smoothed));
    return 2;
}

int give_impulse(const Call& call, const Options& options, SpectralModels& read, const ImpulseEstimate& estimate) {
    name_models(options, read.models);
    print_message(call, estimate.message, estimate.warnings);
    give_figure(call, impulse_estimate_plot(estimate, read.data.Ts, read.models, confidence_of(options)));
    give_table(call, "t", estimate.t, "response", estimate.response, "std", estimate.std, "chance", estimate.null_std,
               "noise_variance", estimate.noise_variance);
    if (estimate.first)
        set_field(call, "first", *estimate.first, "dead_time",
                  static_cast<double>(std::max<Index>(*estimate.first - 1, 0)) * read.data.Ts);
    set_field(call, "message", localized(call, estimate.message), "warnings", localized(call, estimate.warnings));
    return 2;
}

int ratio_of_transforms(Call& call) {
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, {"smooth", "remove_mean", "confidence", "labels", "quiet"});
    EtfeOptions wanted;
    wanted.smooth = options.size("smooth", 0);
    wanted.remove_mean = options.flag("remove_mean", true);
    return give_spectral(call, options, read, etfe(read.data, wanted), "etfe", wanted.smooth > 0);
}

int spectral_analysis(Call& call) {
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, {"window", "w", "remove_mean", "confidence", "labels", "quiet"});
    SpaOptions wanted;
    wanted.window = options.size("window", 0);
    if (options.has("w")) wanted.w = options.vector("w");
    wanted.remove_mean = options.flag("remove_mean", true);
    return give_spectral(call, options, read, spa(read.data, wanted), "spa", true);
}

/// The number of lags where it stands behind the data, which is taken off the arguments; else 0.
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
    const Options options(call, read.options, {"lags", "smooth", "Kernel", "confidence", "labels"});
    ImpulseestOptions wanted;
    wanted.lags = options.size("lags", lags);
    wanted.smooth = options.flag("smooth", true);
    wanted.kernel = std::array{ResponseKernel::kTc, ResponseKernel::kDc,
                               ResponseKernel::kSs}[options.choice("Kernel", {"TC", "DC", "SS"}, 0)];
    if (!wanted.smooth && options.has("Kernel"))
        throw InvalidArgument("option 'Kernel' is of the smooth estimate, and 'smooth' is false");
    wanted.confidence = confidence_of(options);
    const RegressedResponse result = impulseest(read.data, wanted);
    give_impulse(call, options, read, result);
    set_field(call, "covariance", result.covariance);
    if (!result.prior) return 2;
    set_field(call, "scale", result.prior_scale, "decay", result.prior->decay);
    if (wanted.kernel == ResponseKernel::kDc) set_field(call, "correlation", result.prior->correlation);
    return 2;
}

int correlation_analysis(Call& call) {
    SpectralModels read = comparison_arguments(call);
    const Options options(call, read.options, {"lags", "whitening", "confidence", "labels"});
    CraOptions wanted;
    wanted.lags = options.size("lags", 0);
    wanted.whitening = options.size("whitening", wanted.whitening);
    wanted.confidence = confidence_of(options);
    const CorrelationAnalysis result = cra(read.data, wanted);
    give_impulse(call, options, read, result.impulse);
    set_field(call, "whitening_filter", result.whitening_filter, "input_correlation", result.input_correlation);
    return 2;
}

constexpr FunctionEntry kNonparametricFunctions[] = {
    {"etfe", "nonparametric",
     "etfe(data, G1, ..., {smooth =, remove_mean =, confidence =, labels =, quiet =}) -> fig, F",
     "frequency response as the ratio of the Fourier transforms of output and input", guarded<ratio_of_transforms>},
    {"spa", "nonparametric",
     "spa(data, G1, ..., {window =, w =, remove_mean =, confidence =, labels =, quiet =}) -> fig, F",
     "frequency response with errors, from smoothed correlations", guarded<spectral_analysis>},
    {"impulseest", "nonparametric",
     "impulseest(data, n, G1, ..., {Kernel =, lags =, smooth =, confidence =, labels =}) -> fig, table",
     "impulse response by regression on past inputs, and the dead time it shows", guarded<regression_on_past_inputs>},
    {"cra", "nonparametric", "cra(data, G1, ..., {lags =, whitening =, confidence =, labels =}) -> fig, table",
     "impulse response from correlations with the whitened input", guarded<correlation_analysis>},
};

}  // namespace

FunctionEntries nonparametric_functions() {
    return kNonparametricFunctions;
}

}  // namespace dynlab::inline scripting
