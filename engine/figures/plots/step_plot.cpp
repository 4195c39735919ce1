#include "figures/plots/step_plot.h"

#include "figures/confidence_band.h"
#include "figures/plots/time_response_panel.h"
#include "numerics/statistics/distributions.h"

namespace dynlab::inline figures {

Figure step_plot(const std::vector<NamedModel>& models, const Vector& t) {
    Figure figure = time_response_figure(models, t, CurveStyle::kStairs, step_response);
    Panel& panel = figure.panels.front();
    fix_colours(panel);
    for (std::size_t i = 0; i < models.size(); ++i) {
        if (!models[i].confidence) continue;
        const auto& [model, level] = *models[i].confidence;
        const Vector width = normal_half_width(level) * step_response_std(model, panel.curves[i].x);
        add_confidence_band(panel, i, width, level);
    }
    return figure;
}

}  // namespace dynlab::inline figures
