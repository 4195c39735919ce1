#include "figures/figure_text.h"

#include <gtest/gtest.h>

namespace test_figure_text {

using namespace dynlab;

// Oracle: gnuplot's rules for single-quoted strings and enhanced text, by hand.
TEST(figure_text, quotes_are_harmless_and_markup_is_escaped) {
    EXPECT_EQ(gnuplot_text("it's"), "'it’s'");
    EXPECT_EQ(gnuplot_text("a_b{c}^d@e&f~g\\h"), "'a\\_b\\{c\\}\\^d\\@e\\&f\\~g\\\\h'");
    EXPECT_EQ(gnuplot_quoted("/a'b"), "'/a''b'");
}

TEST(figure_text, line_breaks_and_control_characters_become_spaces) {
    EXPECT_EQ(gnuplot_text("a\nsystem 'x'\r\t\x01z"), "'a system ’x’   z'");
    EXPECT_EQ(gnuplot_text(std::string("a\0b", 3)), "'a b'");
}

TEST(figure_text, lines_are_not_broken_at_no_break_spaces) {
    EXPECT_EQ(gnuplot_text("5\u00A0%, 5\u202F%"), "'5 %, 5 %'");
    EXPECT_EQ(text_width("5\u00A0%", 10), text_width("5 %", 10));
    EXPECT_EQ(fit_text("aaa bbb\u00A0ccc", text_width("bbb ccc", 10), 10).lines,
              (std::vector<std::string>{"aaa", "bbb\u00A0ccc"}));
}

TEST(figure_text, braces_raise_and_lower) {
    EXPECT_EQ(gnuplot_text("x_{max}"), "'x_{max}'");
    EXPECT_EQ(gnuplot_text("e^{-t}"), "'e^{-t}'");
    EXPECT_EQ(gnuplot_text("x_{a'}{b"), "'x_{a’}\\{b'");
    EXPECT_EQ(gnuplot_text("x_{never closed"), "'x\\_\\{never closed'");
}

TEST(figure_text, indices_and_exponents_need_no_braces) {
    const std::pair<const char*, const char*> texts[] = {
        {"t_1 (s)", "t_{1} (s)"}, {"y^2", "y^{2}"},           {"of x_k and G_c", "of x_{k} and G_{c}"},
        {"m/s^2", "m/s^{2}"},     {"rad s^-1", "rad s^{−1}"}, {"10^3", "10^{3}"},
        {"(a+b)^2", "(a+b)^{2}"}, {"x_{max}", "x_{max}"},     {"time_ms", "time_ms"},
        {"my_y_2", "my_y_2"},     {"a_test", "a_test"},       {"2 ^ 3", "2 ^ 3"}};
    for (const auto& [written, marked] : texts) EXPECT_EQ(with_marked_indices(written), marked);
    const std::string endless(1'000'000, 'a');
    EXPECT_EQ(with_marked_indices(endless), endless);
}

TEST(figure_text, bytes_that_are_not_utf8_become_question_marks) {
    EXPECT_EQ(gnuplot_text("a\xC3"), "'a?'");
    EXPECT_EQ(gnuplot_text("\xED\xA0\x80"),
              "'?"
              "?"
              "?'");  // a lone surrogate
    EXPECT_EQ(gnuplot_text("\xC0\xA7"),
              "'?"
              "?'");  // an overlong quote
}

TEST(figure_text, long_text_is_cut) {
    EXPECT_LE(gnuplot_text(std::string(100000, 'x')).size(), 220u);
}

// Oracle: gnuplot typesets Latin Modern; an m is 0.833 and a digit 0.5 of the type size wide (the font's metrics).
TEST(figure_text, widths_follow_the_font) {
    EXPECT_NEAR(text_width("mm", 10), 2 * 8.33 * 2.54 / 72, 1e-9);
    EXPECT_NEAR(text_width("1^{1}", 10), (5 + 4) * 2.54 / 72, 1e-9);
}

TEST(figure_text, long_labels_are_broken_then_made_smaller_then_cut) {
    const FittedText two = fit_text("Temperature difference (K)", 2.8, 9);
    EXPECT_EQ(two.lines.size(), 2u);
    for (const std::string& line : two.lines) EXPECT_LE(text_width(line, two.size), 2.81);
    const FittedText cut = fit_text(std::string(100, 'w'), 2.8, 9);
    EXPECT_LE(text_width(cut.lines[0], cut.size), 2.81);
}

}  // namespace test_figure_text
