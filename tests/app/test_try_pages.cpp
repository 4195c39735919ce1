// The figures of lessons 1, 2 and 4 that readers move on a page without a server, in a real browser. Oracles: the
// parameters that the simulators have, and the laws of bias and scatter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/browser.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_try_pages {
using nlohmann::json;

class try_pages : public testing::Test {
  protected:
    void open(const std::string& lesson, const std::string& figure) {
        const std::filesystem::path page = page_of_lesson(lesson);
        EXPECT_LT(std::filesystem::file_size(page), 3u << 20);
        browser_.open("file://" + page.string());
        ASSERT_TRUE(browser_.becomes_true("document.querySelector('img[alt*=\"" + figure + "\"]')"));
        browser_.evaluate("window.image = document.querySelector('img[alt*=\"" + figure +
                          "\"]'); image.scrollIntoView({block: 'center'})");
        ASSERT_TRUE(browser_.becomes_true("window.box = image.closest('.piece').querySelector('div.plot')"));
    }
    json value(const std::string& expression) { return json::parse(browser_.evaluate("return " + expression)); }
    double number(const std::string& slider) {
        return std::stod(value("document.querySelector('.slider:has(#slider-" + slider + ") output').textContent")
                             .get<std::string>());
    }
    /// The pointer drags the handle of that name to a place in the handle's panel.
    void drag(const std::string& name, double x, double y) {
        const json places =
            value("(() => { const { plot } = box, handle = plot.handles.find(one => one.mark.name === '" + name +
                  "'), frame = box.getBoundingClientRect(), at = ([x, y]) => [Math.round(frame.left + x * plot.unit), "
                  "Math.round(frame.top + (plot.size[1] - y) * plot.unit)]; return [at(handle.place), "
                  "at(handle.panel.place(" +
                  std::to_string(x) + ", " + std::to_string(y) + "))] })()");
        const auto move = [](const json& place) {
            return json{{"type", "pointerMove"}, {"duration", 50}, {"x", place[0]}, {"y", place[1]}};
        };
        const json actions = {move(places[0]),
                              {{"type", "pointerDown"}, {"button", 0}},
                              move(places[1]),
                              {{"type", "pointerUp"}, {"button", 0}}};
        browser_.act(json::array({{{"type", "pointer"}, {"id", "mouse"}, {"actions", actions}}}).dump());
    }
    /// The number behind some words of the figure: its title, or the name of a curve.
    double said(const std::string& words) {
        const std::string text = value(
            "[...box.plot.texts.map(one => one.text), ...box.plot.panels[0].curves.map(one => one.label)].join(' ')");
        const auto at = text.find(words);
        EXPECT_NE(at, text.npos) << text;
        return at == text.npos ? NAN : std::stod(text.substr(at + words.size()));
    }
    void move(const std::string& slider, int place) {
        browser_.evaluate("const input = document.getElementById('slider-" + slider +
                          "'); input.value = " + std::to_string(place) + "; input.dispatchEvent(new Event('input'))");
    }

    Browser browser_;
};

TEST_F(try_pages, a_first_order_model_is_found_by_hand) {
    open("01_process_models", "and a first-order model");
    EXPECT_LT(said("fit "), 75);
    const double rest = value("box.plot.panels[0].curves[1].y[0]");
    drag("63 %", 60 + 75, rest + 0.632 * 0.5 * 20);  // true_model: 0.501 °C/%, 76.2 s; the valve moves by 20 %
    EXPECT_NEAR(number("T"), 75, 0.1);
    EXPECT_NEAR(number("K"), 0.5, 0.001);
    EXPECT_GT(said("fit "), 95);
    drag("final level", 560, rest + 0.4 * 20);
    EXPECT_NEAR(number("K"), 0.4, 0.001);
    EXPECT_NEAR(number("T"), 75, 0.1);
}

TEST_F(try_pages, a_second_order_model_is_found_by_hand) {
    open("01_process_models", "and a second-order model");
    drag("final level", 2.3, 10);  // true_model: 10 mm/V, 0.194, 12.9 rad/s
    const double overshoot = std::exp(-M_PI * 0.2 / std::sqrt(1 - 0.04)), instant = M_PI / (13 * std::sqrt(1 - 0.04));
    for (int i = 0; i < 3; ++i) drag("first peak", instant, 10 * (1 + overshoot));  // its instant depends on z, too
    EXPECT_NEAR(number("K2"), 10, 1e-9);
    EXPECT_NEAR(number("z"), 0.2, 1e-9);
    EXPECT_NEAR(number("omega_0"), 13, 1e-9);
    EXPECT_GT(said("fit "), 90);
}

TEST_F(try_pages, more_samples_leave_the_bias_and_less_noise_does_not) {
    open("02_least_squares", "errors of a hundred");
    const double bias = said("bias "), scatter = said("scatter ");
    move("N", 4);
    EXPECT_NEAR(said("bias "), bias, scatter);
    EXPECT_NEAR(said("scatter "), scatter * std::sqrt(400.0 / 1300.0), 0.3 * scatter);
    move("sigma", 0);
    EXPECT_LT(said("bias "), bias / 3);
    move("N", 0);
    EXPECT_GT(said("scatter "),
              0.8 * scatter * std::sqrt(400.0 / 100.0) / 3);  // in proportion to sigma where that is small
    move("Ts", 4);
    EXPECT_LT(said("bias "), bias / 3);
}

TEST_F(try_pages, lambda_moves_the_filter_and_the_estimates) {
    open("04_estimators", "colors the equation error; right");
    const auto cloud = [&](int curve) {  // standard deviation of its abscissas
        const std::vector<double> x = value("box.plot.panels[1].curves[" + std::to_string(curve) + "].x");
        double mean = 0, square = 0;
        for (const double one : x) mean += one / double(x.size());
        for (const double one : x) square += (one - mean) * (one - mean) / double(x.size());
        return std::sqrt(square);
    };
    EXPECT_NEAR(value("box.plot.panels[0].curves[0].y[0]"), 3.0 / 9, 0.01);  // |A/E| = 3/lambda^2 at low frequencies
    const double at_3 = cloud(1);
    drag("λ", 30, 1);
    EXPECT_NEAR(number("lambda"), 30, 1e-9);
    EXPECT_NEAR(value("box.plot.panels[0].curves[0].y[0]"), 3.0 / 900, 1e-4);
    EXPECT_GT(cloud(1), 2 * at_3);
}

}  // namespace test_try_pages
}  // namespace dynlab::test
