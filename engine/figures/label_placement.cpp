#include "figures/label_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/reader.h"
#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

constexpr double kCell = 0.04;        // cm
constexpr double kHalfHeight = 0.17;  // of a line of text
constexpr double kMarkerRadius = 0.08;
constexpr double kNameGap = 0.1;        // between a curve and its name
constexpr double kClearlyNearer = 0.3;  // cm by which other curves must be further away than the named one

/// Which parts of a frame are taken, on a fine grid.
class Occupancy {
  public:
    Occupancy(double width, double height)
        : columns_(std::max(1, static_cast<int>(width / kCell))),
          rows_(std::max(1, static_cast<int>(height / kCell))),
          weight_(static_cast<std::size_t>(columns_ * rows_), 0) {}

    void add_box(const Rectangle& box, int weight) {
        const auto [left, right] = cells(box.left, box.right, columns_);
        const auto [bottom, top] = cells(box.bottom, box.top, rows_);
        for (int row = bottom; row <= top; ++row)
            for (int column = left; column <= right; ++column) weight_[cell_index(column, row)] += weight;
    }
    void add_segment(PagePoint a, PagePoint b, int weight) {
        if (!clip(a, b)) return;
        const int steps = std::max(1, static_cast<int>(std::hypot(b.x - a.x, b.y - a.y) / kCell));
        for (int k = 0; k <= steps; ++k) {
            const double along = static_cast<double>(k) / steps;
            const int column = static_cast<int>((a.x + along * (b.x - a.x)) / kCell);
            const int row = static_cast<int>((a.y + along * (b.y - a.y)) / kCell);
            weight_[cell_index(std::clamp(column, 0, columns_ - 1), std::clamp(row, 0, rows_ - 1))] += weight;
        }
    }
    double covered(const Rectangle& box) const {
        const auto [left, right] = cells(box.left, box.right, columns_);
        const auto [bottom, top] = cells(box.bottom, box.top, rows_);
        double sum = 0;
        for (int row = bottom; row <= top; ++row)
            for (int column = left; column <= right; ++column) sum += weight_[cell_index(column, row)];
        return sum;
    }

  private:
    std::size_t cell_index(int column, int row) const { return static_cast<std::size_t>(row * columns_ + column); }
    static std::pair<int, int> cells(double low, double high, int count) {
        const auto cell = [count](double value) {
            const double place = std::floor(value / kCell);
            return place > -1 ? static_cast<int>(std::min<double>(place, count)) : -1;  // also where it is no number
        };
        return {std::max(cell(low), 0), std::min(cell(high), count - 1)};
    }
    /// Shortens a segment to the frame (Liang and Barsky 1984); false when it lies outside, and where its ends are so
    /// far apart that their difference is no number.
    bool clip(PagePoint& a, PagePoint& b) const {
        const double dx = b.x - a.x, dy = b.y - a.y;
        double from = 0, to = 1;
        const auto cut = [&](double direction, double distance) {
            if (direction == 0) return distance >= 0;
            const double at = distance / direction;
            (direction < 0 ? from : to) = direction < 0 ? std::max(from, at) : std::min(to, at);
            return from <= to;
        };
        if (!cut(-dx, a.x) || !cut(dx, columns_ * kCell - a.x) || !cut(-dy, a.y) || !cut(dy, rows_ * kCell - a.y))
            return false;
        const PagePoint start = a;
        a = {start.x + from * dx, start.y + from * dy};
        b = {start.x + to * dx, start.y + to * dy};
        return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y);
    }

    int columns_, rows_;
    std::vector<int> weight_;
};

