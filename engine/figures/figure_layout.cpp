#include "figures/figure_layout.h"

#include <algorithm>

#include "base/reader.h"
#include "figures/label_placement.h"
#include "figures/panel_axes.h"
#include "figures/style.h"

namespace dynlab::inline figures {
namespace {

using namespace style;

constexpr double kEdge = 0.08;  // free rim of the page
constexpr double kBetweenColumns = 0.35;
constexpr double kBetweenEntries = 0.45;  // in a legend
constexpr double kMinFrame = 0.6;

struct Margins {
    double left = 0, bottom = 0, right = 0, top = 0;
};

double block_height(const FittedText& text) {
    return text.lines.empty() ? 0 : static_cast<double>(text.lines.size()) * kTextLine * text.size / kTextSize;
}

double entry_width(const LegendEntry& entry) {
    return kLegendSample + kGap + text_width(entry.text, entry.size);
}

double widest_entry(const std::vector<LegendEntry>& entries) {
    double widest = 0;
    for (const LegendEntry& entry : entries) widest = std::max(widest, entry_width(entry));
    return widest;
}

std::vector<LegendEntry> legend_entries(const Panel& panel, double available_width) {
    std::vector<LegendEntry> entries;
    for (std::size_t i = 0; i < panel.curves.size(); ++i)
        if (!panel.curves[i].label.empty()) {
            const FittedText text =
                fit_line(message_text(panel.curves[i].label), available_width - kLegendSample - kGap, kTextSize);
            entries.push_back({i, text.lines.front(), text.size, 0, 0});
        }
    return entries;
}

/// The work on one figure: margins depend on the numbers at the axes, these on the frames, these on the margins; the
/// third round changes nothing any more for all but extreme figures.
class LayoutWork {
  public:
    explicit LayoutWork(const Figure& figure) : figure_(figure), panels_(figure.panels.size()) {}

    FigureLayout run() {
        const double cell = figure_.width_cm / figure_.columns;
        for (PanelLayout& panel : panels_) panel.box = {0, 0, 0.8 * cell, default_frame_height(0.8 * cell)};
        for (const Panel& panel : figure_.panels) direct_.push_back(panel.legend == LegendPlace::kDirect);
        settle();
        if (needs_legends()) settle();
        for (std::size_t i = 0; i < panels_.size(); ++i) place_texts(i);
        FigureLayout layout{figure_.width_cm, height_, title_, panels_};
        layout.title.x = 0.5 * figure_.width_cm;
        layout.title.y = height_ - kEdge - 0.5 * block_height(title_.text);
        return layout;
    }

  private:
    std::size_t row_of(std::size_t i) const { return i / static_cast<std::size_t>(figure_.columns); }
    std::size_t column_of(std::size_t i) const { return i % static_cast<std::size_t>(figure_.columns); }

    void settle() {
        for (int round = 0; round < 3; ++round) {
            for (std::size_t i = 0; i < panels_.size(); ++i) fill_panel(i);
            hide_shared_numbers();
            place_frames();
        }
    }

    /// Panels whose curves cannot be named beside them get a legend after all; whether there are any.
    bool needs_legends() {
        bool any = false;
        for (std::size_t i = 0; i < panels_.size(); ++i)
            if (direct_[i] && !names_find_places(figure_.panels[i], panels_[i])) direct_[i] = false, any = true;
        return any;
    }

    double default_frame_height(double frame_width) const {
        const bool equal = std::ranges::any_of(figure_.panels, [](const Panel& panel) { return panel.equal_axes; });
        if (figure_.rows == 1) return equal ? std::min(frame_width, 7.5) : std::clamp(0.5 * frame_width, 3.2, 6.2);
        return figure_.rows == 2 ? (equal ? 5.0 : 3.4) : 2.7;
    }

    bool legend_at_right(const Panel& panel, const std::vector<LegendEntry>& entries) const {
        if (panel.legend == LegendPlace::kRight) return true;
        if (panel.legend == LegendPlace::kAbove || figure_.columns > 1 || figure_.width_cm < 10) return false;
        return entries.size() > 6 && widest_entry(entries) < 0.3 * figure_.width_cm;
    }

    void fill_panel(std::size_t i) {
        const Panel& panel = figure_.panels[i];
        PanelLayout& out = panels_[i];
        choose_axes(panel, out.box.width(), out.box.height(), out.x, out.y);
        const auto fitted = [](const Message& text, double length, double size) {
            return text.empty() ? FittedText{{}, size} : fit_text(message_text(text), length, size);
        };
        out.title.text = fitted(panel.title, out.box.width(), kTitleSize);
        out.x_label.text = fitted(panel.x_label, out.box.width(), kTextSize);
        out.y_label.text = fitted(panel.y_label, out.box.height() + 0.4, kTextSize);
        title_.text = fitted(figure_.title, figure_.width_cm - 2 * kEdge, kTitleSize);
        out.legend.clear();
        if (panel.legend == LegendPlace::kNone || direct_[i]) return;
        const double beside = column_margins_.empty() ? 0 : column_margins_[column_of(i)].left;
        out.legend = legend_entries(panel, out.box.width() + beside);
        if (legend_at_right(panel, out.legend)) {
            out.legend = legend_entries(panel, 0.4 * figure_.width_cm);
            place_legend_at_right(out);
        } else {
            place_legend_above(out);
        }
    }

