#pragma once
#include <optional>

#include "figures/figure.h"

namespace dynlab::inline figures {

/// A forecast with its interval.
struct ForecastPoint {
    double x, y, lower, upper;
    Message text;  ///< written beside it
};

/// What a regression plot shows; empty vectors leave a part out.
struct RegressionPicture {
    Vector x, y;                                ///< the data
    Vector line_x, line_y;                      ///< the fitted line
    Vector confidence_lower, confidence_upper;  ///< over line_x, of the line
    Vector prediction_lower, prediction_upper;  ///< over line_x, of a new observation
    std::optional<ForecastPoint> forecast;
    Message x_label, y_label;
    Message data_label = Message("data"), line_label = Message("fitted line");
    double level = 0.95;  ///< of both bands
};

/// Throws InvalidArgument for a band whose length differs from the line's.
Figure regression_plot(const RegressionPicture& picture);

}  // namespace dynlab::inline figures
