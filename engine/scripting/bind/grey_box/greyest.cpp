#include "numerics/estimators/grey_box/greyest.h"

#include <array>

#include "base/catalog.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/numeric.h"
#include "scripting/conversions/option_member.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/grey_object.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kGreyStarts = {"model", "zero", "estimate"};  // in the order of GreyStart
constexpr std::array kGreyOptions = {
    option<&GreyOptions::initial_state>("InitialState",
                                        about("initial state: x0 of the model (\"model\"), zero (\"zero\"), or all "
                                              "states estimated for each experiment (\"estimate\")"),
                                        {.initial = "\"model\"", .choices = kGreyStarts, .member = "initial_state"}),
    option<&GreyOptions::max_iterations>("MaxIter", about("maximum number of iterations"),
                                         {.minimum = 0, .member = "max_iterations"}),
    option<&GreyOptions::tolerance>(
        "Tol", about("the search stops when the relative change of the parameters is below this value"),
        {.initial = "1e-6", .member = "tolerance"}),
    option<&GreyOptions::relative_tolerance>(
        "RelTol",
        about("relative tolerance of an integration step; parameters with little effect on the outputs need a smaller "
              "value"),
        {.initial = "1e-7", .minimum = 1e-13, .maximum = 1e-2, .member = "relative_tolerance"}),
    option<&GreyOptions::output_weights>(
        "OutputWeights",
        about("weights of the errors, one per output; by default 1/(standard deviation of the errors)"),
        {.member = "output_weights"})};
constexpr std::array kStartsOption = {
    OptionEntry{"starts",
                ValueKind::kAny,
                about("number of starting points, the first from the model; or a list of further starting points, such "
                      "as {{k1 = 0.2}, {k1 = 2, k2 = 1}}"),
                {.initial = "1", .member = "starts"}}};
constexpr OptionTable kGreyest[] = {kGreyOptions, kStartsOption}, kStartsAlone[] = {kStartsOption};
constexpr std::array kGreyestArguments = {
    ArgumentEntry{"data", ValueKind::kData,
                  about("data object with any number of outputs and experiments, regularly or irregularly sampled")},
    ArgumentEntry{"m", ValueKind::kAny, about("model returned by idgrey, with an initial value for each parameter")}};

/// Option starts: how many, or a list of tables {k1 = 0.5, ...}.
void read_starts(const Options& options, GreyOptions& requested) {
    lua_State* L = options.call().state();
    const int place = options.push("starts");
    if (lua_istable(L, place)) {
        for (lua_Integer i = 1; lua_rawgeti(L, place, i) != LUA_TNIL; ++i, lua_pop(L, 1)) {
            lua_createtable(L, 0, 1);
            lua_pushvalue(L, -2);
            lua_setfield(L, -2, "starts");
            requested.further_starts.push_back(
                Options(options.call(), lua_gettop(L), kStartsAlone).numbers_by_name("starts"));
            lua_pop(L, 1);
        }
    } else if (!lua_isnil(L, place)) {
        requested.starts = static_cast<int>(options.size("starts", 1));
    }
    lua_settop(L, place - 1);
}

GreyOptions read_grey_options(const Call& call, int index) {
    const Options options(call, index, kGreyest);
    GreyOptions requested;
    options.read(requested);
    read_starts(options, requested);
    requested.cancel = call.cancel();
    return requested;
}

int estimate_grey_box(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const GreyModel& model = object_argument<GreyModel>(call, 2, "m");
    GreyEstimate estimate = std::make_shared<const GreyFit>(greyest(data, model, read_grey_options(call, 3)));
    push_object(call.state(), std::move(estimate));
    return 1;
}

// ---- fields of an estimate

const GreyFit& fit_self(Call& call) {
    return *object_argument<GreyEstimate>(call, 1, "G");
}

/// G.k1, by name.
int parameter_named(Call& call) {
    const Fit& fit = fit_self(call).fit;
    const std::string name = call.text(2, "name");
    for (std::size_t i = 0; i < fit.names.size(); ++i)
        if (fit.names[i] == name) return call.give(fit.theta[static_cast<Index>(i)]);
    throw InvalidArgument(
        "this model has no parameter or field '{}'; its parameters are {}, and its fields are param, std, covariance, "
        "intervals, names, x0, noise_variance and report",
        name, listed(fit.names));
}

std::vector<std::string> bounded_names(const Fit& fit) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < fit.at_bound.size(); ++i)
        if (fit.at_bound[i]) names.push_back(fit.names[i]);
    return names;
}

int give_initial_state(Call& call) {
    return give_columns(call, fit_self(call).initial_states);
}

int give_noise_variance(Call& call) {
    const Vector& variance = fit_self(call).fit.noise_variance;
    return variance.size() == 1 ? call.give(variance[0]) : call.give_vector(variance);
}

int give_report(Call& call) {
    const GreyFit& grey = fit_self(call);
    const Fit& fit = grey.fit;
    push_report(call, basic_estimate("greyest", fit));
    set_field(call, "noise_variance", fit.noise_variance, "singular_values", grey.singular_values, "iterations",
              static_cast<double>(fit.trace.size()), "intervals", grey.intervals, "x0", grey.initial_states, "x0_std",
              grey.initial_std, "at_bound", bounded_names(fit));
    give_list(call, grey.outputs, [&](const Matrix& y) { give_columns(call, y); });
    lua_setfield(call.state(), -2, "outputs");
    give_list(call, grey.states, [&](const Matrix& x) { give_columns(call, x); });
    lua_setfield(call.state(), -2, "states");
    return 1;
}

/// The parameters' own values, by place and by name.
template <Vector Fit::*kValues>
int give_by_name(Call& call) {
    const Fit& fit = fit_self(call).fit;
    push_named_vector(call.state(), fit.*kValues, fit.names);
    return 1;
}

constexpr std::array kEstimateFields = {
    Member{"param", guarded<give_by_name<&Fit::theta>>},
    Member{"std", guarded<give_by_name<&Fit::std>>},
    Member{"covariance", field<GreyEstimate, [](const GreyEstimate& e) { return e->fit.covariance; }>},
    Member{"intervals", field<GreyEstimate, [](const GreyEstimate& e) { return e->intervals; }>},
    Member{"names", field<GreyEstimate, [](const GreyEstimate& e) { return e->fit.names; }>},
    Member{"x0", guarded<give_initial_state>},
    Member{"noise_variance", guarded<give_noise_variance>},
    Member{"report", guarded<give_report>}};
constexpr std::array kEstimateOperators = {
    Member{"__tostring",
           localized_field<GreyEstimate,
                           [](const GreyEstimate& e, const Reader& reader) { return grey_presentation(*e, reader); }>},
    Member{"__named", guarded<parameter_named>}};

constexpr FunctionEntry kGreyestFunctions[] = {
    {"greyest", "grey box", "greyest(data, m, {options}) -> G",
     marked("estimator", "Estimate the parameters of a grey-box model"), guarded<estimate_grey_box>, kGreyest,
     kGreyestArguments},
};

constexpr std::array kGreyestTypes = {
    TypeEntry{&Userdata<GreyEstimate>::type, kEstimateFields, {}, kEstimateOperators}};

}  // namespace

TypeEntries greyest_types() {
    return kGreyestTypes;
}

FunctionEntries greyest_functions() {
    return kGreyestFunctions;
}

}  // namespace dynlab::inline scripting
