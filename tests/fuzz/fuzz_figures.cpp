// Figures of all numbers that there are, as gnuplot's commands and as a page's data; nothing is drawn. What is not
// refused has a script of bounded length without numbers that gnuplot cannot read.
#include <cmath>
#include <cstring>
#include <limits>

#include "documents/html/plot_data.h"
#include "figures/figure.h"
#include "figures/gnuplot_script.h"
#include "fuzz/fuzz_input.h"
#include "numerics/error.h"

using namespace dynlab;

namespace {

constexpr double kOdd[] = {0,     -0.0,   1,       -1,       5e-324,   2.2e-308, 1e-305,
                           1e300, -1e300, 1.7e308, -1.7e308, INFINITY, NAN,      1 + 2.3e-16};
constexpr unsigned kOwnBytes = 32;  // from this choice on, the next eight bytes are the number

double take_number(std::string& text) {
    const unsigned choice = fuzz::take_choice(text);
    if (choice < kOwnBytes) return kOdd[choice % std::size(kOdd)];
    if (choice % 2 == 0) return static_cast<double>(choice) - 128;
    char bytes[sizeof(double)] = {};
    text.copy(bytes, sizeof bytes);
    text.erase(0, sizeof bytes);
    double number = 0;
    std::memcpy(&number, bytes, sizeof number);
    return number;
}

Vector take_vector(std::string& text, unsigned count) {
    Vector values(count);
    for (double& value : values) value = take_number(text);
    return values;
}

Message take_label(std::string& text) {
    const std::size_t length = fuzz::take_choice(text) % 8;
    const std::string label = text.substr(0, length);
    text.erase(0, length);
    return Message::verbatim(label);
}

Curve take_curve(std::string& text) {
    Curve curve;
    const unsigned count = fuzz::take_choice(text) % 16;
    curve.style = static_cast<CurveStyle>(fuzz::take_choice(text) % 7);
    curve.x = take_vector(text, count), curve.y = take_vector(text, count);
    if (curve.style == CurveStyle::kBand) curve.y_upper = take_vector(text, count);
    curve.label = take_label(text);
    return curve;
}

Panel take_panel(std::string& text) {
    Panel panel;
    const unsigned choice = fuzz::take_choice(text), more = fuzz::take_choice(text);
    panel.log_x = choice & 1, panel.log_y = choice & 2, panel.equal_axes = choice & 4;
    if (choice & 8) panel.x_range = {take_number(text), take_number(text)};
    if (choice & 16) panel.y_range = {take_number(text), take_number(text)};
    if (choice & 32) panel.x_tick_step = take_number(text);
    panel.legend = static_cast<LegendPlace>(choice / 64 + more / 64 % 2);
    if (more & 1) panel.references.push_back({(more & 2) != 0, take_number(text), take_label(text), 1});
    if (more & 4) panel.annotations.push_back({take_number(text), take_number(text), take_label(text)});
    if (more & 8)
        panel.arrows.push_back(
            {take_number(text), take_number(text), take_number(text), take_number(text), take_label(text)});
    for (unsigned curves = more / 16 % 4; curves > 0; --curves) panel.curves.push_back(take_curve(text));
    return panel;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text = fuzz::text_of(data, size);
    const unsigned choice = fuzz::take_choice(text);
    Figure figure;
    figure.rows = 1 + static_cast<int>(choice % 3), figure.columns = 1 + static_cast<int>(choice / 3 % 3);
    if (choice & 128) figure.width_cm = take_number(text);
    if (choice & 64) figure.height_cm = take_number(text);
    for (int panels = figure.rows * figure.columns; panels > 0; --panels) figure.panels.push_back(take_panel(text));
    try {
        figure.validate();
    } catch (const InvalidArgument&) {
        return 0;
    }
    const std::string script = gnuplot_script(figure, FigureFormat::kPdf);
    fuzz::demand(script.size() < 10'000'000);
    fuzz::demand(script.find("inf,") == std::string::npos && script.find(" nan") == std::string::npos);
    plot_data(figure);
    return 0;
}
