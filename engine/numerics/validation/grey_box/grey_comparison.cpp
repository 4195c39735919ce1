#include "numerics/validation/grey_box/grey_comparison.h"

#include "numerics/validation/fit_measures.h"

namespace dynlab::inline numerics {

GreyStart usual_start(const GreyFit& grey) {
    return grey.start;
}

Comparison compare_grey(const IdData& data, const GreyFit& grey, GreyStart initial_state) {
    GreyModel model = grey.model;
    for (GreyParameter& parameter : model.parameters) parameter.fixed = true;
    if (initial_state == GreyStart::kModel && grey.start == GreyStart::kEstimate)
        model.estimated_initial.assign(model.state_names.size(), false);
    GreyOptions options;
    options.initial_state = initial_state;
    options.relative_tolerance = grey.relative_tolerance;
    const GreyFit simulated = greyest(data, model, options);
    Comparison all;
    all.fit_percent = simulated.fit.fit_percent;
    for (std::size_t k = 0; k < data.experiments.size(); ++k) {
        auto& row = all.results.emplace_back();
        const Matrix& y = data.experiments[k].y;
        for (Index i = 0; i < y.cols(); ++i) {
            CompareResult result;
            result.output = simulated.outputs[k].col(i);
            result.fit_percent =
                fit_percent_of_sums((y.col(i) - result.output).squaredNorm(), variation_about_mean(y.col(i)));
            result.start = {initial_state == GreyStart::kZero ? InitialState::kZero : InitialState::kEstimate, false};
            result.message =
                Message("Simulated with the equations of the model: fit {} %.", significant(result.fit_percent, 4));
            row.push_back(std::move(result));
        }
    }
    return all;
}

}  // namespace dynlab::inline numerics
