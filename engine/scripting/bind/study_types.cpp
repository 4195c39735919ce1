#include <array>

#include "figures/plots/monte_carlo_plot.h"
#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/figure_object.h"
#include "scripting/objects/fit_model.h"
#include "scripting/objects/study_objects.h"
#include "scripting/objects/study_text.h"

namespace dynlab::inline scripting {
namespace {

// ---- Monte Carlo study

const MonteCarlo& study_self(Call& call) {
    return object_argument<MonteCarlo>(call, 1, "study");
}

int push_result(const Call& call, const MonteCarloResult& result) {
    give_table(call, "names", result.names, "theta", result.theta, "reported", result.std, "mean", result.mean, "std",
               result.spread, "median", result.median, "min", result.low, "max", result.high, "reported_std",
               result.reported);
    if (result.truth.size() > 0) set_field(call, "truth", result.truth, "bias", result.bias);
    if (result.bound.size() > 0) set_field(call, "cramer_rao_std", result.least_spread(), "cramer_rao", result.bound);
    set_field(call, "estimated", result.estimated, "failed", result.failed, "not_converged", result.not_converged,
              "first_failure", localized(call, result.first_failure));
    return 1;
}

std::vector<std::string> labels_of(const MonteCarlo& study) {
    std::vector<std::string> labels;
    for (const MonteCarloResult& result : study.results) labels.push_back(result.label);
    return labels;
}

/// study.lssvf
int study_named(Call& call) {
    const MonteCarlo& study = study_self(call);
    const std::string label = call.text(2, "label");
    for (const MonteCarloResult& result : study.results)
        if (result.label == label) return push_result(call, result);
    throw InvalidArgument("unknown estimator or field of this study: '{}'; the estimators are {}", label,
                          listed(labels_of(study)));
}

int draw_histograms(Call& call) {
    call.at_most(1);
    return give_figure(call, monte_carlo_histograms(study_self(call)));
}

constexpr OptionEntry kScatterOptions[] = {
    {"level", ValueKind::kNumber, about("confidence level of the ellipse"), {.initial = "0.95"}}};
constexpr OptionTable kScatterTables[] = {kScatterOptions};

int draw_scatter(Call& call) {
    call.at_most(4);
    const Options options(call, 4, kScatterTables);
    return give_figure(
        call, monte_carlo_scatter(study_self(call), call.text(2, Message("parameter on the x-axis")),
                                  call.text(3, Message("parameter on the y-axis")), options.number("level", 0.95)));
}

constexpr std::array kStudyFields = {
    Member{"labels", field<MonteCarlo, labels_of>}, Member{"runs", field<MonteCarlo, &MonteCarlo::runs>},
    Member{"sigma", field<MonteCarlo, &MonteCarlo::sigma>}, Member{"snr", field<MonteCarlo, &MonteCarlo::snr>}};
constexpr std::array kStudyMethods = {Member{"histograms", guarded<draw_histograms>},
                                      Member{"scatter", guarded<draw_scatter>}};
constexpr std::array kStudyOperators = {Member{"__tostring", localized_field<MonteCarlo, monte_carlo_text>},
                                        Member{"__named", guarded<study_named>}};

// ---- order table

int push_candidate(const Call& call, const OrderCandidate& candidate) {
    lua_State* L = call.state();
    give_table(call, "poles", candidate.poles, "zeros", candidate.zeros, "delay", candidate.delay);
    if (!candidate.failure.empty()) {
        set_field(call, "failure", localized(call, candidate.failure));
        return 1;
    }
    set_field(call, "r_squared", candidate.r_squared, "yic", candidate.yic, "aic", candidate.aic, "bic", candidate.bic,
              "fpe", candidate.fpe, "log_condition", candidate.log_condition, "fit_percent", candidate.fit_percent,
              "validation_fit", candidate.validation_fit, "iterations", candidate.iterations, "undetermined",
              candidate.undetermined, "cancellation", candidate.cancellation, "converged", candidate.converged);
    give_fit(call, "srivc", candidate.estimate);
    lua_setfield(L, -2, "model");
    return 1;
}

int table_rows(Call& call) {
    return give_list(call, object_argument<OrderTable>(call, 1, "table").selection.candidates,
                     [&](const OrderCandidate& candidate) { push_candidate(call, candidate); });
}
int table_best(Call& call) {
    const OrderTable& table = object_argument<OrderTable>(call, 1, "table");
    return push_candidate(call, table.selection.candidates[table.choice.place]);
}
Message recommendation(const OrderTable& table) {
    return table.choice.explanation;
}
std::string table_text(const OrderTable& table, const Reader& reader) {
    return order_table_text(table.selection, table.choice, reader);
}

constexpr std::array kTableFields = {Member{"rows", guarded<table_rows>}, Member{"best", guarded<table_best>},
                                     Member{"recommendation", localized_field<OrderTable, recommendation>}};
constexpr std::array kTableOperators = {Member{"__tostring", localized_field<OrderTable, table_text>}};

// ---- table of ARX orders

int push_arx_candidate(const Call& call, const ArxCandidate& candidate) {
    return give_table(call, "na", candidate.na, "nb", candidate.nb, "nk", candidate.nk, "parameters",
                      candidate.parameters(), "loss", candidate.loss, "aic", candidate.aic, "bic", candidate.bic,
                      "validation_loss", candidate.validation_loss, "determined", candidate.determined);
}

int arx_rows(Call& call) {
    return give_list(call, object_argument<ArxSelection>(call, 1, "table").candidates,
                     [&](const ArxCandidate& candidate) { push_arx_candidate(call, candidate); });
}
OrderChoice usual_arx_choice(const ArxSelection& table) {
    return choose_arx(table, usual_criterion(table));
}
int arx_best(Call& call) {
    const ArxSelection& table = object_argument<ArxSelection>(call, 1, "table");
    return push_arx_candidate(call, table.candidates[usual_arx_choice(table).place]);
}
Message arx_recommendation(const ArxSelection& table) {
    return usual_arx_choice(table).explanation;
}
std::string arx_text(const ArxSelection& table, const Reader& reader) {
    return arx_table_text(table, usual_arx_choice(table), reader);
}

constexpr std::array kArxTableFields = {Member{"rows", guarded<arx_rows>}, Member{"best", guarded<arx_best>},
                                        Member{"recommendation", localized_field<ArxSelection, arx_recommendation>}};
constexpr std::array kArxTableOperators = {Member{"__tostring", localized_field<ArxSelection, arx_text>}};

constexpr std::array kStudyTypes = {
    TypeEntry{&Userdata<ArxSelection>::type, kArxTableFields, {}, kArxTableOperators},
    TypeEntry{&Userdata<MonteCarlo>::type, kStudyFields, kStudyMethods, kStudyOperators},
    TypeEntry{&Userdata<OrderTable>::type, kTableFields, {}, kTableOperators}};

}  // namespace

TypeEntries study_types() {
    return kStudyTypes;
}

}  // namespace dynlab::inline scripting
