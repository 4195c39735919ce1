#include "figures/label_placement.h"

#include <algorithm>
#include <cmath>

#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

constexpr double kCell = 0.04;        // cm
constexpr double kHalfHeight = 0.17;  // of a line of text
constexpr double kMarkerRadius = 0.08;

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
            return static_cast<int>(std::clamp(std::floor(value / kCell), -1.0, static_cast<double>(count)));
        };
        return {std::max(cell(low), 0), std::min(cell(high), count - 1)};
    }
    /// Shortens a segment to the frame (Liang and Barsky 1984); false when it lies outside.
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
        return true;
    }

    int columns_, rows_;
    std::vector<int> weight_;
};

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
    }

    std::vector<PlacedLabel> run() {
        // Those with the fewest possible places go first.
        for (const Arrow& arrow : panel_.arrows)
            if (!arrow.text.empty()) place_arrow_text(arrow);
        for (const Annotation& mark : panel_.annotations)
            if (!mark.text.empty()) place_mark_text(mark);
        for (const ReferenceLine& line : panel_.references)
            if (!line.label.empty()) place_reference_label(line);
        return labels_;
    }

  private:
    struct Candidate {
        double x, y, penalty;
    };

    PagePoint at(double x, double y) const { return {layout_.x.position(x) * width_, layout_.y.position(y) * height_}; }
    std::pair<PagePoint, PagePoint> ends_of(const ReferenceLine& line) const {
        if (line.horizontal) {
            const double y = layout_.y.position(line.at) * height_;
            return {{0, y}, {width_, y}};
        }
        const double x = layout_.x.position(line.at) * width_;
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
        const double half_width = 0.5 * text_width(mark.text, style::kTextSize);
        std::vector<Candidate> candidates;
        for (const double distance : {0.12, 0.3, 0.6, 1.0, 1.5})
            for (const int dx : {1, -1, 0})
                for (const int dy : {1, -1, 0}) {
                    if (dx == 0 && dy == 0) continue;
                    const double slant = dx != 0 && dy != 0 ? 0.7 : 1.0;
                    candidates.push_back({p.x + dx * (half_width + slant * distance),
                                          p.y + dy * (kHalfHeight + slant * distance), 6 * (distance - 0.12)});
                }
        const PagePoint middle = choose(mark.text, candidates);
        PlacedLabel label{mark.text, middle.x, middle.y, {}, {}};
        const PagePoint nearest{std::clamp(p.x, middle.x - half_width, middle.x + half_width),
                                std::clamp(p.y, middle.y - kHalfHeight, middle.y + kHalfHeight)};
        if (std::hypot(nearest.x - p.x, nearest.y - p.y) > 0.4) {
            label.leader_from = nearest, label.leader_to = p;
            taken_.add_segment(nearest, p, 2);
        }
        labels_.push_back(label);
    }

    void place_arrow_text(const Arrow& arrow) {
        const PagePoint a = at(arrow.x0, arrow.y0), b = at(arrow.x1, arrow.y1);
        const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-6);
        const double nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;
        const double half_width = 0.5 * text_width(arrow.text, style::kTextSize) + 0.06;
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
        const PagePoint middle = choose(arrow.text, candidates);
        labels_.push_back({arrow.text, middle.x, middle.y, {}, {}});
    }

    void place_reference_label(const ReferenceLine& line) {
        const auto [from, to] = ends_of(line);
        const double half_width = 0.5 * text_width(line.label, style::kTextSize) + 0.06;
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
        const PagePoint middle = choose(line.label, candidates);
        labels_.push_back({line.label, middle.x, middle.y, {}, {}});
    }

    const Panel& panel_;
    const PanelLayout& layout_;
    double width_, height_;
    Occupancy taken_;
    std::vector<PlacedLabel> labels_;
};

}  // namespace

std::vector<PlacedLabel> place_labels(const Panel& panel, const PanelLayout& layout,
                                      const std::vector<CurveTraces>& curves) {
    return Placement(panel, layout, curves).run();
}

}  // namespace dynlab::inline figures
