#include "figures/step_construction.h"

#include <fmt/format.h>

#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

Curve line_of(const Vector& x, const Vector& y, const Message& label, int color, int dash, double width) {
    Curve curve;
    curve.x = x;
    curve.y = y;
    curve.label = label;
    curve.color = color;
    curve.dash = dash;
    curve.line_width = width;
    return curve;
}

class Construction {
  public:
    explicit Construction(const StepConstruction& input) : input_(input), change_(input.final - input.initial) {}

    Figure draw() {
        panel_.x_label = input_.x_label;
        panel_.y_label = input_.y_label;
        const bool smooth = input_.smoothed.size() > 0;
        panel_.curves.push_back(
            line_of(input_.t, input_.y, Message("measured"), smooth ? style::kGrayColor : 0, 0, smooth ? 0.6 : 0.9));
        if (smooth) panel_.curves.push_back(line_of(input_.t, input_.smoothed, Message("smoothed"), 0, 0, 1.1));
        panel_.references = {{true, input_.final, Message("final value"), 1},
                             {true, input_.initial, Message("initial value"), 1}};
        const double first = input_.t[0], last = input_.t[input_.t.size() - 1], aside = last - 0.15 * (last - first);
        panel_.arrows.push_back({aside, input_.initial, aside, input_.final, Message::verbatim("K Δu"), true});
        int part = 0;
        for (const StepConstruction::Reading& reading : input_.readings) {
            if (reading.name == "settling")
                add_settling(reading);
            else if (reading.name == "overshoot")
                add_overshoot(reading);
            else
                add_part(reading, ++part);
        }
        return Figure(std::move(panel_));
    }

  private:
    double level(double part) const { return input_.initial + part * change_; }

    void dotted(double x0, double y0, double x1, double y1) {
        panel_.curves.push_back(line_of(Vector{{x0, x1}}, Vector{{y0, y1}}, {}, style::kGrayColor, 2, 0.8));
    }
    void duration(double end, double height, const std::string& symbol) {
        panel_.arrows.push_back({input_.step_time, height, end, height,
                                 Message("{} = {} s", symbol, significant(end - input_.step_time, 3)), true});
    }

    void add_settling(const StepConstruction::Reading& reading) {
        Curve band = line_of(Vector{{input_.step_time, input_.t[input_.t.size() - 1]}},
                             Vector::Constant(2, level(0.95)), Message("±5 % band"), 1, 0, 0.9);
        band.style = CurveStyle::kBand;
        band.y_upper = Vector::Constant(2, level(1.05));
        panel_.curves.push_back(std::move(band));
        dotted(reading.time, level(0.15), reading.time, reading.value);
        panel_.annotations.push_back({reading.time, reading.value, {}, true});
        duration(reading.time, level(0.15), "T_{r}");
    }

    void add_overshoot(const StepConstruction::Reading& reading) {
        const double overshoot = 100 * (reading.value - input_.final) / change_;
        panel_.arrows.push_back({reading.time, input_.final, reading.time, reading.value,
                                 Message("{} = {} %", "D_{1}", significant(overshoot, 3)), true});
        dotted(reading.time, level(0.15), reading.time, input_.final);
        duration(reading.time, level(0.15), "T_{1}");
    }

    void add_part(const StepConstruction::Reading& reading, int number) {
        dotted(reading.time, input_.initial, reading.time, reading.value);
        dotted(input_.t[0], reading.value, reading.time, reading.value);
        panel_.annotations.push_back(
            {reading.time, reading.value,
             Message("{} at {} = {} s", Message::verbatim(reading.name), fmt::format("t_{{{}}}", number),
                     significant(reading.time - input_.step_time, 3)),
             true});
    }

    const StepConstruction& input_;
    double change_;
    Panel panel_;
};

}  // namespace

Figure step_construction(const StepConstruction& construction) {
    return Construction(construction).draw();
}

}  // namespace dynlab::inline figures
