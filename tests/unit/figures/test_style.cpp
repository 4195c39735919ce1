// Oracle: the standard plots as poppler draws them in grey; what a reader needs of their axes.
#include "figures/style.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "figures/figure_layout.h"
#include "figures/gnuplot_renderer.h"
#include "figures/plots/bode_plot.h"
#include "figures/plots/compare_plot.h"
#include "figures/plots/id_plot.h"
#include "figures/plots/impulse_plot.h"
#include "figures/plots/nyquist_plot.h"
#include "figures/plots/residual_plot.h"
#include "figures/plots/step_plot.h"
#include "figures/step_construction.h"
#include "numerics/signals/random.h"
#include "numerics/simulation/lsim.h"
#include "platform/child_process.h"
#include "platform/temporary_folder.h"

namespace test_style {

using namespace dynlab;

TransferFunction second_order(double damping) {
    return TransferFunction(Vector{{1.0}}, Vector{{1.0, 2 * damping, 1.0}});
}

std::vector<NamedModel> models(int count) {
    std::vector<NamedModel> result;
    for (int i = 0; i < count; ++i) result.push_back({"G_" + std::to_string(i), second_order(0.2 + 0.1 * i)});
    return result;
}

IdData record(int seed) {
    RandomStream random(static_cast<std::uint32_t>(seed));
    const Vector u = random.normal(200).array().sign();
    return IdData(Matrix(lsim(second_order(0.4), u, 0.1) + 0.3 * random.normal(200)), Matrix(u), 0.1);
}

Figure compared(int count) {
    const IdData data = record(1);
    std::vector<ModelOutput> outputs;
    for (int i = 0; i < count; ++i)
        outputs.push_back({"G", data.experiments[0].y * (1 - 0.1 * i), Vector::Constant(1, 80)});
    return compare_plot(data, outputs);
}

Figure residuals() {
    const IdData data = record(2);
    return residual_plot(residual_tests(data, {second_order(0.2)}), data);
}

Figure plain(int count) {
    Panel panel;
    for (int i = 0; i < count; ++i) {
        Curve curve;
        curve.x = Vector::LinSpaced(20, 0, 1);
        curve.y = curve.x * i;
        curve.label = std::to_string(i);
        panel.curves.push_back(std::move(curve));
    }
    return Figure(std::move(panel));
}

Figure constructed() {
    StepConstruction input;
    input.t = Vector::LinSpaced(101, 0, 50);
    input.y = input.smoothed = 20 + 10 * (1 - (-(input.t.array() - 10).max(0) / 5).exp());
    input.step_time = 10, input.initial = 20, input.final = 30;
    input.readings = {{"settling", 25, 29.5}};
    return step_construction(input);
}

std::vector<std::pair<std::string, Figure>> standard_figures() {
    const IdData a = record(1), b = record(2), c = record(3), d = record(4);
    return {{"plot", plain(12)},
            {"step", step_plot(models(6))},
            {"impulse", impulse_plot(models(4))},
            {"bode", bode_plot(models(5))},
            {"nyquist", nyquist_plot(models(4))},
            {"compare", compared(7)},
            {"resid", residuals()},
            {"idplot", id_plot({&a, &b, &c, &d})},
            {"step_first_order", constructed()}};
}

/// A panel of a straight line in the look of one of a panel's curves; the others lie outside. Negative: none.
Figure line_in_the_look_of(const Panel& panel, int shown) {
    Panel lone;
    lone.x_range = lone.y_range = std::pair{0.0, 1.0};
    lone.legend = LegendPlace::kNone;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        Curve curve = panel.curves[i];
        curve.x = Vector::LinSpaced(12, 0, 1);
        curve.y = Vector::Constant(12, static_cast<int>(i) == shown ? 0.5 : -9.0);
        if (curve.style == CurveStyle::kBand) curve.y_upper = curve.y;
        lone.curves.push_back(std::move(curve));
    }
    return Figure(std::move(lone));
}

