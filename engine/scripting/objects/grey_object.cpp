#include "scripting/objects/grey_object.h"

#include <cmath>

#include "base/number_text.h"
#include "scripting/conversions/option_words.h"

namespace dynlab::inline scripting {
namespace {

std::string parameter_line(const GreyFit& grey, Index i) {
    const auto place = static_cast<std::size_t>(i);
    std::string line = fmt::format("  {:<8} {:>12}", grey.fit.names[place], number_text(grey.fit.theta[i], 6));
    if (grey.model.parameters[place].fixed) return line + "  (fixed)\n";
    if (grey.fit.at_bound[place]) return line + "  (at its bound)\n";
    if (!std::isfinite(grey.fit.std[i])) return line + "  (not told by the record)\n";
    return line + fmt::format("  +- {:<10} 95 %: {} to {}\n", number_text(grey.fit.std[i], 3),
                              number_text(grey.intervals(i, 0), 5), number_text(grey.intervals(i, 1), 5));
}

std::string initial_lines(const GreyFit& grey) {
    std::string text;
    for (Index k = 0; k < grey.initial_states.cols(); ++k)
        for (Index i = 0; i < grey.initial_states.rows(); ++i) {
            if (grey.initial_std(i, k) == 0) continue;
            text += fmt::format("  {:<8} {:>12}  +- {}{}\n", grey.model.state_names[static_cast<std::size_t>(i)],
                                number_text(grey.initial_states(i, k), 6), number_text(grey.initial_std(i, k), 3),
                                grey.initial_states.cols() > 1 ? fmt::format("  (experiment {})", k + 1) : "");
        }
    return text.empty() ? text : "Initial state:\n" + text;
}

}  // namespace

std::size_t Boxed<GreyEstimate>::outside_bytes(const GreyEstimate& estimate) {
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

std::string grey_presentation(const GreyFit& grey) {
    std::string text =
        fmt::format("grey-box model with the states {}\nParameters:\n", fmt::join(grey.model.state_names, ", "));
    for (Index i = 0; i < grey.fit.theta.size(); ++i) text += parameter_line(grey, i);
    text += initial_lines(grey) + "Estimated by greyest, fit to the estimation data ";
    for (Index i = 0; i < grey.fit.fit_percent.size(); ++i)
        text += (i > 0 ? " % and " : "") + number_text(grey.fit.fit_percent[i], 4);
    text += " % (simulation), noise variance ";
    for (Index i = 0; i < grey.fit.noise_variance.size(); ++i)
        text += (i > 0 ? " and " : "") + number_text(grey.fit.noise_variance[i], 4);
    return text + ".\n" + in_lua_words(grey.fit.full_message()) + "\n";
}

}  // namespace dynlab::inline scripting
