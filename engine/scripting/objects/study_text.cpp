#include "scripting/objects/study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/reader.h"
#include "scripting/conversions/option_words.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kSignificantDeviation = 4;  // standard errors of a mean beyond which an offset is significant

/// A row of a study's table: who, what, a value for each parameter.
std::string value_row(const std::string& who, const char* what, const Vector& values, int who_width) {
    std::string row = fmt::format("  {:<{}}  {:<15}", who, who_width, what);
    for (const double value : values) row += fmt::format("{:>12}", std::isfinite(value) ? number_text(value) : "-");
    return row + "\n";
}

std::string header_of(const MonteCarloResult& result, int who_width) {
    std::string text = fmt::format("  {:<{}}  {:<15}", "", who_width, "");
    for (const std::string& name : result.names) text += fmt::format("{:>12}", name);
    text += "\n";
    if (result.truth.size() > 0) text += value_row("truth", "", result.truth, who_width);
    if (result.bound.size() > 0) text += value_row("", "Cramer-Rao std", result.least_spread(), who_width);
    return text;
}

std::string block_of(const MonteCarloResult& result, int who_width) {
    std::string text = value_row(result.label, "mean", result.mean, who_width);
    text += value_row("", "std", result.spread, who_width);
    if (result.reported.array().isFinite().any()) text += value_row("", "reported std", result.reported, who_width);
    return text;
}

std::string bias_of(const MonteCarloResult& result) {
    std::vector<std::string> names;
    const double root = std::sqrt(static_cast<double>(result.estimated));
    for (Index i = 0; i < result.bias.size(); ++i)
        if (std::abs(result.bias[i]) > kSignificantDeviation * result.spread[i] / root)
            names.push_back(result.names[static_cast<std::size_t>(i)]);
    if (names.empty()) return "";
    return fmt::format("{} is biased: the mean of {} is off the true value by more than chance explains.\n",
                       result.label, fmt::join(names, ", "));
}

std::string troubles_of(const MonteCarloResult& result, int runs) {
    std::string text;
    if (result.failed > 0)
        text += fmt::format("{}: {} of {} runs failed and are left out; the first one says: {}.\n", result.label,
                            result.failed, runs, in_lua_words(result.first_failure));
    if (result.not_converged > 0)
        text += fmt::format("{}: {} of {} runs did not converge; their last values are counted.\n", result.label,
                            result.not_converged, runs);
    return text;
}

std::string notes_on(const OrderCandidate& candidate) {
    std::vector<std::string> notes;
    if (candidate.cancellation) notes.emplace_back("a zero cancels a pole");
    if (!candidate.undetermined.empty())
        notes.push_back(fmt::format("{} undetermined", fmt::join(candidate.undetermined, ", ")));
    if (!candidate.converged) notes.emplace_back("not converged");
    return fmt::format("{}", fmt::join(notes, "; "));
}

std::string candidate_row(const OrderCandidate& candidate, bool chosen, bool validated, bool delays) {
    std::string row = fmt::format("{} {:>5} {:>5}", chosen ? '*' : ' ', candidate.poles, candidate.zeros);
    if (delays) row += fmt::format(" {:>9}", number_text(candidate.delay, 4));
    if (!candidate.failure.empty()) return row + "  not estimated: " + in_lua_words(candidate.failure) + "\n";
    row += fmt::format(" {:>9.5f} {:>8.3f} {:>9.4f} {:>9.4f} {:>10} {:>8.2f} {:>5} {:>7.2f}", candidate.r_squared,
                       candidate.yic, candidate.aic, candidate.bic, number_text(candidate.fpe, 4),
                       candidate.log_condition, candidate.iterations, candidate.fit_percent);
    if (validated) row += fmt::format(" {:>8.2f}", *candidate.validation_fit);
    const std::string notes = notes_on(candidate);
    return row + (notes.empty() ? "" : "  " + notes) + "\n";
}

}  // namespace

std::string monte_carlo_text(const MonteCarlo& study) {
    std::string text = fmt::format("Monte Carlo study of {} runs, noise of standard deviation {}", study.runs,
                                   number_text(study.sigma));
    text += std::isfinite(study.snr) ? fmt::format(" (SNR {} dB)\n", number_text(study.snr, 3)) : "\n";
    if (study.cancelled) text += "The study was stopped before its end.\n";
    std::size_t who_width = 5;
    for (const MonteCarloResult& result : study.results) who_width = std::max(who_width, result.label.size());
    const MonteCarloResult* before = nullptr;
    for (const MonteCarloResult& result : study.results) {
        if (result.estimated == 0) continue;
        if (before == nullptr || before->names != result.names) text += header_of(result, static_cast<int>(who_width));
        text += block_of(result, static_cast<int>(who_width));
        before = &result;
    }
    for (const MonteCarloResult& result : study.results) text += bias_of(result) + troubles_of(result, study.runs);
    return text;
}

std::string order_table_text(const OrderSelection& selection, const OrderChoice& choice) {
    const bool delays = std::any_of(selection.candidates.begin(), selection.candidates.end(),
                                    [](const OrderCandidate& candidate) { return candidate.delay > 0; });
    std::string text = fmt::format("  {:>5} {:>5}", "poles", "zeros");
    if (delays) text += fmt::format(" {:>9}", "delay (s)");
    text += fmt::format(" {:>9} {:>8} {:>9} {:>9} {:>10} {:>8} {:>5} {:>7}", "R_T^2", "YIC", "AIC", "BIC", "FPE",
                        "log cond", "iter", "fit (%)");
    if (selection.validated) text += fmt::format(" {:>8}", "val. (%)");
    text += "\n";
    for (std::size_t i = 0; i < selection.candidates.size(); ++i)
        text += candidate_row(selection.candidates[i], i == choice.place, selection.validated, delays);
    return text + in_lua_words(choice.explanation) + "\n";
}

std::string arx_table_text(const ArxSelection& selection, const OrderChoice& choice) {
    std::string text = fmt::format("  {:>4} {:>4} {:>4} {:>10} {:>11} {:>9} {:>9}", "na", "nb", "nk", "parameters",
                                   "loss", "AIC", "BIC");
    if (selection.validated) text += fmt::format(" {:>11}", "val. loss");
    text += "\n";
    for (std::size_t i = 0; i < selection.candidates.size(); ++i) {
        const ArxCandidate& one = selection.candidates[i];
        text += fmt::format("{} {:>4} {:>4} {:>4} {:>10} {:>11} {:>9.4f} {:>9.4f}", i == choice.place ? '*' : ' ',
                            one.na, one.nb, one.nk, one.parameters(), number_text(one.loss, 5), one.aic, one.bic);
        if (one.validation_loss) text += fmt::format(" {:>11}", number_text(*one.validation_loss, 5));
        text += one.determined ? "\n" : "  not determined: the input is too poor\n";
    }
    return text + message_text(choice.explanation) + "\n";
}

}  // namespace dynlab::inline scripting
