#pragma once
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "figures/figure.h"
#include "figures/gnuplot_renderer.h"
#include "figures/style.h"
#include "platform/cache.h"
#include "platform/child_process.h"
#include "platform/temporary_folder.h"

namespace dynlab::test {

/// Looks with a smaller difference are hard to distinguish: 0 means equal looks.
inline constexpr double kSeenInGrey = 0.3;

/// A panel of a straight line in the look of one of a panel's curves; the others lie outside. Negative: none.
inline Figure line_in_the_look_of(const Panel& panel, int shown) {
    Panel lone;
    lone.x_range = lone.y_range = std::pair{0.0, 1.0};
    lone.legend = LegendPlace::kNone;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        Curve curve = panel.curves[i];
        if (!curve.label.empty()) curve.label = Message("curve");  // which is not drawn
        curve.x = Vector::LinSpaced(12, 0, 1);
        curve.y = Vector::Constant(12, static_cast<int>(i) == shown ? 0.5 : -9.0);
        if (curve.style == CurveStyle::kBand) {
            curve.y_upper = curve.y;
            if (static_cast<int>(i) == shown) curve.y.array() -= 0.2, curve.y_upper.array() += 0.2;
        }
        lone.curves.push_back(std::move(curve));
    }
    return Figure(std::move(lone));
}

/// How dark every point of a PDF is, 0 to 255.
inline std::vector<int> darkness(const std::filesystem::path& pdf) {
    ChildOptions child;
    child.command = {"pdftoppm", "-gray", "-r", "150", pdf.string()};
    const std::string image = run_child(child, "poppler-utils").output;
    std::istringstream head(image);
    std::string kind;
    int width = 0, height = 0, white = 0;
    head >> kind >> width >> height >> white;
    const std::size_t begin = static_cast<std::size_t>(head.tellg()) + 1;
    std::vector<int> result(static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = white - static_cast<unsigned char>(image.at(begin + i));
    return result;
}

inline double distance(const std::vector<int>& a, const std::vector<int>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
}

/// The looks of a panel's named curves, but its bands, or of its bands' edges, in grey.
class GreyLooks {
  public:
    enum class Of { kNamedCurves, kBands };
    explicit GreyLooks(const Panel& panel, Of of = Of::kNamedCurves) {
        const Cache cache;  // most panels have looks that another one has, too
        GnuplotRenderer renderer(&cache);
        const auto file = [this](int i) { return folder_.path() / (std::to_string(i) + ".pdf"); };
        std::vector<int> named;
        for (int i = 0; i < static_cast<int>(panel.curves.size()); ++i) {
            const Curve& curve = panel.curves[static_cast<std::size_t>(i)];
            const bool band = curve.style == CurveStyle::kBand;
            if (of == Of::kBands ? band : !curve.label.empty() && !band) named.push_back(i);
        }
        if (named.size() < 2) return;  // no looks to distinguish
        named.push_back(-1);
        for (const int i : named) renderer.draw(line_in_the_look_of(panel, i), file(i), FigureFormat::kPdf);
        renderer.finish();
        for (const int i : named) drawn_.push_back(darkness(file(i)));
        if (of == Of::kBands)
            for (std::vector<int>& points : drawn_)
                for (int& point : points) point = point > kDarkestFill ? point : 0;
    }
    std::size_t size() const { return drawn_.empty() ? 0 : drawn_.size() - 1; }
    /// 0 for equal looks, 2 for marks that nowhere meet.
    double difference(std::size_t i, std::size_t k) const {
        const double ink = distance(drawn_[i], drawn_.back()) + distance(drawn_[k], drawn_.back());
        return 2 * distance(drawn_[i], drawn_[k]) / ink;
    }

  private:
    static constexpr int kDarkestFill = 70;  ///< of a band
    TemporaryFolder folder_;
    std::vector<std::vector<int>> drawn_;
};

}  // namespace dynlab::test
