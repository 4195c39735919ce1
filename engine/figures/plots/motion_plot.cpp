#include "figures/plots/motion_plot.h"

#include <algorithm>
#include <limits>

#include "figures/figure_layout.h"
#include "figures/style.h"
#include "numerics/error.h"

namespace dynlab::inline figures {
namespace {

constexpr double kRim = 0.3;  // around a drawing, in the drawing's cm: moved parts may leave its frame
constexpr Index kInstants = 4;
constexpr int kInstantDigits = 15;                      // of messages: instants may differ late
constexpr double kFirstHeight = 0.5, kNoNumbers = 1e3;  // of the axis of y of pictures, which has no numbers to show
constexpr double kMeasuredLine = 1.6, kSimulatedLine = 0.8, kFixedLine = 0.4;  // points
constexpr int kSimulatedColor = 0, kFixedColor = 2;

void check_motion_data(const PlantDrawing& plant, const MotionData& motion_data) {
    const Index parts = static_cast<Index>(plant.parts.size()), count = motion_data.t.size();
    if (count < 2) throw InvalidArgument("an animation needs at least two instants, not {}", count);
    for (Index i = 1; i < count; ++i)
        if (!(motion_data.t[i] > motion_data.t[i - 1]))
            throw InvalidArgument("the instants must increase, but instant {} is {} s and instant {} is {} s", i,
                                  significant(motion_data.t[i - 1], kInstantDigits), i + 1,
                                  significant(motion_data.t[i], kInstantDigits));
    if (motion_data.measured.size() == 0 && motion_data.simulated.size() == 0)
        throw InvalidArgument("an animation needs measured or simulated signals");
    for (const Matrix* signals : {&motion_data.measured, &motion_data.simulated})
        if (signals->size() > 0 && (signals->rows() != count || signals->cols() != parts))
            throw InvalidArgument("the signals of an animation must be {} x {}, but they are {} x {}", count, parts,
                                  signals->rows(), signals->cols());
}

Vector spread_instants(const Vector& t) {
    const double from = t[0], length = t[t.size() - 1] - from;
    return Vector::NullaryExpr(kInstants, [&](Index k) {
        return from + length * (static_cast<double>(k) + 0.5) / static_cast<double>(kInstants);
    });
}

/// The signals at an instant of the data, by linear interpolation.
Vector signals_at(const Vector& t, const Matrix& signals, double instant) {
    const Index after = std::clamp<Index>(std::upper_bound(t.begin(), t.end(), instant) - t.begin(), 1, t.size() - 1);
    const double part = (instant - t[after - 1]) / (t[after] - t[after - 1]);
    return (1 - part) * signals.row(after - 1) + part * signals.row(after);
}

/// Lines that are drawn in one stroke of the pen each.
class Strokes {
  public:
    void add(const std::vector<double>& x, const std::vector<double>& y) {
        for (std::size_t i = 0; i < x.size(); ++i) x_.push_back(x[i]), y_.push_back(y[i]);
        x_.push_back(x.empty() ? 0 : x.back()), y_.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    bool empty() const { return x_.empty(); }
    Curve curve(int color, double width) const {
        Curve curve;
        curve.x = Eigen::Map<const Vector>(x_.data(), static_cast<Index>(x_.size()));
        curve.y = Eigen::Map<const Vector>(y_.data(), static_cast<Index>(y_.size()));
        curve.color = color, curve.dash = 0, curve.line_width = width;
        return curve;
    }

  private:
    std::vector<double> x_, y_;
};

/// The place of a drawing on the panel of pictures: centered at `center` on the time axis, above `base`.
struct PicturePlace {
    double seconds_per_cm, cm_per_cm, width, center, base;