/// How dark every point of a PDF is, 0 to 255.
std::vector<int> darkness(const std::filesystem::path& pdf) {
    ChildOptions child;
    child.command = {"pdftoppm", "-gray", "-r", "150", pdf.string()};
    std::istringstream image(run_child(child, "poppler-utils").output);
    std::string kind;
    int width = 0, height = 0, white = 0;
    image >> kind >> width >> height >> white;
    image.get();
    std::vector<int> result(static_cast<std::size_t>(width * height));
    for (int& value : result) value = white - image.get();
    return result;
}

double distance(const std::vector<int>& a, const std::vector<int>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
}

/// The looks of a panel's named curves in grey.
class GreyLooks {
  public:
    explicit GreyLooks(const Panel& panel) {
        GnuplotRenderer renderer;
        const auto file = [this](int i) { return folder_.path() / (std::to_string(i) + ".pdf"); };
        std::vector<int> named;
        for (int i = 0; i < static_cast<int>(panel.curves.size()); ++i) {
            const Curve& curve = panel.curves[static_cast<std::size_t>(i)];
            if (!curve.label.empty() && curve.style != CurveStyle::kBand) named.push_back(i);
        }
        named.push_back(-1);
        for (const int i : named) renderer.draw(line_in_the_look_of(panel, i), file(i), FigureFormat::kPdf);
        renderer.finish();
        for (const int i : named) drawn_.push_back(darkness(file(i)));
    }
    std::size_t size() const { return drawn_.size() - 1; }
    /// 0 for equal looks, 2 for marks that nowhere meet.
    double difference(std::size_t i, std::size_t k) const {
        const double ink = distance(drawn_[i], drawn_.back()) + distance(drawn_[k], drawn_.back());
        return 2 * distance(drawn_[i], drawn_[k]) / ink;
    }

  private:
    TemporaryFolder folder_;
    std::vector<std::vector<int>> drawn_;
};

TEST(style, curves_of_the_standard_plots_are_told_apart_in_grey) {
    constexpr double kSeen = 0.3;
    for (const auto& [name, figure] : standard_figures())
        for (const Panel& panel : figure.panels) {
            const GreyLooks looks(panel);
            for (std::size_t i = 0; i + 1 < looks.size(); ++i)
                EXPECT_GT(looks.difference(i, i + 1), kSeen) << name << ", curves " << i << " and " << i + 1;
        }
}

TEST(style, no_two_of_nine_curves_look_alike_in_grey) {
    const GreyLooks looks(plain(9).panels[0]);
    ASSERT_EQ(looks.size(), 9u);
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t k = 0; k < i; ++k) EXPECT_GT(looks.difference(i, k), 0.3) << i << " and " << k;
}

// A filled circle and an open square.
TEST(style, stems_beyond_the_bound_have_a_marker_of_their_own) {
    std::map<bool, std::set<int>> markers;
    for (const Panel& panel : residuals().panels)
        for (const Curve& curve : panel.curves)
            if (curve.style == CurveStyle::kStems)
                markers[curve.label == "beyond the bound"].insert(style::look_of(curve, 0).point_type);
    ASSERT_EQ(markers.size(), 2u);
    EXPECT_NE(markers[false], markers[true]);
}

TEST(style, the_measurement_is_wider_than_the_model_upon_it) {
    for (const Panel& panel : compared(1).panels)
        EXPECT_GE(panel.curves[0].line_width, 2 * panel.curves[1].line_width + 0.5);
}

TEST(style, every_axis_of_the_standard_plots_has_four_numbers) {
    auto figures = standard_figures();
    figures.emplace_back("bode of an integrator",
                         bode_plot({{"", TransferFunction(Vector{{1.0}}, Vector{{1.0, 0.0}})}}));
    figures.emplace_back("bode of a gain with a lag",
                         bode_plot({{"", TransferFunction(Vector{{3.0}}, Vector{{1.0, 2.0}})}}));
    for (const auto& [name, figure] : figures)
        for (const PanelLayout& panel : lay_out(figure).panels) {
            EXPECT_GE(panel.x.ticks.size(), 4u) << name << ", x from " << panel.x.low << " to " << panel.x.high;
            EXPECT_GE(panel.y.ticks.size(), 4u) << name << ", y from " << panel.y.low << " to " << panel.y.high;
            EXPECT_LE(panel.y.ticks.size(), 9u) << name;
        }
}

}  // namespace test_style
