#include "numerics/validation/advice.h"

#include <algorithm>
#include <cmath>

namespace dynlab::inline numerics {

namespace {

bool spoils_a_stretch(const DataIssue& issue) {
    return issue.experiment == 0 && (issue.code == "saturation" || issue.code == "nonlinear");
}

bool forbids_a_model(const DataIssue& issue) {
    return issue.code == "constant" || issue.code == "time_column" || issue.code == "same_column" ||
           issue.code == "wrapped";
}

double rms_within(const Vector& x, const std::vector<Segment>& sections) {
    double squares = 0, count = 0;
    for (const Segment& s : sections) {
        squares += x.segment(s.first - 1, s.last - s.first + 1).squaredNorm();
        count += static_cast<double>(s.last - s.first + 1);
    }
    return std::sqrt(squares / count);
}

/// A signal that stays where the model says that it stays has not run into a limit.
bool is_expected(const DataIssue& saturation, const Vector& error, double range) {
    constexpr double kAsUsual = 1.5, kSmall = 0.03;
    if (error.size() == 0) return false;
    const double usual = std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
    return rms_within(error, saturation.sections) < std::min(kAsUsual * usual, kSmall * range);
}

/// What the signal alone let suspect and the model does not: fast passages. And once is enough.
void add(ModelAdvice model, const std::string& output, double range, std::vector<DataIssue>& findings) {
    const auto of_channel = [&](const char* code) {
        return
            [&output, code](const DataIssue& f) { return f.experiment == 0 && f.channel == output && f.code == code; };
    };
    if (model.checks_outliers) std::erase_if(findings, of_channel("outliers"));
    std::erase_if(findings, [&](const DataIssue& f) {
        return of_channel("saturation")(f) && is_expected(f, model.error, range);
    });
    if (std::ranges::any_of(findings, of_channel("saturation")))
        std::erase_if(model.findings, of_channel("saturation"));
    for (DataIssue& issue : model.findings) findings.push_back(std::move(issue));
}

}  // namespace

bool Advice::has(const std::string& code) const {
    return find(code) != nullptr;
}

const DataIssue* Advice::find(const std::string& code) const {
    const auto found = std::ranges::find(findings, code, &DataIssue::code);
    return found == findings.end() ? nullptr : &*found;
}

bool Advice::clean() const {
    return std::ranges::none_of(findings, [](const DataIssue& f) { return f.weight == Weight::kWarning; });
}

Advice advise(const IdData& data, const std::function<bool()>& cancel) {
    Advice advice{signal_advice(data), {}};
    const bool usable = std::ranges::none_of(advice.findings, forbids_a_model);
    if (usable && data.input_count() == 1 && data.regular())
        for (Index output = 1; output <= data.output_count(); ++output) {
            const auto y = data.experiments.front().y.col(output - 1);
            add(model_advice(data.select({output}, {1}), cancel),
                data.output_names[static_cast<std::size_t>(output - 1)], y.maxCoeff() - y.minCoeff(), advice.findings);
        }
    std::ranges::stable_sort(advice.findings,
                             [](const DataIssue& a, const DataIssue& b) { return a.weight > b.weight; });
    for (const DataIssue& issue : advice.findings)
        if (spoils_a_stretch(issue))
            advice.discard.insert(advice.discard.end(), issue.sections.begin(), issue.sections.end());
    advice.discard = joined(advice.discard);
    return advice;
}

}  // namespace dynlab::inline numerics
