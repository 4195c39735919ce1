#include "figures/step_plot.h"

#include "figures/time_response_panel.h"

namespace dynlab {

Figure step_plot(const std::vector<NamedModel>& models, const Vector& t) {
    return time_response_figure(models, t, CurveStyle::kStairs, step_response);
}

}  // namespace dynlab
