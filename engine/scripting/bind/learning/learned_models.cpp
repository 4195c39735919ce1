#include <array>

#include "base/catalog.h"
#include "numerics/estimators/learning/dmdc.h"
#include "numerics/estimators/learning/narx.h"
#include "numerics/estimators/learning/sindy.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/learning/lua_library.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kNarxLags = {
    OrderEntry{"na", [] { return Message("past outputs"); }},
    OrderEntry{"nb", [] { return Message("values of the input"); }},
    OrderEntry{"nk", [] { return Message("samples of input delay, 1 for systems without direct feedthrough"); }}};

constexpr std::array kNarxOptions = {
    option<&NarxOptions::degree>("degree", about("maximum number of factors in a product"), {.member = "degree"}),
    option<&NarxOptions::terms>(
        "terms", about("number of terms; 0 selects the number, up to 50, with the smallest BIC"), {.member = "terms"})};
constexpr std::array kSindyOptions = {
    OptionEntry{
        "library", ValueKind::kAny,
        about(
            "function(x, u) that returns a list of vectors, the candidates, instead of products of states and inputs")},
    OptionEntry{"names", ValueKind::kAny,
                about("names of the library functions in the equations; by default f1, f2 and so on")},
    OptionEntry{"degree",
                ValueKind::kCount,
                about("maximum number of factors in a product of states and inputs; used only without `library`"),
                {.initial = "2", .member = "degree"}},
    option<&SindyOptions::threshold>(
        "threshold",
        about("threshold as a fraction of the root mean square of the derivative of the state, at least 0 and less "
              "than 1. Functions with a smaller root-mean-square contribution are removed"),
        {.member = "threshold"}),
    option<&SindyOptions::weak>("weak",
                                about("true uses the weak form: integrals with smooth test functions, which average "
                                      "the noise, instead of derivatives"),
                                {.member = "weak"}),
    option<&SindyOptions::window>("window",
                                  about("odd number of samples of the polynomial fit that provides the state and its "
                                        "derivative; used only if `weak` is false"),
                                  {.member = "window"}),
    option<&SindyOptions::width>("width", about("half the width of a test function; by default chosen from the data"),
                                 {.unit = "s", .member = "width"})};
constexpr std::array kDmdcOptions = {
    option<&DmdcOptions::rank>("rank", about("number of states; 0 for the numerical rank of the snapshots"),
                               {.member = "rank"}),
    option<&DmdcOptions::delays>("delays", about("number of samples in a snapshot; 1 for the outputs of one instant"),
                                 {.minimum = 1, .member = "delays"})};
constexpr OptionTable kNarx[] = {kNarxOptions}, kSindy[] = {kSindyOptions}, kDmdc[] = {kDmdcOptions};

constexpr std::array kNarxArguments = {
    kOneOutputData, ArgumentEntry{"orders", ValueKind::kOrders,
                                  about("na past outputs, nb values of the input, and an input delay of nk samples. "
                                        "With several inputs, nb and nk can be tables, such as {2, {1, 2}, {1, 3}}")}};
constexpr std::array kSindyArguments = {ArgumentEntry{
    "data", ValueKind::kData,
    about("data object with all states (1 to 8) as outputs; any number of inputs (or none) and experiments, "
          "regularly or irregularly sampled")}};
constexpr std::array kDmdcArguments = {ArgumentEntry{
    "data", ValueKind::kData,
    about("regularly sampled data object with at least one input and any number of outputs and experiments")}};

NarxLags lags_argument(const Call& call, Index inputs) {
    const auto orders = order_lists(call, 2, kNarxLags);
    if (orders[0].size() != 1)
        throw InvalidArgument("argument {} (orders) must be {}, and na must be one number", 2, meaning_of(kNarxLags));
    NarxLags lags{orders[0].front(), orders[1], orders[2]};
    for (std::vector<int>* of_inputs : {&lags.nb, &lags.nk})
        if (of_inputs->size() == 1) of_inputs->assign(static_cast<std::size_t>(inputs), of_inputs->front());
    return lags;
}