    // Legend positions are relative to the frame's upper corner until place_texts() moves them. An entry wider than the
    // frame begins left of it, above the numbers of y.
    static void place_legend_above(PanelLayout& out) {
        const double left = std::min(0.0, out.box.width() - widest_entry(out.legend));
        double x = left, row = 0;
        for (LegendEntry& entry : out.legend) {
            const double width = entry_width(entry);
            if (x > left && x + width > out.box.width() + 0.01) x = left, ++row;
            entry.x = x, entry.y = row;
            x += width + kBetweenEntries;
        }
        const double base = out.y.exponent != 0 ? kTickLine + kGap : kGap;
        for (LegendEntry& entry : out.legend) entry.y = base + (row - entry.y + 0.5) * kTextLine;
    }
    static void place_legend_at_right(PanelLayout& out) {
        double y = -0.5 * kTextLine;
        for (LegendEntry& entry : out.legend) {
            entry.x = out.box.width() + 2 * kGap, entry.y = y;
            y -= kTextLine;
        }
    }

    void hide_shared_numbers() {
        for (std::size_t i = 0; i < panels_.size(); ++i) {
            const std::size_t below = i + static_cast<std::size_t>(figure_.columns);
            panels_[i].x_numbers = true;
            if (below >= panels_.size() || !figure_.panels[i].x_label.empty()) continue;
            const Axis &a = panels_[i].x, &b = panels_[below].x;
            panels_[i].x_numbers = a.low != b.low || a.high != b.high || a.log != b.log;
        }
    }

    Margins margins_of(std::size_t i) const {
        const PanelLayout& panel = panels_[i];
        Margins margins;
        margins.left = kTickLength + kGap + panel.y.widest_label(kTickSize) + kGap + block_height(panel.y_label.text);
        margins.bottom = kTickLength + (panel.x_numbers ? kTickLine : 0) +
                         std::max(block_height(panel.x_label.text), exponent_height(panel)) + kGap;
        margins.top = panel.y.exponent != 0 ? kTickLine + kGap : kGap;
        if (!panel.x.ticks.empty() && panel.x_numbers) {
            const Tick& last = panel.x.ticks.back();
            const double over = (panel.x.position(last.value) - 1) * panel.box.width();
            margins.right = std::max(0.0, over + 0.5 * text_width(last.label, kTickSize));
        }
        for (const LegendEntry& entry : panel.legend) {
            margins.top = std::max(margins.top, entry.y + 0.5 * kTextLine + 0.5 * kGap);
            margins.right = std::max(margins.right, entry.x + entry_width(entry) - panel.box.width());
        }
        margins.top += block_height(panel.title.text);
        return margins;
    }
    static double exponent_height(const PanelLayout& panel) {
        return panel.x_numbers && panel.x.exponent != 0 ? kTickLine : 0;
    }

    void place_frames() {
        const auto rows = static_cast<std::size_t>(figure_.rows), columns = static_cast<std::size_t>(figure_.columns);
        std::vector<Margins> row(rows), column(columns);
        for (std::size_t i = 0; i < panels_.size(); ++i) {
            const Margins margins = margins_of(i);
            Margins &r = row[row_of(i)], &c = column[column_of(i)];
            r.top = std::max(r.top, margins.top), r.bottom = std::max(r.bottom, margins.bottom);
            c.left = std::max(c.left, margins.left), c.right = std::max(c.right, margins.right);
        }
        double used_width = 2 * kEdge + kBetweenColumns * (figure_.columns - 1);
        double used_height = 2 * kEdge + block_height(title_.text);
        for (const Margins& c : column) used_width += c.left + c.right;
        for (const Margins& r : row) used_height += r.top + r.bottom;
        const double width = std::max(kMinFrame, (figure_.width_cm - used_width) / figure_.columns);
        const double height = figure_.height_cm > 0
                                  ? std::max(kMinFrame, (figure_.height_cm - used_height) / figure_.rows)
                                  : default_frame_height(width);
        height_ = figure_.height_cm > 0 ? figure_.height_cm : used_height + height * figure_.rows;

        double top = height_ - kEdge - block_height(title_.text);
        for (std::size_t r = 0; r < rows; ++r) {
            double left = kEdge;
            top -= row[r].top;
            for (std::size_t c = 0; c < columns; ++c) {
                left += column[c].left;
                const std::size_t i = r * columns + c;
                if (i < panels_.size()) panels_[i].box = {left, top - height, left + width, top};
                left += width + column[c].right + kBetweenColumns;
            }
            top -= height + row[r].bottom;
        }
        column_margins_ = column;
        row_margins_ = row;
    }

    void place_texts(std::size_t i) {
        PanelLayout& panel = panels_[i];
        const Rectangle& box = panel.box;
        for (LegendEntry& entry : panel.legend) entry.x += box.left, entry.y += box.top;
        panel.title.x = 0.5 * (box.left + box.right);
        panel.title.y = box.top + row_margins_[row_of(i)].top - 0.5 * block_height(panel.title.text);
        panel.x_label.x = panel.title.x;
        const double below_numbers = box.bottom - kTickLength - (panel.x_numbers ? kTickLine : 0) - 0.5 * kGap;
        panel.x_label.y = below_numbers - 0.5 * block_height(panel.x_label.text);
        panel.y_label.x = box.left - column_margins_[column_of(i)].left + 0.5 * block_height(panel.y_label.text);
        panel.y_label.y = 0.5 * (box.bottom + box.top);
        panel.exponent_x = below_numbers - 0.5 * kTickLine;
        panel.exponent_y = box.top + 0.5 * kGap + 0.5 * kTickLine;
    }

    const Figure& figure_;
    std::vector<PanelLayout> panels_;
    std::vector<bool> direct_;  // names are next to the curves
    std::vector<Margins> column_margins_, row_margins_;
    CenteredText title_;
    double height_ = 0;
};

}  // namespace

FigureLayout lay_out(const Figure& figure) {
    return LayoutWork(figure).run();
}

}  // namespace dynlab::inline figures
