#include "scripting/objects/grey_object.h"

#include <cmath>

#include "base/reader.h"

namespace dynlab::inline scripting {
namespace {

std::string parameter_line(const GreyFit& grey, Index i, const Reader& reader) {
    const auto place = static_cast<std::size_t>(i);
    const auto number = [&](double value, int digits) { return number_text(significant(value, digits), reader); };
    const std::string line = fmt::format("  {:<8} {:>12}  ", grey.fit.names[place], number(grey.fit.theta[i], 6));
    if (grey.model.parameters[place].fixed) return line + message_text(Message("(fixed)"), reader) + "\n";
    if (grey.fit.at_bound[place]) return line + message_text(Message("(at its bound)"), reader) + "\n";
    if (!std::isfinite(grey.fit.std[i]))
        return line + message_text(Message("(not determined by the data)"), reader) + "\n";
    return line + fmt::format("± {:<10} ", number(grey.fit.std[i], 3)) +
           message_text(
               Message("95 %: {} to {}", significant(grey.intervals(i, 0), 5), significant(grey.intervals(i, 1), 5)),
               reader) +
           "\n";
}

std::string initial_lines(const GreyFit& grey, const Reader& reader) {
    std::string text;
    const auto number = [&](double value, int digits) { return number_text(significant(value, digits), reader); };
    for (Index k = 0; k < grey.initial_states.cols(); ++k)
        for (Index i = 0; i < grey.initial_states.rows(); ++i) {
            if (grey.initial_std(i, k) == 0) continue;
            text += fmt::format("  {:<8} {:>12}  ± {}", grey.model.state_names[static_cast<std::size_t>(i)],
                                number(grey.initial_states(i, k), 6), number(grey.initial_std(i, k), 3));
            if (grey.initial_states.cols() > 1) text += "  " + message_text(Message("(experiment {})", k + 1), reader);
            text += "\n";
        }
    return text.empty() ? text : message_text(Message("Initial state:"), reader) + "\n" + text;
}

MessageList numbers_of(const Vector& values) {
    MessageList list{{}, Join::kAnd};
    for (const double value : values) list.items.push_back(Message("{}", significant(value, 4)));
    return list;
}

/// "93.2 % and 88.1"; the % behind the last one is the sentence's.
MessageList percents_of(const Vector& values) {
    MessageList list = numbers_of(values);
    for (std::size_t i = 0; i + 1 < list.items.size(); ++i) list.items[i] = Message("{} %", list.items[i]);
    return list;
}

}  // namespace

std::size_t Userdata<GreyEstimate>::outside_bytes(const GreyEstimate& estimate) {
    std::size_t numbers = 0;
    for (const auto* list : {&estimate->outputs, &estimate->states})
        for (const Matrix& values : *list) numbers += static_cast<std::size_t>(values.size());
    return numbers * sizeof(double);
}

GreyEstimate to_grey_box(const Call& call, int index) {
    if (index > call.count()) return nullptr;
    if (const GreyEstimate* estimate = to_object<GreyEstimate>(call.state(), index)) return *estimate;
    const GreyModel* model = to_object<GreyModel>(call.state(), index);
    return model != nullptr ? std::make_shared<const GreyFit>(unfitted_grey_box(*model)) : nullptr;
}

std::string grey_presentation(const GreyFit& grey, const Reader& reader) {
    std::string text = message_text(Message("grey-box model (states: {})", listed(grey.model.state_names)), reader);
    text += "\n" + message_text(Message("Parameters:"), reader) + "\n";
    for (Index i = 0; i < grey.fit.theta.size(); ++i) text += parameter_line(grey, i, reader);
    text += initial_lines(grey, reader);
    text += message_text(Message("Estimated by {}. Fit to the estimation data: {} % (simulation). Noise variance: {}.",
                                 "greyest", percents_of(grey.fit.fit_percent), numbers_of(grey.fit.noise_variance)),
                         reader);
    return text + "\n" + message_text(grey.fit.full_message(), reader) + "\n";
}

}  // namespace dynlab::inline scripting
