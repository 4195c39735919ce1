#include "scripting/objects/study_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/reader.h"

namespace dynlab::inline scripting {
namespace {

constexpr double kSignificantDeviation = 4;  // standard errors of a mean beyond which an offset is significant

/// Builds the tables for one reader.
class StudyText {
  public:
    explicit StudyText(const Reader& reader) : reader_(reader) {}
    std::string of(const MonteCarlo& study) const;
    std::string of(const OrderSelection& selection, const OrderChoice& choice) const;
    std::string of(const ArxSelection& selection, const OrderChoice& choice) const;

  private:
    std::string text(const Message& message) const { return message_text(message, reader_); }
    std::string text(double value, int digits = 5) const { return number_text(significant(value, digits), reader_); }
    std::string fixed(double value, int digits) const { return number_text(decimals(value, digits), reader_); }
    std::string value_row(const std::string& who, const std::string& what, const Vector& values, int who_width) const;
    std::string header_of(const MonteCarloResult& result, int who_width) const;
    std::string block_of(const MonteCarloResult& result, int who_width) const;
    std::string bias_of(const MonteCarloResult& result) const;
    std::string failures_of(const MonteCarloResult& result, int runs) const;
    std::string candidate_row(const OrderCandidate& candidate, bool chosen, bool validated, bool delays,
                              std::size_t note) const;

