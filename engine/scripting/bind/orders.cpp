#include <array>
#include <cmath>

#include "data_io/values/estimate_descriptions.h"
#include "figures/plots/arx_order_plot.h"
#include "figures/plots/delay_plot.h"
#include "figures/plots/order_plot.h"
#include "numerics/validation/delay_search.h"
#include "platform/terminal/progress.h"
#include "scripting/arguments/estimator_arguments.h"
#include "scripting/arguments/estimator_options.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "scripting/objects/data_object.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/study_objects.h"
#include "scripting/objects/study_text.h"

namespace dynlab::inline scripting {
namespace {

constexpr std::array kStructureOrders = {kNb, kNf, kNk};

constexpr OptionEntry kSearchLambda = kFirstFilterOptions[0];
constexpr OptionEntry kValidate = {"validate", ValueKind::kData, about("validation data")};
template <auto kMember>
constexpr OptionEntry kSearchThreads = option<kMember>("threads", about("number of threads; 0 for all cores"));

constexpr OptionEntry kGridOptions[] = {
    {"poles", ValueKind::kAny, about("numbers of poles: {from, to}, or one number"), {.initial = "{1, 4}"}},
    {"zeros", ValueKind::kAny, about("numbers of zeros: {from, to}, or one number"), {.initial = "{0, 2}"}},
    {"delays",
     ValueKind::kAny,
     about("delays to try, in samples, such as {0, 1, 2}; cannot be combined with `TdMax`"),
     {.initial = "0"}},
    {"Feedthrough",
     ValueKind::kFlag,
     about("true also includes structures with as many zeros as poles"),
     {.initial = "false"}}};
constexpr std::array kGridDelayOptions = delay_search_options(
    about("largest delay in the search; if you do not specify `TdMax`, the search uses the delays in `delays`"));
constexpr std::array kFreeDelayOptions = delay_search_options(
    about("largest delay in the search, greater than `TdMin`; by default, a bound computed from the data"));
constexpr std::array kStructureOptions = {kValidate, kSearchLambda, kStableOption,
                                          kSearchThreads<&OrderSelectionOptions::threads>};
constexpr OptionTable kOrderListTables[] = {kStructureOptions, kStartOptions, kIterationOptions, kIntegrationOptions},
                      kOrderGridTables[] = {kGridOptions,  kGridDelayOptions, kStructureOptions,
                                            kStartOptions, kIterationOptions, kIntegrationOptions};
constexpr OptionEntry kArxOptions[] = {
    {"na", ValueKind::kAny, about("numbers of poles: {from, to}, or one number"), {.initial = "{1, 4}"}},
    {"nb", ValueKind::kAny, about("numbers of coefficients of B: {from, to}, or one number"), {.initial = "{1, 4}"}},
    {"nk", ValueKind::kAny, about("delays in samples: {from, to}, or one number"), {.initial = "1"}},
    kValidate};
constexpr OptionTable kArxstrucTables[] = {kArxOptions};
constexpr OptionEntry kDelayGridOptions[] = {
    {"poles", ValueKind::kAny, about("numbers of poles: {from, to}, or one number"), {.initial = "{1, 3}"}},
    {"zeros", ValueKind::kAny, about("numbers of zeros: {from, to}, or one number"), {.initial = "{0, 1}"}}};
constexpr std::array kDelaySearchOptions = {kSearchLambda, kSearchThreads<&DelaySearchOptions::threads>};
constexpr OptionTable kDelayestTables[] = {kDelayGridOptions, kFreeDelayOptions, kDelaySearchOptions, kStartOptions,
                                           kIterationOptions};

constexpr ArgumentEntry kSingleArguments[] = {
    {"data", ValueKind::kData, about("data object with one input and one output")}};
constexpr ArgumentEntry kArxArguments[] = {
    {"data", ValueKind::kData, about("data object with one input and one output, sampled regularly")}};
constexpr ArgumentEntry kChoiceArguments[] = {
    {"V", ValueKind::kAny, about("result of `srivcstruc`")},
    {"criterion", ValueKind::kText,
     about("\"recommended\" (the default), \"RT2\", \"YIC\", \"AIC\", \"BIC\", \"FPE\", \"fit\" or "
           "\"validation\"")}};
constexpr ArgumentEntry kArxChoiceArguments[] = {
    {"V", ValueKind::kAny, about("result of `arxstruc`")},
    {"criterion", ValueKind::kText,
     about("\"loss\", \"AIC\", or \"BIC\" (also called \"MDL\"); by default \"loss\" if V contains validation losses, "
           "otherwise \"BIC\"")}};

/// {from, to} or a single number.
std::pair<int, int> range_of(const Options& options, const char* name, std::pair<int, int> fallback) {
    if (!options.has(name)) return fallback;
    lua_State* L = options.call().state();
    const bool single = lua_isnumber(L, options.push(name));
    lua_pop(L, 1);
    if (single) {
        const int value = static_cast<int>(options.size(name, 0));
        return {value, value};
    }
    const auto [from, to] = *options.range(name);
    if (from != std::floor(from) || to != std::floor(to))
        throw InvalidArgument(
            "option '{}' must be one whole number, or two whole numbers {from, to}, but {{}, {}} was given", name,
            significant(from, 10), significant(to, 10));
    return {static_cast<int>(from), static_cast<int>(to)};
}

/// Seconds for numbers of samples of delay; default: 0.
std::vector<double> delays_of(const Options& options, const IdData& data) {
    if (!options.has("delays")) return {0.0};
    lua_State* L = options.call().state();
    const bool single = lua_isnumber(L, options.push("delays"));
    lua_pop(L, 1);
    const Vector samples = single ? Vector::Constant(1, options.number("delays", 0)) : Vector(options.vector("delays"));
    if (!data.regular())
        throw InvalidArgument(
            "option 'delays' requires regularly sampled data, because the delays are numbers of samples; specify "
            "option 'TdMax' instead");
    std::vector<double> delays;
    for (const double k : samples) {
        if (k < 0 || k != std::floor(k))
            throw InvalidArgument(
                "option 'delays' must contain nonnegative whole numbers of samples, such as {0, 1, 2}, "
                "but it contains {}",
                significant(k, 10));
        delays.push_back(k * data.Ts);
    }
    return delays;
}

/// The ranges of poles and zeros, with fixed delays, or an estimated one when TdMax is given.
std::vector<TransferStructure> grid_of(const Options& options, const IdData& data) {
    const bool free_delay = options.has("TdMax");
    if (free_delay && options.has("delays"))
        throw InvalidArgument(
            "options 'delays' (a list of delays to try) and 'TdMax' (the upper limit of an estimated delay) cannot be "
            "combined; omit one of these options");
    return order_grid(range_of(options, "poles", {1, 4}), range_of(options, "zeros", {0, 2}),
                      free_delay ? std::vector{options.number("TdMin", 0)} : delays_of(options, data), free_delay,
                      options.flag("Feedthrough", false));
}

/// A list of order vectors {{nb, nf, nk}, ...}, the second argument; each vector replaces the list at index 2 while it
/// is read.
std::vector<TransferStructure> listed_structures(const Call& call, const IdData& data) {
    lua_State* L = call.state();
    std::vector<TransferStructure> structures;
    lua_pushvalue(L, 2);
    const int list = lua_gettop(L);
    for (lua_Integer i = 1; lua_rawgeti(L, list, i) != LUA_TNIL; ++i) {
        lua_replace(L, 2);
        const auto orders = order_lists(call, 2, kStructureOrders);
        for (const auto& entry : orders)
            if (entry.size() != 1) throw InvalidArgument("the orders {nb, nf, nk} must be numbers, not lists");
        if (orders[0][0] < 1)
            throw InvalidArgument("nb, the number of coefficients of B, must be at least 1, but {} was given",
                                  orders[0][0]);
        structures.push_back(TransferStructure::single(orders[1][0], orders[0][0] - 1, orders[2][0] * data.Ts));
    }
    lua_settop(L, list);
    lua_replace(L, 2);
    return structures;
}

bool is_list(const Call& call, int index) {
    const bool found = call.type(index) == LUA_TTABLE && lua_rawgeti(call.state(), index, 1) == LUA_TTABLE;
    lua_settop(call.state(), call.count());
    return found;
}

/// The validation data set, or nothing.
const IdData* validation_data(const Options& options) {
    if (!options.has("validate")) return nullptr;
    const IdData* data_set = to_object<IdData>(options.call().state(), options.push("validate"));
    if (data_set == nullptr)
        throw InvalidArgument("option 'validate' must be a data object, but {} was given",
                              given_value(options.call().state(), -1));
    return data_set;
}

int try_structures(Call& call) {
    call.at_most(3);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const bool listed = is_list(call, 2);
    const Options options(call, listed ? 3 : 2,
                          listed ? OptionTables(kOrderListTables) : OptionTables(kOrderGridTables));
    const std::vector<TransferStructure> structures = listed ? listed_structures(call, data) : grid_of(options, data);
    OrderSelectionOptions requested;
    options.read(requested);
    requested.validation = validation_data(options);
    requested.cancel = call.cancel();
    requested.estimation = fit_options(options, Purpose::kModel);
    ProgressBar bar("order search", structures.size());
    requested.progress = [&bar](std::size_t done) { bar.advance(done); };
    OrderTable table{select_order(data, structures, requested), {}};
    poll_stop(call.state());
    table.choice = choose_order(table.selection);
    push_object(call.state(), std::move(table));
    return 1;
}

OrderCriterion criterion_of(const Call& call) {
    if (!call.given(2)) return OrderCriterion::kRecommended;
    const std::string text = call.text(2, "criterion");
    if (text == "recommended") return OrderCriterion::kRecommended;
    for (const OrderMeasure& measure : order_measures())
        if (text == measure.word) return measure.criterion;
    throw InvalidArgument(
        "{} must be {}, but \"{}\" was given", Message("the criterion"),
        Message("\"recommended\", \"RT2\", \"YIC\", \"AIC\", \"BIC\", \"FPE\", \"fit\" or \"validation\""), text);
}

int select_structure(Call& call) {
    call.at_most(2);
    const OrderTable& table = object_argument<OrderTable>(call, 1, "table");
    const OrderCriterion criterion = criterion_of(call);
    const OrderChoice choice = choose_order(table.selection, criterion);
    call.print(order_table_text(table.selection, choice, reader_of(call)));
    const OrderCandidate& candidate = table.selection.candidates[choice.place];
    give_fit(call, "srivc", candidate.estimate);
    give_figure(call, order_plot(table.selection, criterion, choice));
    return 2;
}

int try_arx_structures(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, kArxstrucTables);
    ArxRanges ranges;
    ranges.na = range_of(options, "na", ranges.na);
    ranges.nb = range_of(options, "nb", ranges.nb);
    ranges.nk = range_of(options, "nk", ranges.nk);
    push_object(call.state(), select_arx(data, ranges, validation_data(options)));
    return 1;
}

/// BIC is MDL to users of MATLAB.
ArxCriterion arx_criterion_of(const Call& call, const ArxSelection& table) {
    if (!call.given(2)) return usual_criterion(table);
    const std::string text = call.text(2, "criterion");
    for (const auto& [name, criterion] : {std::pair("loss", ArxCriterion::kLoss), std::pair("AIC", ArxCriterion::kAic),
                                          std::pair("BIC", ArxCriterion::kBic), std::pair("MDL", ArxCriterion::kBic)})
        if (text == name) return criterion;
    throw InvalidArgument("{} must be {}, but \"{}\" was given", Message("the criterion"),
                          Message("\"loss\", \"AIC\", \"BIC\" or \"MDL\""), text);
}

int select_arx_structure(Call& call) {
    call.at_most(2);
    const ArxSelection& table = object_argument<ArxSelection>(call, 1, Message("the result of arxstruc"));
    const ArxCriterion criterion = arx_criterion_of(call, table);
    const OrderChoice choice = choose_arx(table, criterion);
    call.print(arx_table_text(table, choice, reader_of(call)));
    const ArxCandidate& chosen = table.candidates[choice.place];
    give_value(call, std::array{chosen.na, chosen.nb, chosen.nk});
    give_figure(call, arx_order_plot(table, criterion, choice));
    return 2;
}

/// {std =, samples =, delays =, losses =, rival =, poles =, zeros =, model =, message =}
void push_search(const Call& call, const IdData& data, const DelaySearch& search) {
    lua_State* L = call.state();
    give_table(call, "delay", search.delay, "std", search.std);
    if (data.regular()) set_field(call, "samples", search.delay / data.Ts);
    set_field(call, "rival", search.rival, "delays", search.grid(), "losses", search.losses(), "poles",
              search.candidate.poles, "zeros", search.candidate.zeros, "message", localized(call, search.explanation));
    give_fit(call, "srivc", search.candidate.estimate);
    lua_setfield(L, -2, "model");
}

int estimate_delay(Call& call) {
    call.at_most(2);
    const IdData& data = object_argument<IdData>(call, 1, "data");
    const Options options(call, 2, kDelayestTables);
    DelaySearchOptions requested;
    options.read(requested);
    requested.poles = range_of(options, "poles", requested.poles);
    requested.zeros = range_of(options, "zeros", requested.zeros);
    requested.estimation = fit_options(options, Purpose::kModel);
    requested.cancel = call.cancel();
    ProgressBar bar("delay search", order_grid(requested.poles, requested.zeros, {0.0}).size());
    requested.progress = [&bar](std::size_t done) { bar.advance(done); };
    const DelaySearch search = search_delay(data, requested);
    poll_stop(call.state());
    call.print(localized(call, search.explanation) + "\n");
    call.give(search.delay);
    give_figure(call, delay_plot(search));
    push_search(call, data, search);
    return 3;
}

constexpr FunctionEntry kOrdersFunctions[] = {
    {"srivcstruc", "structure", "srivcstruc(data, {options}) -> V",
     "Estimate models with srivc for several numbers of poles and zeros and several delays",
     guarded<memoized_call<try_structures>>, kOrderGridTables, kSingleArguments},
    {"selcstruc", "structure", "selcstruc(V, criterion) -> G, fig",
     "Select a structure from the result of srivcstruc by a criterion", guarded<select_structure>, kNoOptions,
     kChoiceArguments},
    {"arxstruc", "structure", "arxstruc(data, {options}) -> V", "Compute the loss of ARX models of several orders",
     guarded<try_arx_structures>, kArxstrucTables, kArxArguments},
    {"selstruc", "structure", "selstruc(V, criterion) -> {na, nb, nk}, fig",
     "Select the orders from the result of arxstruc by a criterion", guarded<select_arx_structure>, kNoOptions,
     kArxChoiceArguments},
    {"delayest", "structure", "delayest(data, {options}) -> Td, fig, D", "Estimate the delay between input and output",
     guarded<memoized_call<estimate_delay>>, kDelayestTables, kSingleArguments},
};

}  // namespace

FunctionEntries order_functions() {
    return kOrdersFunctions;
}

}  // namespace dynlab::inline scripting
