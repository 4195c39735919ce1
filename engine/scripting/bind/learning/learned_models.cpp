#include <array>

#include "numerics/estimators/learning/dmdc.h"
#include "numerics/estimators/learning/narx.h"
#include "numerics/estimators/learning/sindy.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/bind/bindings.h"
#include "scripting/bind/learning/lua_library.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/simulated_model.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kNarxLags = {OrderEntry{"na", [] { return Message("past outputs"); }},
                                  OrderEntry{"nb", [] { return Message("values of the input"); }},
                                  OrderEntry{"nk", [] { return Message("samples of delay, 1 for no direct term"); }}};

NarxLags lags_argument(const Call& call, Index inputs) {
    const auto orders = order_lists(call, 2, kNarxLags);
    if (orders[0].size() != 1)
        throw InvalidArgument("argument {} (orders) must be {}, but na is one number", 2, meaning_of(kNarxLags));
    NarxLags lags{orders[0].front(), orders[1], orders[2]};
    for (std::vector<int>* of_inputs : {&lags.nb, &lags.nk})
        if (of_inputs->size() == 1) of_inputs->assign(static_cast<std::size_t>(inputs), of_inputs->front());
    return lags;
}

int estimate_narx(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const NarxLags lags = lags_argument(call, data.input_count());
    const Options options(call, 3, {"degree", "terms"});
    NarxOptions wanted;
    wanted.degree = static_cast<int>(options.size("degree", wanted.degree));
    wanted.terms = options.size("terms", wanted.terms);
    wanted.cancel = call.cancel();
    const NarxFit found = narx(data, lags, wanted);
    Estimate estimate = basic_estimate("narx", found.fit);
    estimate.numbers.insert(estimate.numbers.end(), {{"noise_variance", found.fit.noise_variance[0]},
                                                     {"prediction_fit_percent", found.fit.prediction_fit_percent}});
    Vector reductions(static_cast<Index>(found.steps.size())), criteria(reductions.size());
    for (Index i = 0; i < reductions.size(); ++i) {
        reductions[i] = found.steps[static_cast<std::size_t>(i)].error_reduction;
        criteria[i] = found.steps[static_cast<std::size_t>(i)].bic;
    }
    estimate.vectors.insert(estimate.vectors.end(), {{"error_reduction", reductions}, {"bic", criteria}});
    push_object(call.state(),
                SimulatedModel{found.model, std::make_shared<Estimate>(std::move(estimate)), {found.equation}});
    return 1;
}

FunctionLibrary library_option(const Call& call, const Options& options, const IdData& data) {
    const bool own = options.has("library");
    if (own && options.has("degree"))
        throw InvalidArgument("options 'library' and 'degree' exclude each other: a degree asks for polynomials");
    if (!own && options.has("names")) throw InvalidArgument("option 'names' is of the functions of a library");
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
    const Options options(call, 2, {"library", "names", "degree", "threshold", "weak", "window", "width"});
    SindyOptions wanted;
    wanted.threshold = options.number("threshold", wanted.threshold);
    wanted.weak = options.flag("weak", wanted.weak);
    wanted.window = static_cast<int>(options.size("window", wanted.window));
    wanted.width = options.optional_number("width");
    wanted.cancel = call.cancel();
    const SindyFit found = sindy(data, library_option(call, options, data), wanted);
    Estimate estimate = basic_estimate("sindy", found.fit);
    if (found.width) estimate.numbers.emplace_back("width", *found.width);
    estimate.matrices = {{"coefficients", found.model->coefficients()}};
    push_object(call.state(),
                SimulatedModel{found.model, std::make_shared<Estimate>(std::move(estimate)), found.equations});
    return 1;
}

int estimate_dmdc(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, {"rank", "delays"});
    DmdcOptions wanted;
    wanted.rank = static_cast<int>(options.size("rank", wanted.rank));
    wanted.delays = static_cast<int>(options.size("delays", wanted.delays));
    wanted.cancel = call.cancel();
    const DmdcFit found = dmdc(data, wanted);
    Estimate estimate = basic_estimate("dmdc", found.fit);
    estimate.numbers.insert(estimate.numbers.end(), {{"rank", found.rank}, {"delays", found.delays}});
    estimate.vectors.emplace_back("singular_values", found.singular_values);
    return give_system(call, std::move(estimate), found.fit, found.system);
}

constexpr FunctionEntry kLearningFunctions[] = {
    {"sindy", "learning from data",
     "sindy(data, {library =, names =, degree =, threshold =, weak =, window =, width =}) -> G",
     "sparse differential equations from a library of functions, the outputs being the states",
     guarded<estimate_sindy>},
    {"dmdc", "learning from data", "dmdc(data, {rank =, delays =}) -> G",
     "a state-space model from snapshots, cut to few modes", guarded<memoized_call<estimate_dmdc>>},
    {"narx", "learning from data", "narx(data, {na, nb, nk}, {degree =, terms =}) -> G",
     "a polynomial difference equation whose terms are chosen one by one", guarded<estimate_narx>},
};

}  // namespace

FunctionEntries learning_functions() {
    return kLearningFunctions;
}

}  // namespace dynlab::inline scripting