    void add(const PlantShape& piece, Strokes& strokes) const {
        PlantShape scaled = piece;
        for (double& x : scaled.x) x = center + (x - 0.5 * width) * cm_per_cm * seconds_per_cm;
        for (double& y : scaled.y) y = base + (y + kRim) * cm_per_cm;
        strokes.add(scaled.x, scaled.y);
    }
};

Panel signal_panel(const PlantPart& part, const MotionData& motion_data, Index column) {
    Panel panel;
    panel.y_label = axis_label(Message::verbatim(part.signal), part.unit);
    const auto add = [&](const Matrix& signals, const Message& label, int color, double width) {
        if (signals.size() == 0) return;
        Curve curve;
        curve.x = motion_data.t, curve.y = signals.col(column);
        curve.label = column == 0 ? label : Message();
        curve.color = color, curve.dash = 0, curve.line_width = width;
        panel.curves.push_back(std::move(curve));
    };
    add(motion_data.measured, Message("measured"), style::kGrayColor, kMeasuredLine);
    add(motion_data.simulated, Message("simulated"), kSimulatedColor, kSimulatedLine);
    return panel;
}

/// The panel of pictures, whose frame is `width` x `height` cm; its axis of y counts these cm.
void draw_pictures(Panel& panel, const PlantDrawing& plant, const MotionData& motion_data, const Vector& instants,
                   double width, double height) {
    const double seconds = motion_data.t[motion_data.t.size() - 1] - motion_data.t[0];
    double available_width = width;  // between neighbors
    for (Index k = 1; k < instants.size(); ++k)
        available_width = std::min(available_width, (instants[k] - instants[k - 1]) / seconds * width);
    const double scale = std::min(0.97 * available_width / plant.width, height / (plant.height + 2 * kRim));
    const double base = kFirstHeight + 0.5 * (height - scale * (plant.height + 2 * kRim));
    Strokes fixed, measured, simulated;
    for (const double instant : instants) {
        const PicturePlace place{seconds / width, scale, plant.width, instant, base};
        for (const PlantShape& piece : plant.pieces) {
            if (piece.filled) continue;
            if (!piece.moves()) {
                place.add(piece, fixed);
                continue;
            }
            for (const auto& [signals, strokes] :
                 {std::pair{&motion_data.measured, &measured}, std::pair{&motion_data.simulated, &simulated}})
                if (signals->size() > 0)
                    place.add(plant.placed(piece, signals_at(motion_data.t, *signals, instant)), *strokes);
        }
    }
    if (!fixed.empty()) panel.curves.push_back(fixed.curve(kFixedColor, kFixedLine));
    if (!measured.empty()) panel.curves.push_back(measured.curve(style::kGrayColor, kMeasuredLine));
    if (!simulated.empty()) panel.curves.push_back(simulated.curve(kSimulatedColor, kSimulatedLine));
    panel.y_range = {kFirstHeight, kFirstHeight + height};
}

MotionData thinned_motion(const MotionData& motion_data) {
    std::vector<Index> kept;
    for (Index i = 0; i < motion_data.t.size(); ++i)
        if (kept.empty() || i + 1 == motion_data.t.size() ||
            motion_data.t[i] - motion_data.t[kept.back()] >= (1 - 1e-6) / kMaxPictures)
            kept.push_back(i);
    MotionData result;
    result.t = motion_data.t(kept);
    if (motion_data.measured.size() > 0) result.measured = motion_data.measured(kept, Eigen::all);
    if (motion_data.simulated.size() > 0) result.simulated = motion_data.simulated(kept, Eigen::all);
    return result;
}

}  // namespace

Figure motion_plot(const PlantDrawing& plant, const MotionData& whole, const MotionAppearance& look) {
    plant.validate();
    check_motion_data(plant, whole);
    const MotionData motion_data = thinned_motion(whole);
    Vector instants = look.instants.size() > 0 ? look.instants : spread_instants(motion_data.t);
    std::sort(instants.begin(), instants.end());
    const double first = motion_data.t[0], last = motion_data.t[motion_data.t.size() - 1];
    for (const double instant : instants)
        if (!(instant >= first && instant <= last))
            throw InvalidArgument("the instant {} s is outside the data, which range from {} s to {} s",
                                  significant(instant, kInstantDigits), significant(first, kInstantDigits),
                                  significant(last, kInstantDigits));
    if (const auto twice = std::adjacent_find(instants.begin(), instants.end()); twice != instants.end())
        throw InvalidArgument("the instant {} s occurs twice in the list", significant(*twice, kInstantDigits));
    Figure figure;
    figure.title = look.title, figure.width_cm = look.width_cm, figure.height_cm = look.height_cm;
    figure.rows = static_cast<int>(plant.parts.size()) + 1;
    Panel pictures;
    pictures.x_range = {first, last};
    pictures.y_range = {kFirstHeight, kFirstHeight + 1};
    pictures.y_tick_step = kNoNumbers;
    figure.panels.push_back(pictures);
    for (std::size_t k = 0; k < plant.parts.size(); ++k) {
        Panel& panel = figure.panels.emplace_back(signal_panel(plant.parts[k], motion_data, static_cast<Index>(k)));
        panel.x_range = {first, last};
        for (const double instant : instants) panel.references.push_back({false, instant, {}, 2});
    }
    figure.panels.back().x_label = axis_label(Message("time"), "s");
    const Rectangle frame = lay_out(figure).panels.front().box;
    draw_pictures(figure.panels.front(), plant, motion_data, instants, frame.width(), frame.height());
    figure.motion = Motion{plant, 0, motion_data.measured.size() > 0, motion_data.simulated.size() > 0};
    return figure;
}

}  // namespace dynlab::inline figures