/// What is drawn of a curve within its frame, as points at most 0.1 cm apart.
std::vector<PagePoint> visible_points(const CurveTraces& curve, double width, double height) {
    std::vector<PagePoint> points;
    const auto add = [&](PagePoint p) {
        if (p.x < 0 || p.x > width || p.y < 0 || p.y > height) return;
        if (points.empty() || std::hypot(p.x - points.back().x, p.y - points.back().y) > kCell) points.push_back(p);
    };
    for (const PagePoint& p : curve.points)
        if (!p.gap()) add(p);
    for (std::size_t i = 1; i < curve.line.size(); ++i) {
        const PagePoint &a = curve.line[i - 1], &b = curve.line[i];
        if (a.gap() || b.gap()) continue;
        const double length = std::min(std::hypot(b.x - a.x, b.y - a.y), 10 * (width + height));
        const int steps = std::max(1, static_cast<int>(std::ceil(length / 0.1)));
        for (int k = 0; k <= steps; ++k) {
            const double along = static_cast<double>(k) / steps;
            add({a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)});
        }
    }
    return points;
}

double distance(const Rectangle& box, const std::vector<PagePoint>& points) {
    double least = std::numeric_limits<double>::infinity();
    for (const PagePoint& p : points)
        least = std::min(
            least, std::hypot(p.x - std::clamp(p.x, box.left, box.right), p.y - std::clamp(p.y, box.bottom, box.top)));
    return least;
}

class Placement {
  public:
    Placement(const Panel& panel, const PanelLayout& layout, const std::vector<CurveTraces>& curves)
        : panel_(panel),
          layout_(layout),
          width_(layout.box.width()),
          height_(layout.box.height()),
          taken_(width_, height_) {
        for (const CurveTraces& curve : curves) take_curve(curve);
        for (const ReferenceLine& line : panel.references) {
            const auto [from, to] = ends_of(line);
            taken_.add_segment(from, to, 2);
        }
        for (const Arrow& arrow : panel.arrows) taken_.add_segment(at(arrow.x0, arrow.y0), at(arrow.x1, arrow.y1), 3);
        for (const Annotation& mark : panel.annotations)
            if (mark.marker) take_marker(at(mark.x, mark.y), 4);
        if (panel.legend != LegendPlace::kDirect || !layout.legend.empty()) return;
        for (const CurveTraces& curve : curves) visible_.push_back(visible_points(curve, width_, height_));
    }

    std::vector<PlacedLabel> run() {
        // Those with the fewest possible places go first.
        for (const Arrow& arrow : panel_.arrows)
            if (!arrow.text.empty()) place_arrow_text(arrow);
        for (const Annotation& mark : panel_.annotations)
            if (!mark.text.empty()) place_mark_text(mark);
        for (std::size_t i = 0; i < visible_.size(); ++i)
            if (!panel_.curves[i].label.empty() && !place_name(i)) all_named_ = false;
        for (const ReferenceLine& line : panel_.references)
            if (!line.label.empty()) place_reference_label(line);
        return labels_;
    }
    bool all_named() const { return all_named_; }

  private:
    struct Candidate {
        double x, y, penalty;
    };

    static double on_page(const Axis& axis, double value, double length) {
        constexpr double kBeyondFrame = 1000;  // cm
        return std::clamp(axis.position(value) * length, -kBeyondFrame, kBeyondFrame);
    }
    PagePoint at(double x, double y) const { return {on_page(layout_.x, x, width_), on_page(layout_.y, y, height_)}; }
    std::pair<PagePoint, PagePoint> ends_of(const ReferenceLine& line) const {
        if (line.horizontal) {
            const double y = on_page(layout_.y, line.at, height_);
            return {{0, y}, {width_, y}};
        }
        const double x = on_page(layout_.x, line.at, width_);
        return {{x, 0}, {x, height_}};
    }
    void take_marker(PagePoint p, int weight) {
        taken_.add_box({p.x - kMarkerRadius, p.y - kMarkerRadius, p.x + kMarkerRadius, p.y + kMarkerRadius}, weight);
    }
    void take_curve(const CurveTraces& curve) {
        for (const Trace* trace : {&curve.line, &curve.lower, &curve.upper})
            for (std::size_t i = 1; i < trace->size(); ++i)
                if (!(*trace)[i - 1].gap() && !(*trace)[i].gap()) taken_.add_segment((*trace)[i - 1], (*trace)[i], 3);
        for (const PagePoint& point : curve.points) take_marker(point, 1);
        for (const Rectangle& bar : curve.bars) taken_.add_box(bar, 1);
    }