int estimate_narx(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const NarxLags lags = lags_argument(call, data.input_count());
    const Options options(call, 3, kNarx);
    NarxOptions requested;
    options.read(requested);
    requested.cancel = call.cancel();
    const NarxFit found = narx(data, lags, requested);
    Estimate estimate = basic_estimate("narx", found.fit);
    estimate.fields.edit().numbers.insert(estimate.fields.edit().numbers.end(),
                                          {{"noise_variance", found.fit.noise_variance[0]},
                                           {"prediction_fit_percent", found.fit.prediction_fit_percent}});
    Vector reductions(static_cast<Index>(found.steps.size())), criteria(reductions.size());
    for (Index i = 0; i < reductions.size(); ++i) {
        reductions[i] = found.steps[static_cast<std::size_t>(i)].error_reduction;
        criteria[i] = found.steps[static_cast<std::size_t>(i)].bic;
    }
    estimate.fields.edit().vectors.insert(estimate.fields.edit().vectors.end(),
                                          {{"error_reduction", reductions}, {"bic", criteria}});
    push_object(call.state(),
                SimulatedModel{found.model, std::make_shared<Estimate>(std::move(estimate)), {found.equation}});
    return 1;
}

FunctionLibrary library_option(const Call& call, const Options& options, const IdData& data) {
    const bool own = options.has("library");
    if (own && options.has("degree"))
        throw InvalidArgument(
            "options 'library' and 'degree' cannot be combined, because 'degree' applies only to polynomials; omit one "
            "of these options");
    if (!own && options.has("names"))
        throw InvalidArgument("option 'names' requires option 'library'; specify 'library', or omit 'names'");
    if (!own)
        return polynomial_library(data.output_names, data.input_names, static_cast<int>(options.size("degree", 2)));
    const int index = options.push("library");
    if (lua_type(call.state(), index) != LUA_TFUNCTION)
        refuse_option("library", Message("a function(x, u) that returns a list of vectors"),
                      given_value(call.state(), index));
    FunctionLibrary library = lua_library(call, index, data, options.texts("names"));
    lua_pop(call.state(), 1);
    return library;
}

int estimate_sindy(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, kSindy);
    SindyOptions requested;
    options.read(requested);
    requested.cancel = call.cancel();
    const SindyFit found = sindy(data, library_option(call, options, data), requested);
    Estimate estimate = basic_estimate("sindy", found.fit);
    if (found.width) estimate.fields.edit().numbers.emplace_back("width", *found.width);
    estimate.fields.edit().matrices = {{"coefficients", found.model->coefficients()}};
    push_object(call.state(),
                SimulatedModel{found.model, std::make_shared<Estimate>(std::move(estimate)), found.equations});
    return 1;
}

int estimate_dmdc(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, kDmdc);
    DmdcOptions requested;
    options.read(requested);
    requested.cancel = call.cancel();
    const DmdcFit found = dmdc(data, requested);
    Estimate estimate = basic_estimate("dmdc", found.fit);
    estimate.fields.edit().numbers.insert(estimate.fields.edit().numbers.end(),
                                          {{"rank", found.rank}, {"delays", found.delays}});
    estimate.fields.edit().vectors.emplace_back("singular_values", found.singular_values);
    return give_system(call, std::move(estimate), found.fit, found.system);
}

constexpr FunctionEntry kLearningFunctions[] = {
    {"sindy", "learning from data", "sindy(data, {options}) -> G",
     marked("estimator", "Estimate sparse differential equations from a library of functions"), guarded<estimate_sindy>,
     kSindy, kSindyArguments},
    {"dmdc", "learning from data", "dmdc(data, {options}) -> G",
     marked("estimator", "Estimate a state-space model with few modes from snapshots"),
     guarded<memoized_call<estimate_dmdc>>, kDmdc, kDmdcArguments},
    {"narx", "learning from data", "narx(data, {na, nb, nk}, {options}) -> G",
     marked("estimator", "Estimate a polynomial difference equation and select its terms"), guarded<estimate_narx>,
     kNarx, kNarxArguments},
};

}  // namespace

FunctionEntries learning_functions() {
    return kLearningFunctions;
}

}  // namespace dynlab::inline scripting