    Reader reader_;
};

/// A row of a study's table: who, what, a value for each parameter.
std::string StudyText::value_row(const std::string& who, const std::string& what, const Vector& values,
                                 int who_width) const {
    std::string row = fmt::format("  {:<{}}  {:<15}", who, who_width, what);
    for (const double value : values) row += fmt::format("{:>12}", std::isfinite(value) ? text(value) : "-");
    return row + "\n";
}

std::string StudyText::header_of(const MonteCarloResult& result, int who_width) const {
    std::string rows = fmt::format("  {:<{}}  {:<15}", "", who_width, "");
    for (const std::string& name : result.names) rows += fmt::format("{:>12}", name);
    rows += "\n";
    if (result.truth.size() > 0) rows += value_row(text(Message("truth")), "", result.truth, who_width);
    if (result.bound.size() > 0)
        rows += value_row("", text(Message("Cramer-Rao std")), result.least_spread(), who_width);
    return rows;
}

std::string StudyText::block_of(const MonteCarloResult& result, int who_width) const {
    std::string rows = value_row(result.label, text(Message("mean")), result.mean, who_width);
    rows += value_row("", text(Message("std")), result.spread, who_width);
    if (result.reported.array().isFinite().any())
        rows += value_row("", text(Message("reported std")), result.reported, who_width);
    return rows;
}

std::string StudyText::bias_of(const MonteCarloResult& result) const {
    std::vector<std::string> names;
    const double root = std::sqrt(static_cast<double>(result.estimated));
    for (Index i = 0; i < result.bias.size(); ++i)
        if (std::abs(result.bias[i]) > kSignificantDeviation * result.spread[i] / root)
            names.push_back(result.names[static_cast<std::size_t>(i)]);
    if (names.empty()) return "";
    return text(Message("{} is biased in {}: the mean differs significantly from the true value.", result.label,
                        listed(names))) +
           "\n";
}

std::string StudyText::failures_of(const MonteCarloResult& result, int runs) const {
    std::string lines;
    if (result.failed > 0)
        lines += text(Message("{}: {} of {} runs failed; the results exclude failed runs. First error: {}.",
                              result.label, result.failed, runs, result.first_failure)) +
                 "\n";
    if (result.not_converged > 0)
        lines += text(Message("{}: {} of {} runs did not converge; the results include the last values of such runs.",
                              result.label, result.not_converged, runs)) +
                 "\n";
    return lines;
}

Message notes_on(const OrderCandidate& candidate) {
    MessageList notes{{}, Join::kSemicolon};
    if (candidate.cancellation) notes.items.push_back(Message("a zero cancels a pole"));
    if (!candidate.undetermined.empty())
        notes.items.push_back(Message("{} undetermined", listed(candidate.undetermined)));
    if (!candidate.converged) notes.items.push_back(Message("not converged"));
    return notes.items.empty() ? Message() : Message("{}", notes);
}

/// `note`: the number of the line below the table that says more, 0 for none. Behind the row it would wrap on paper.
std::string StudyText::candidate_row(const OrderCandidate& candidate, bool chosen, bool validated, bool delays,
                                     std::size_t note) const {
    std::string row = fmt::format("{} {:>5} {:>5}", chosen ? '*' : ' ', candidate.poles, candidate.zeros);
    if (delays) row += fmt::format(" {:>9}", text(candidate.delay, 4));
    if (!candidate.failure.empty()) return row + "  " + text(Message("not estimated: {}", candidate.failure)) + "\n";
    row +=
        fmt::format(" {:>9} {:>8} {:>9} {:>9} {:>10} {:>8} {:>5} {:>7}", fixed(candidate.r_squared, 5),
                    fixed(candidate.yic, 3), fixed(candidate.aic, 4), fixed(candidate.bic, 4), text(candidate.fpe, 4),
                    fixed(candidate.log_condition, 2), candidate.iterations, fixed(candidate.fit_percent, 2));
    if (validated) row += fmt::format(" {:>8}", fixed(*candidate.validation_fit, 2));
    return row + (note == 0 ? "" : fmt::format(" ({})", note)) + "\n";
}

std::string StudyText::of(const MonteCarlo& study) const {
    const Number sigma = significant(study.sigma, 5);
    std::string lines =
        text(std::isfinite(study.snr)
                 ? Message("Monte Carlo study of {} runs with a noise standard deviation of {} (SNR {} dB)", study.runs,
                           sigma, significant(study.snr, 3))
                 : Message("Monte Carlo study of {} runs with a noise standard deviation of {}", study.runs, sigma)) +
        "\n";
    if (study.canceled) lines += text(Message("The study was interrupted.")) + "\n";
    std::size_t who_width = 5;
    for (const MonteCarloResult& result : study.results) who_width = std::max(who_width, result.label.size());
    const MonteCarloResult* before = nullptr;
    for (const MonteCarloResult& result : study.results) {
        if (result.estimated == 0) continue;
        if (before == nullptr || before->names != result.names) lines += header_of(result, static_cast<int>(who_width));
        lines += block_of(result, static_cast<int>(who_width));
        before = &result;
    }
    for (const MonteCarloResult& result : study.results) lines += bias_of(result) + failures_of(result, study.runs);
    return lines;
}

std::string StudyText::of(const OrderSelection& selection, const OrderChoice& choice) const {
    const bool delays = std::any_of(selection.candidates.begin(), selection.candidates.end(),
                                    [](const OrderCandidate& candidate) { return candidate.delay > 0; });
    std::string lines = fmt::format("  {:>5} {:>5}", text(Message("poles")), text(Message("zeros")));
    if (delays) lines += fmt::format(" {:>9}", text(Message("delay (s)")));
    lines += fmt::format(" {:>9} {:>8} {:>9} {:>9} {:>10} {:>8} {:>5} {:>7}", "R_T^2", "YIC", "AIC", "BIC", "FPE",
                         "log cond", "iter", text(Message("fit (%)")));
    if (selection.validated) lines += fmt::format(" {:>8}", text(Message("val. (%)")));
    lines += "\n";
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < selection.candidates.size(); ++i) {
        const OrderCandidate& candidate = selection.candidates[i];
        const std::string note = candidate.failure.empty() ? text(notes_on(candidate)) : "";
        const auto known = std::ranges::find(notes, note);
        const std::size_t number = note.empty() ? 0 : static_cast<std::size_t>(known - notes.begin()) + 1;
        if (number > notes.size()) notes.push_back(note);
        lines += candidate_row(candidate, i == choice.place, selection.validated, delays, number);
    }
    for (std::size_t i = 0; i < notes.size(); ++i) lines += fmt::format("({}) {}\n", i + 1, notes[i]);
    return lines + text(choice.explanation) + "\n";
}

std::string StudyText::of(const ArxSelection& selection, const OrderChoice& choice) const {
    std::string lines = fmt::format("  {:>4} {:>4} {:>4} {:>10} {:>11} {:>9} {:>9}", "na", "nb", "nk",
                                    text(Message("parameters")), text(Message("loss")), "AIC", "BIC");
    if (selection.validated) lines += fmt::format(" {:>11}", text(Message("val. loss")));
    lines += "\n";
    for (std::size_t i = 0; i < selection.candidates.size(); ++i) {
        const ArxCandidate& one = selection.candidates[i];
        lines += fmt::format("{} {:>4} {:>4} {:>4} {:>10} {:>11} {:>9} {:>9}", i == choice.place ? '*' : ' ', one.na,
                             one.nb, one.nk, one.parameters(), text(one.loss), fixed(one.aic, 4), fixed(one.bic, 4));
        if (one.validation_loss) lines += fmt::format(" {:>11}", text(*one.validation_loss));
        if (!one.determined) lines += "  " + text(Message("not determined: the input is not persistently exciting"));
        lines += "\n";
    }
    return lines + text(choice.explanation) + "\n";
}

}  // namespace

std::string monte_carlo_text(const MonteCarlo& study, const Reader& reader) {
    return StudyText(reader).of(study);
}
std::string order_table_text(const OrderSelection& selection, const OrderChoice& choice, const Reader& reader) {
    return StudyText(reader).of(selection, choice);
}
std::string arx_table_text(const ArxSelection& selection, const OrderChoice& choice, const Reader& reader) {
    return StudyText(reader).of(selection, choice);
}

}  // namespace dynlab::inline scripting