    /// Takes the candidate that covers least, moved into the frame where it sticks out.
    PagePoint choose(const std::string& text, const std::vector<Candidate>& candidates) {
        const double half_width = 0.5 * text_width(text, style::kTextSize) + 0.05;
        Rectangle best{};
        double least = -1;
        for (const Candidate& candidate : candidates) {
            const double x =
                half_width < 0.5 * width_ ? std::clamp(candidate.x, half_width, width_ - half_width) : 0.5 * width_;
            const double y = std::clamp(candidate.y, std::min(kHalfHeight, 0.5 * height_),
                                        std::max(height_ - kHalfHeight, 0.5 * height_));
            const Rectangle box{x - half_width, y - kHalfHeight, x + half_width, y + kHalfHeight};
            const double moved = std::abs(x - candidate.x) + std::abs(y - candidate.y);
            const double cost = taken_.covered(box) + candidate.penalty + 8 * moved;
            if (least >= 0 && cost >= least) continue;
            least = cost;
            best = box;
        }
        taken_.add_box(best, 6);
        return {0.5 * (best.left + best.right), 0.5 * (best.bottom + best.top)};
    }

    void place_mark_text(const Annotation& mark) {
        const PagePoint p = at(mark.x, mark.y);
        const std::string text = message_text(mark.text);
        const double half_width = 0.5 * text_width(text, style::kTextSize);
        std::vector<Candidate> candidates;
        for (const double distance : {0.12, 0.3, 0.6, 1.0, 1.5})
            for (const int dx : {1, -1, 0})
                for (const int dy : {1, -1, 0}) {
                    if (dx == 0 && dy == 0) continue;
                    const double slant = dx != 0 && dy != 0 ? 0.7 : 1.0;
                    candidates.push_back({p.x + dx * (half_width + slant * distance),
                                          p.y + dy * (kHalfHeight + slant * distance), 6 * (distance - 0.12)});
                }
        const PagePoint middle = choose(text, candidates);
        PlacedLabel label{text, middle.x, middle.y, {}, {}};
        const PagePoint nearest{std::clamp(p.x, middle.x - half_width, middle.x + half_width),
                                std::clamp(p.y, middle.y - kHalfHeight, middle.y + kHalfHeight)};
        if (std::hypot(nearest.x - p.x, nearest.y - p.y) > 0.4) {
            label.leader_from = nearest, label.leader_to = p;
            taken_.add_segment(nearest, p, 2);
        }
        labels_.push_back(label);
    }

