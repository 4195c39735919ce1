#include <array>

#include "figures/plots/monte_carlo_plot.h"
#include "scripting/arguments/estimation.h"
#include "scripting/arguments/option_words.h"
#include "scripting/arguments/table_fields.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/study_objects.h"
#include "scripting/objects/study_text.h"

namespace dynlab::inline scripting {
namespace {

// ---- Monte Carlo study

const MonteCarlo& study_self(Call& call) {
    return object_argument<MonteCarlo>(call, 1, "study");
}

int push_result(const Call& call, const MonteCarloResult& result) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 16);
    set_texts(call, "names", result.names);
    set_matrix(call, "theta", result.theta);
    set_matrix(call, "reported", result.std);
    for (const auto& [name, values] :
         {std::pair("mean", &result.mean), std::pair("std", &result.spread), std::pair("median", &result.median),
          std::pair("min", &result.low), std::pair("max", &result.high), std::pair("reported_std", &result.reported)})
        set_vector(call, name, *values);
    if (result.truth.size() > 0) {
        set_vector(call, "truth", result.truth);
        set_vector(call, "bias", result.bias);
    }
    if (result.bound.size() > 0) {
        set_vector(call, "cramer_rao_std", result.least_spread());
        set_matrix(call, "cramer_rao", result.bound);
    }
    set_integer(L, "estimated", result.estimated);
    set_integer(L, "failed", result.failed);
    set_integer(L, "not_converged", result.not_converged);
    set_text(call, "first_failure", in_lua_words(result.first_failure));
    return 1;
}

/// study.lssvf
int study_named(Call& call) {
    const MonteCarlo& study = study_self(call);
    const std::string label = call.text(2, "label");
    std::vector<std::string> labels;
    for (const MonteCarloResult& result : study.results) {
        if (result.label == label) return push_result(call, result);
        labels.push_back(result.label);
    }
    throw InvalidArgument(fmt::format("this study has no estimator or field '{}'; its estimators are {}", label,
                                      fmt::join(labels, ", ")));
}

int study_labels(Call& call) {
    std::vector<std::string> labels;
    for (const MonteCarloResult& result : study_self(call).results) labels.push_back(result.label);
    lua_createtable(call.state(), 0, 1);
    set_texts(call, "labels", labels);
    lua_getfield(call.state(), -1, "labels");
    return 1;
}
int study_runs(Call& call) {
    return call.give_integer(study_self(call).runs);
}
int study_sigma(Call& call) {
    return call.give(study_self(call).sigma);
}
int study_snr(Call& call) {
    return call.give(study_self(call).snr);
}
int study_text(Call& call) {
    return call.give(monte_carlo_text(study_self(call)));
}

int draw_histograms(Call& call) {
    call.at_most(1);
    return give_figure(call, monte_carlo_histograms(study_self(call)));
}

int draw_scatter(Call& call) {
    call.at_most(4);
    const Options options(call, 4, {"level"});
    return give_figure(call, monte_carlo_scatter(study_self(call), call.text(2, "parameter on x"),
                                                 call.text(3, "parameter on y"), options.number("level", 0.95)));
}

constexpr std::array kStudyFields = {Member{"labels", guarded<study_labels>}, Member{"runs", guarded<study_runs>},
                                     Member{"sigma", guarded<study_sigma>}, Member{"snr", guarded<study_snr>}};
constexpr std::array kStudyMethods = {Member{"histograms", guarded<draw_histograms>},
                                      Member{"scatter", guarded<draw_scatter>}};
constexpr std::array kStudyOperators = {Member{"__tostring", guarded<study_text>},
                                        Member{"__named", guarded<study_named>}};

// ---- order table

const OrderTable& table_self(Call& call) {
    return object_argument<OrderTable>(call, 1, "table");
}

void push_candidate(const Call& call, const OrderCandidate& candidate) {
    lua_State* L = call.state();
    lua_createtable(L, 0, 16);
    set_integer(L, "poles", candidate.poles);
    set_integer(L, "zeros", candidate.zeros);
    set_number(L, "delay", candidate.delay);
    if (!candidate.failure.empty()) {
        set_text(call, "failure", in_lua_words(candidate.failure));
        return;
    }
    for (const auto& [name, value] :
         {std::pair("r_squared", candidate.r_squared), std::pair("yic", candidate.yic), std::pair("aic", candidate.aic),
          std::pair("bic", candidate.bic), std::pair("fpe", candidate.fpe),
          std::pair("log_condition", candidate.log_condition), std::pair("fit_percent", candidate.fit_percent)})
        set_number(L, name, value);
    if (candidate.validation_fit) set_number(L, "validation_fit", *candidate.validation_fit);
    set_integer(L, "iterations", candidate.iterations);
    set_texts(call, "undetermined", candidate.undetermined);
    set_flag(L, "cancellation", candidate.cancellation);
    set_flag(L, "converged", candidate.converged);
    give_transfer_estimate(call, "srivc", candidate.estimate);
    lua_setfield(L, -2, "model");
}

int table_rows(Call& call) {
    const OrderTable& table = table_self(call);
    lua_createtable(call.state(), static_cast<int>(table.selection.candidates.size()), 0);
    lua_Integer index = 0;
    for (const OrderCandidate& candidate : table.selection.candidates) {
        push_candidate(call, candidate);
        lua_rawseti(call.state(), -2, ++index);
    }
    return 1;
}
int table_best(Call& call) {
    const OrderTable& table = table_self(call);
    push_candidate(call, table.selection.candidates[table.choice.place]);
    return 1;
}
int table_recommendation(Call& call) {
    return call.give(table_self(call).choice.explanation);
}
int table_text(Call& call) {
    const OrderTable& table = table_self(call);
    return call.give(order_table_text(table.selection, table.choice));
}

constexpr std::array kTableFields = {Member{"rows", guarded<table_rows>}, Member{"best", guarded<table_best>},
                                     Member{"recommendation", guarded<table_recommendation>}};
constexpr std::array kTableOperators = {Member{"__tostring", guarded<table_text>}};

}  // namespace

const ObjectType Boxed<MonteCarlo>::type{"Monte Carlo study", kStudyFields, kStudyMethods, kStudyOperators};
const ObjectType Boxed<OrderTable>::type{"table of orders", kTableFields, {}, kTableOperators};

std::size_t Boxed<MonteCarlo>::outside_bytes(const MonteCarlo& study) {
    std::size_t numbers = 0;
    for (const MonteCarloResult& result : study.results)
        numbers += static_cast<std::size_t>(result.theta.size() + result.std.size() + result.bound.size());
    return numbers * sizeof(double) + study.results.size() * sizeof(MonteCarloResult);
}

std::size_t Boxed<OrderTable>::outside_bytes(const OrderTable& table) {
    std::size_t bytes = 0;
    for (const OrderCandidate& candidate : table.selection.candidates) {
        const auto d = static_cast<std::size_t>(candidate.parameters());
        bytes += sizeof(OrderCandidate) + sizeof(double) * d * (d + candidate.estimate.trace.size());
    }
    return bytes;
}

}  // namespace dynlab::inline scripting
