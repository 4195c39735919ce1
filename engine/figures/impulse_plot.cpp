#include "figures/impulse_plot.h"

#include "figures/time_response_panel.h"

namespace dynlab {

Figure impulse_plot(const std::vector<NamedModel>& models, const Vector& t) {
    return time_response_figure(models, t, CurveStyle::kStems, impulse_response);
}

}  // namespace dynlab