    void place_arrow_text(const Arrow& arrow) {
        const std::string text = message_text(arrow.text);
        const PagePoint a = at(arrow.x0, arrow.y0), b = at(arrow.x1, arrow.y1);
        const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-6);
        const double nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;
        const double half_width = 0.5 * text_width(text, style::kTextSize) + 0.06;
        const double away = std::abs(nx) * half_width + std::abs(ny) * (kHalfHeight + 0.03);
        std::vector<Candidate> candidates;
        for (const double along : {0.5, 0.4, 0.6, 0.25, 0.75, 0.1, 0.9})
            for (const double extra : {0.02, 0.15})
                for (const int side : {1, -1})
                    candidates.push_back({a.x + along * (b.x - a.x) + side * nx * (away + extra),
                                          a.y + along * (b.y - a.y) + side * ny * (away + extra),
                                          5 * std::abs(along - 0.5) + 10 * extra});
        for (const int end : {0, 1}) {  // short arrows: beyond an end
            const PagePoint& tip = end == 0 ? a : b;
            const double sign = end == 0 ? -1 : 1,
                         reach = std::abs(ny) * half_width + std::abs(nx) * kHalfHeight + 0.08;
            candidates.push_back({tip.x + sign * ny * reach, tip.y - sign * nx * reach, 6});
        }
        const PagePoint middle = choose(text, candidates);
        labels_.push_back({text, middle.x, middle.y, {}, {}});
    }

    void place_reference_label(const ReferenceLine& line) {
        const auto [from, to] = ends_of(line);
        const std::string text = message_text(line.label);
        const double half_width = 0.5 * text_width(text, style::kTextSize) + 0.06;
        std::vector<Candidate> candidates;
        for (int k = 0; k <= 8; ++k) {  // from the far end of the line to its beginning
            const double along = 1 - k / 8.0, penalty = std::min(k, 8 - k) + 0.1 * k;
            for (const int side : {1, -1})
                for (const double gap : {0.03, 0.14}) {  // the wider one clears a noisy curve along the line
                    const double cost = penalty + (side < 0) + 10 * (gap - 0.03);
                    if (line.horizontal)
                        candidates.push_back({half_width + along * (width_ - 2 * half_width),
                                              from.y + side * (kHalfHeight + gap), cost});
                    else
                        candidates.push_back(
                            {from.x + side * (half_width + gap), kHalfHeight + along * (to.y - 2 * kHalfHeight), cost});
                }
        }
        const PagePoint middle = choose(text, candidates);
        labels_.push_back({text, middle.x, middle.y, {}, {}});
    }

    /// The name of a curve at one of its points, rather near its end; false where there is no room.
    bool place_name(std::size_t curve) {
        const std::vector<PagePoint>& line = visible_[curve];
        const std::string name = message_text(panel_.curves[curve].label);
        const double half_width = 0.5 * text_width(name, style::kTextSize);
        Rectangle best{};
        double least = -1;
        for (std::size_t k = 0; k < line.size(); k += std::max<std::size_t>(1, line.size() / 60))
            for (const int dx : {0, 1, -1})
                for (const int dy : {1, -1, 0}) {
                    const double x = line[k].x + dx * (half_width + kNameGap);
                    const double y = line[k].y + dy * (kHalfHeight + kNameGap);
                    const Rectangle box{x - half_width, y - kHalfHeight, x + half_width, y + kHalfHeight};
                    const double cost = 0.1 * (width_ - x) + 0.2 * std::abs(dx) + 0.1 * (dy == 0);
                    if ((least >= 0 && cost >= least) || !is_clear(box, curve)) continue;
                    least = cost;
                    best = box;
                }
        if (least < 0) return false;
        taken_.add_box(best, 6);
        labels_.push_back({name, 0.5 * (best.left + best.right), 0.5 * (best.bottom + best.top), {}, {}});
        return true;
    }

    bool is_clear(const Rectangle& box, std::size_t curve) const {
        const double rim = 0.05;
        if (box.left < rim || box.right > width_ - rim || box.bottom < rim || box.top > height_ - rim) return false;
        if (taken_.covered(box) > 0) return false;
        const double own = distance(box, visible_[curve]);
        for (std::size_t i = 0; i < visible_.size(); ++i)
            if (i != curve && distance(box, visible_[i]) < own + kClearlyNearer) return false;
        return true;
    }

    const Panel& panel_;
    const PanelLayout& layout_;
    double width_, height_;
    Occupancy taken_;
    std::vector<std::vector<PagePoint>> visible_;  ///< of each curve, if names are next to the curves
    bool all_named_ = true;
    std::vector<PlacedLabel> labels_;
};

}  // namespace

std::vector<PlacedLabel> place_labels(const Panel& panel, const PanelLayout& layout,
                                      const std::vector<CurveTraces>& curves) {
    return Placement(panel, layout, curves).run();
}

bool names_find_places(const Panel& panel, const PanelLayout& layout) {
    std::vector<CurveTraces> curves;
    for (const Curve& curve : panel.curves) curves.push_back(traces_of(curve, layout));
    Placement placement(panel, layout, curves);
    placement.run();
    return placement.all_named();
}

}  // namespace dynlab::inline figures
