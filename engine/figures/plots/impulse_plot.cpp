#include "figures/plots/impulse_plot.h"

#include "figures/plots/time_response_panel.h"

namespace dynlab::inline figures {

Figure impulse_plot(const std::vector<NamedModel>& models, const Vector& t) {
    return time_response_figure(models, t, CurveStyle::kStems, impulse_response);
}

}  // namespace dynlab::inline figures
