#include "scripting/objects/figure_object.h"

namespace dynlab::inline scripting {

std::size_t Userdata<FigurePointer>::outside_bytes(const FigurePointer& figure) {
    std::size_t bytes = sizeof(ScriptFigure);
    for (const Panel& panel : figure->figure.panels)
        for (const Curve& curve : panel.curves)
            bytes += sizeof(Curve) +
                     sizeof(double) * static_cast<std::size_t>(curve.x.size() + curve.y.size() + curve.y_upper.size());
    return bytes;
}

int give_figure(const Call& call, Figure figure) {
    figure.validate();
    auto pointer = std::make_shared<ScriptFigure>(ScriptFigure{std::move(figure), false, {}});
    push_object(call.state(), pointer);
    call.context().recorder.add_figure(pointer);
    return 1;
}

ScriptFigure& used_figure(const Call& call, int index, ArgumentName what) {
    ScriptFigure& figure = *object_argument<FigurePointer>(call, index, what);
    figure.used = true;
    return figure;
}

}  // namespace dynlab::inline scripting
