// Oracle: what a French engineer writes at these plots, by hand.
#include "figures/readable_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/languages.h"
#include "figures/gnuplot_script.h"
#include "figures/plots/bode_plot.h"
#include "figures/plots/compare_plot.h"
#include "figures/plots/delay_plot.h"
#include "figures/plots/history_plot.h"
#include "figures/plots/id_plot.h"
#include "figures/plots/pole_zero_map.h"
#include "figures/plots/regression_plot.h"
#include "figures/plots/residual_plot.h"
#include "figures/plots/time_response_plots.h"
#include "figures/step_construction.h"
#include "numerics/simulation/lsim.h"

namespace test_readable_figure {

using namespace dynlab;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Reader french() {
    return {catalog_of("fr")};
}
const TransferFunction kLag(Vector{{1.0}}, Vector{{2.0, 1.0}});

/// All texts of the figure that are not empty, panel by panel.
std::vector<std::string> texts_of(const Figure& figure, const Reader& reader = french()) {
    std::vector<std::string> texts;
    const auto add = [&](const Message& label) {
        if (!label.empty()) texts.push_back(message_text(label));
    };
    const Figure shown = readable(figure, reader);
    add(shown.title);
    for (const Panel& panel : shown.panels) {
        for (const Message* label : {&panel.title, &panel.x_label, &panel.y_label}) add(*label);
        for (const Curve& curve : panel.curves) add(curve.label);
        for (const ReferenceLine& line : panel.references) add(line.label);
        for (const Annotation& mark : panel.annotations) add(mark.text);
        for (const Arrow& arrow : panel.arrows) add(arrow.text);
    }
    return texts;
}

Figure picture(const Message& x_label, const Message& curve) {
    Panel panel;
    panel.x_label = x_label;
    panel.y_label = Message::verbatim("angle (rad)");
    panel.x_range = {0, 1};
    Curve line;
    line.x = Vector{{0, 0.5, 1}};
    line.y = Vector{{0, 0.25, 0.5}};
    line.label = curve;
    panel.curves.push_back(line);
    panel.references = {{true, 0.5, Message::verbatim("best"), 1}};
    return Figure(panel);
}

TEST(readable_figure, quantities_are_french_and_units_stay) {
    EXPECT_THAT(texts_of(step_plot({{Message::verbatim("G1"), kLag}})), ElementsAre("temps (s)", "amplitude", "G1"));
    EXPECT_THAT(texts_of(bode_plot({{{}, kLag}})), ElementsAre("module (dB)", "pulsation (rad/s)", "phase (°)"));
    EXPECT_THAT(texts_of(pole_zero_map({{Message("model {}", 2), kLag}})),
                ElementsAre("axe réel (1/s)", "axe imaginaire (rad/s)", "modèle 2\u202F: pôles"));
    IdData data(Matrix(Vector{{0.0, 1.0, 2.0}}), Matrix(Vector{{1.0, 1.0, 0.0}}), 0.1);
    data.time_unit = "min";
    data.output_names = {"angle"}, data.output_units = {"rad"};
    data.input_names = {"u"}, data.input_units = {"V"};
    EXPECT_THAT(texts_of(id_plot({&data, &data})),
                ElementsAre("angle (rad)", "données 1", "données 2", "temps (min)", "u (V)", "données 1"));
    data.experiments.push_back(data.experiments.front());
    EXPECT_THAT(texts_of(id_plot({&data})), Contains("expérience 2"));
}

TEST(readable_figure, numbers_have_commas_and_stand_where_french_has_them) {
    ParameterHistory history{Vector::LinSpaced(9, 0, 8), Matrix::Constant(9, 1, 3), Matrix::Constant(9, 1, 0.1)};
    EXPECT_THAT(texts_of(history_plot(history, {"a1"}, {{"a1", Vector::Ones(1)}}, 0.995)),
                ElementsAre("temps (s)", "a1", "estimation", "vraie valeur", "confiance à 99,5\u202F%"));
    DelaySearch search;
    search.delay = 0.23;
    search.std = 0.011;
    search.candidate.estimate.delay_grid = Vector{{0, 0.1}};
    search.candidate.estimate.delay_loss = Vector{{0.6, 1}};
    EXPECT_THAT(texts_of(delay_plot(search)),
                ElementsAre("retard (s)", "erreur quadratique moyenne", "meilleur modèle à chaque retard",
                            "estimation, 0,230 ± 0,011 s"));
    RegressionPicture regression;
    regression.level = 0.975;
    regression.line_x = regression.line_y = Vector{{0.0, 1.0}};
    regression.prediction_lower = regression.prediction_upper = regression.line_y;
    EXPECT_THAT(texts_of(regression_plot(regression)), Contains("bande de prévision à 97,5\u202F%"));
    StepConstruction step;
    step.t = step.y = Vector::LinSpaced(11, 0, 10);
    step.final = 10;
    step.readings = {{"settling", 2.25, 9.5}, {"63.2 %", 1.5, 6.32}};
    EXPECT_THAT(texts_of(step_construction(step)),
                AllOf(Contains("bande de ±5\u202F%"), Contains("valeur initiale"), Contains("T_{r} = 2,25 s"),
                      Contains("63,2 % à t_{1} = 1,5 s")));
}

TEST(readable_figure, names_are_in_sentences_of_the_language) {
    const Vector u = Vector::LinSpaced(60, 0, 3).array().sin(), y = lsim(kLag, u, 0.1);
    const IdData data(Matrix(y), Matrix(u), 0.1);
    EXPECT_THAT(texts_of(residual_plot(residual_tests(data, {TransferFunction(Vector{{1.0}}, Vector{{1.0, 1.0}})}),
                                       data, 0.99)),
                AllOf(Contains("autocorrélation des résidus de " + data.output_names[0]),
                      Contains("corrélation avec " + data.input_names[0]), Contains("borne à 99\u202F%"),
                      Contains("décalage (échantillons)")));
    const ModelOutput model{Message::verbatim("T = 0.5 s"), y, Vector::Constant(1, 93.26)};
    EXPECT_THAT(texts_of(compare_plot(data, {model})), Contains("T = 0,5 s\u202F: 93,3\u202F%"));
    EXPECT_THAT(texts_of(compare_plot(data, {model}), {}), Contains("T = 0.5 s: 93.3 %"));
}

TEST(readable_figure, what_a_user_wrote_stays_but_for_its_commas) {
    const Figure figure = picture(Message::verbatim("time (s)"), Message::verbatim("measured, 0.5 of them"));
    EXPECT_THAT(texts_of(figure), ElementsAre("time (s)", "angle (rad)", "measured, 0,5 of them", "best"));
    EXPECT_THAT(texts_of(figure, {}), ElementsAre("time (s)", "angle (rad)", "measured, 0.5 of them", "best"));
}

TEST(readable_figure, is_read_again_as_it_is) {
    const Figure figure = picture(axis_label(Message("time"), "s"), Message("{}: {} %", "G", decimals(93.2, 1)));
    EXPECT_EQ(texts_of(readable(figure, french())), texts_of(figure));
}

TEST(readable_figure, numbers_beside_the_axes_have_commas_where_the_language_has) {
    const Figure figure = picture(Message::verbatim("x"), Message::verbatim("y"));
    const std::string plain = gnuplot_script(figure, FigureFormat::kSvg);
    const std::string commas = gnuplot_script(figure, FigureFormat::kSvg, french());
    EXPECT_THAT(plain, HasSubstr("'0.5'"));
    EXPECT_THAT(plain, Not(HasSubstr("'0,5'")));
    EXPECT_THAT(commas, HasSubstr("'0,5'"));
    EXPECT_THAT(commas, Not(HasSubstr("'0.5'")));
}

TEST(readable_figure, decimal_points_become_commas_and_other_points_stay) {
    EXPECT_EQ(with_decimal_commas("G: 93.2 % of 0.5"), "G: 93,2 % of 0,5");
    for (const char* text : {"", ".", "1.", ".5", "1.2.3", "end. 5", "a.1", "20", "modèle 3.", "12.."})
        EXPECT_EQ(with_decimal_commas(text), text);
}

}  // namespace test_readable_figure
