#include <gmock/gmock.h>

#include <regex>

#include "document_fixture.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_slots {

using test::inspect_pdf;
using testing::AllOf;
using slots = DocumentTest;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Oracle of this file: the slots of a template as document.h and report_templates/exercise_sheet.md describe them.

TEST_F(slots, a_value_is_plain_text_never_markdown) {
    record_.values["fit"] = {93.2, "93.2"};
    record_.values["odd"] = {std::nullopt, "a*b* $x$ <b> `c` [d](e) \"]]\\n"};
    EXPECT_THAT(html("The fit is `fit`{.value} %.\n"), HasSubstr("The fit is 93.2\u202F%."));
    EXPECT_THAT(html("`odd`{.value}\n"), HasSubstr("a*b* $x$ &lt;b&gt; `c` [d](e) \"]]\\n"));
}

TEST_F(slots, a_number_and_its_unit_stay_on_one_line) {
    record_.values["gain"] = {60.5, "60.5"};
    EXPECT_THAT(html("Of `gain`{.value} mm/s, 5\nms; in 2 steps.\n"),
                HasSubstr("Of 60.5\u202Fmm/s, 5\u202Fms; in 2 steps."));
    EXPECT_THAT(html("A gain of 5.72 °C/V, 3 mm/V or 2 °C/%; 4 N·m·s and 9 m/s²; 2 a/b, 3 and/or 4 s/x.\n"),
                HasSubstr("A gain of 5.72\u202F°C/V, 3\u202Fmm/V or 2\u202F°C/%; 4\u202FN·m·s and 9\u202Fm/s²; 2 a/b, "
                          "3 and/or 4 s/x."));
    EXPECT_THAT(read(make("Some 92 ± 3 %, and ($p =$ `gain`{.value}).\n", "out.html")),
                AllOf(HasSubstr("92\u00A0±\u00A03\u202F%"), ContainsRegex("</math>\u00A060.5[)]")));
}

TEST_F(slots, french_numbers_have_a_comma_and_names_keep_their_point) {
    record_.values["fit"] = {93.2, "93.2"};
    record_.values["low"] = {-0.5, "-0.5"};
    record_.values["name"] = {std::nullopt, "version 1.2 of it"};
    record_.tables["models"] = {{"Modèle", "Fit"}, {{"P1.5 x", "17.5 ± 0.4"}, {"P2", "-7.25"}}};
    const std::string body =
        "---\nContre `fit`{.value}, `low`{.value}, `name`{.value}.\n\n::: {.table name=models}\n:::\n";
    const auto seen = [&](const std::string& header) {  // without what only aligns the points of a column
        return std::regex_replace(html(header + body), std::regex("<span class=\"unseen\">[^<]*</span>"), "");
    };
    const std::string text = seen("---\nlang: fr\n");
    EXPECT_THAT(text, HasSubstr("Contre 93,2, "));
    EXPECT_THAT(text, HasSubstr("-0{,}5")) << "a decimal comma of TeX";
    EXPECT_THAT(text, HasSubstr("version 1.2 of it"));
    EXPECT_THAT(text, HasSubstr(">P1.5 x<"));
    EXPECT_THAT(text, HasSubstr(">17,5 ± 0,4<"));
    EXPECT_THAT(text, HasSubstr(">−7,25<"));
    EXPECT_THAT(seen("---\nlang: en\n"), HasSubstr(">17.5 ± 0.4<"));
}

/// What is read, without tags, the TeX beside formulas, and spaces of formulas.
std::string read_from(const std::string& html) {
    std::string text =
        std::regex_replace(html, std::regex("<annotation[^>]*>[^<]*</annotation>|<mspace[^>]*>|<[^>]+>"), "");
    for (const auto& [from, to] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}, {"&quot;", "\""}})
        text = replaced(text, from, to);
    return text;
}

// Oracle: how such numbers are printed, by hand (field case 02).
TEST_F(slots, values_are_filled_in_captions_cells_headings_and_formulas) {
    struct Shown {
        const char *text, *in_prose, *in_formula, *in_french;
    };
    constexpr Shown kShown[] = {
        {"2.50", "2.50", "2.50", "2,50"},
        {"-2.5", "−2.5", "−2.5", "−2,5"},
        {"0", "0", "0", "0"},
        {"1.2e-07", "1.2⋅10−7", "1.2⋅10−7", "1,2⋅10−7"},
        {"-3.4e+20", "−3.4⋅1020", "−3.4⋅1020", "−3,4⋅1020"},
        {"-1 + 2i", "−1+2i", "−1+2i", "−1+2i"},
        {"1e-05 - 3.5i", "1⋅10−5−3.5i", "1⋅10−5−3.5i", "1⋅10−5−3,5i"},
        {"-2.5 ± 0.1", "−2.5±0.1", "−2.5±0.1", "−2,5±0,1"},
        {"NaN", "NaN", "NaN", "NaN"},
        {"-Inf", "-Inf", "−∞", "−∞"},
        {"-2.5 s", "−2.5 s", "−2.5s", "−2,5s"},
        {"50% of a_b & #1", "50% of a_b & #1", "50%of a_b &#1", "50%of a_b &#1"},
        {"$x$ {y} \\alpha ^~<b>", "$x$ {y} \\alpha ^~<b>", "$x$ {y} \\alpha^~<b>", "$x$ {y} \\alpha^~<b>"},
        {"2024-05-01", "2024-05-01", "2024-05-01", "2024-05-01"},
        {"version 1.2.3", "version 1.2.3", "version 1.2.3", "version 1.2.3"},
        {"1.2.3", "1.2.3", "1.2.3", "1.2.3"},
    };
    add_figure("a", "Of the script: `v`{.value}.", DocumentFormat::kHtml);
    record_.tables["t"] = {{"Model", "Cell `v`{.value}."}, {{"P1", "1"}}};
    const auto without_spaces = [](const std::string& text) {
        return std::regex_replace(text, std::regex("[ \u202F]"), "");
    };
    const std::string body =
        "# Heading `v`{.value}.\n\nProse `v`{.value}.\n\nFormula $`v`{.value}$.\n\n$$ `v`{.value} $$ {#eq:a}\n\n"
        "![Caption `v`{.value} and $`v`{.value}$.](figure:a){#fig:a}\n\n![](figure:a)\n\n"
        "| Column `v`{.value}. |\n|---|\n| In a cell: `v`{.value}. |\n\n: Table `v`{.value}. {#tbl:x}\n\n"
        "::: {.table name=t}\nRecorded `v`{.value}.\n:::\n\n- item `v`{.value}.\n\n> quote `v`{.value}.[^1]\n\n"
        "[^1]: note `v`{.value}.\n\n::: note\nBox **`v`{.value}.**\n:::\n";
    for (const auto& [value, in_prose, in_formula, in_french] : kShown) {
        record_.values["v"] = {std::nullopt, value};
        const std::string shown = without_spaces(read_from(html("---\ntitle: Title `v`{.value}.\n---\n" + body)));
        const std::string prose = without_spaces(in_prose) + ".", formula = without_spaces(in_formula);
        for (const char* place : {"Title", "Heading", "Prose", "Caption", "Ofthescript:", "Column", "Inacell:",
                                  "Table2.Recorded", "Table1.Table", "Cell", "item", "quote", "note", "Box"}) {
            const std::string expected = place == std::string("Caption")
                                             ? place + without_spaces(in_prose) + "and" + formula + "."
                                         : place == std::string("Cell") ? place + without_spaces(value) + "."
                                                                        : place + prose;
            EXPECT_THAT(shown, HasSubstr(expected)) << value;
        }
        EXPECT_THAT(shown, HasSubstr("Formula" + formula + ".")) << value;
        EXPECT_THAT(shown, HasSubstr(formula + "(1)")) << value;
        const std::string french = without_spaces(read_from(html("---\nlang: fr\n---\nDe $`v`{.value}$.\n")));
        EXPECT_THAT(french, HasSubstr("De" + without_spaces(in_french) + ".")) << value;
    }
}

// Oracle: the rules of signs, (-2)² = 4 and 1 - (-2) = 3.
TEST_F(slots, a_value_in_a_formula_keeps_the_formulas_meaning) {
    record_.values["b"] = {-2.5, "-2.5"};
    record_.values["t"] = {1e-7, "1e-07"};
    record_.values["g"] = {2.5, "2.5"};
    const auto tex = [&](const std::string& formula) {
        const std::string page = html("$" + formula + "$\n");
        const std::size_t from = page.find("x-tex\">") + 7;
        return page.substr(from, page.find("</annotation>") - from);
    };
    EXPECT_EQ(tex("y = `b`{.value}x + `b`{.value}"), "y = -2.5x + (-2.5)");
    EXPECT_EQ(tex("`b`{.value}^2 - `b`{.value} \\cdot `g`{.value}"), "(-2.5)^2 - (-2.5) \\cdot 2.5");
    EXPECT_EQ(tex("`g`{.value}^2, `t`{.value}^2"), "2.5^2, (1 \\cdot 10^{-7})^2");
    record_.values["c"] = {std::nullopt, "-1 + 2i"};
    EXPECT_EQ(tex("`c`{.value} \\cdot 2, `c`{.value}x, `c`{.value}"),
              "(-1 + 2\\,\\mathrm{i}) \\cdot 2, (-1 + 2\\,\\mathrm{i})x, -1 + 2\\,\\mathrm{i}");
    EXPECT_EQ(tex("x^`b`{.value}, x_`g`{.value}, \\sqrt`b`{.value}"), "x^{-2.5}, x_{2.5}, \\sqrt{-2.5}");
    EXPECT_EQ(tex("\\frac{`b`{.value}}{`g`{.value}}"), "\\frac{-2.5}{2.5}");
    EXPECT_EQ(tex("\\text{if `b`{.value} s}"), "\\text{if $-2.5$ s}");
    EXPECT_EQ(tex("\\text{the `quoted\' part}"), "\\text{the `quoted&#39; part}");  // as HTML writes it
}

// Oracle: the text that poppler reads, in PDFs of pages and slides.
TEST_F(slots, values_of_captions_formulas_and_headings_are_in_the_pdf) {
    add_figure("a", "", DocumentFormat::kPdf);
    record_.values["gain"] = {2.5, "2.50"};
    record_.values["low"] = {-1.5e-6, "-1.5e-06"};
    record_.values["odd"] = {std::nullopt, "50% & #1_$ {x} \\par ~^"};
    const std::string body =
        "# Heading `gain`{.value}\n\nWith $K = `gain`{.value}$ and $a = `low`{.value}$, $\\text{not} "
        "`odd`{.value}$.\n\n"
        "![Response with `gain`{.value} and `odd`{.value}](figure:a){#fig:a}\n";
    for (const char* header :
         {"---\ntitle: Of `gain`{.value}\n---\n", "---\ntitle: Of `gain`{.value}\nlayout: slides\n---\n"}) {
        std::string text;
        for (const std::string& page : inspect_pdf(make(header + body, "out.pdf")).pages) text += page;
        for (const char* words :
             {"Of 2.50", "Heading 2.50", "K = 2.50", "a = −1.5 · 10−6", "Response with 2.50 and 50% & #1_$ {x} \\par"})
            EXPECT_THAT(text, HasSubstr(words)) << header;
    }
}

TEST_F(slots, a_missing_value_is_reported_with_its_line_and_shown_as_gap_wherever_it_is) {
    record_.values["gain"] = {2.5, "2.5"};
    add_figure("a", "", DocumentFormat::kHtml);
    for (const char* place :
         {"$x = `gian`{.value}$", "![A `gian`{.value}](figure:a)", "| a |\n|---|\n| `gian`{.value} |",
          "# H `gian`{.value}", "$$ \\text{a `gian`{.value}} $$", "- i `gian`{.value}"}) {
        const std::string text = std::string("One.\n\n") + place + "\n";
        EXPECT_THAT(refusal(text), HasSubstr("the script reported no value \"gian\"; did you mean \"gain\"?")) << place;
        const auto [gaps, page] = draft(text);
        EXPECT_THAT(gaps, ContainsRegex("report.md:[35]: the script reported no value")) << place;
        EXPECT_THAT(read_from(page), HasSubstr("??")) << place;
    }
}

TEST_F(slots, what_is_no_slot_is_reported_with_its_line_and_the_right_form) {
    record_.values["gain"] = {2.5, "2.5"};
    const std::string before = "Right: `gain`{.value}.\n\n```\n`gain` {.value}\n```\n\n";
    EXPECT_THAT(refusal(before + "A `gain` {.value}\n"),
                HasSubstr("report.md:7: \"`gain` {.value}\" is not a value slot; write `name`{.value}"));
    EXPECT_THAT(refusal(before + "A 'gain'{.value}\n"), HasSubstr("report.md:7: \"'{.value}\" is not a value slot"));
    EXPECT_THAT(refusal(before + "$K = `gain`$\n"), HasSubstr("report.md:1: the formula contains `gain`"));
    EXPECT_THAT(refusal(before + "$K = `gain`{.valeu}$\n"), HasSubstr("the slot `gain`{.valeu} has an unknown class"));
    EXPECT_THAT(refusal(before + "[a](https://x.org/`gain`{.value})\n"), HasSubstr("is not filled in"));
    EXPECT_THAT(refusal(before + "![a](`gain`{.value}.png)\n"), HasSubstr("is not filled in"));
}

// Oracle: lines counted by hand.
TEST_F(slots, messages_name_the_line_of_the_text_and_not_of_a_comment_or_of_a_longer_name) {
    add_figure("ab", "", DocumentFormat::kHtml);
    EXPECT_THAT(refusal("<!-- write `x`{.value}\nor `x`{.value} -->\n\n`x`{.value}\n"), HasSubstr("report.md:4: "));
    EXPECT_THAT(refusal("```\n`x`{.value}\n```\n\n`x`{.value}\n"), HasSubstr("report.md:5: "));
    EXPECT_THAT(refusal("![A](figure:ab)\n\n![A](figure:a)\n"), HasSubstr("report.md:3: "));
    EXPECT_THAT(refusal("![A](figure:ab){#fig:a-b}\n\nSee @fig:a-b.\n\nSee @fig:a.\n"), HasSubstr("report.md:5: "));
}

TEST_F(slots, a_picture_that_was_pasted_into_a_notebook_is_a_gap_with_a_remedy) {
    const auto [gaps, page] =
        draft("# Rig\n\n![image.png](attachment:image.png)\n\nAnd ![x](attachment:b.png) here.\n");
    EXPECT_THAT(gaps, HasSubstr("report.md:3: the picture \"image.png\" was pasted into the notebook"));
    EXPECT_THAT(gaps, HasSubstr("report.md:5: the picture \"b.png\""));
    EXPECT_THAT(gaps, HasSubstr("Save the picture as a file next to the notebook"));
    EXPECT_THAT(page, HasSubstr("??"));
}

// Oracle: the files that are there. No message names a folder: it may be one that only the program has.
TEST_F(slots, pictures_are_found_by_paths_of_all_forms) {
    const auto draw = [&](const std::string& name) { write(name, small_svg()); };
    for (const char* name :
         {"rig.svg", "my rig.svg", "Übersicht.svg", "a_b.svg", "img/deep/x.svg", "rig (1).svg", "50%.svg"})
        draw(name);
    for (const char* shown :
         {"![R](rig.svg)", "![R](my rig.svg)", "![R](<my rig.svg>)", "![R](my%20rig.svg)", "![R](Übersicht.svg)",
          "![R](a_b.svg)", "![R](a\\_b.svg)", "![R](img/deep/x.svg)", "![R](./rig.svg \"Title\")",
          "![R][p]\n\n[p]: rig.svg", "![R](rig (1).svg)", "![R](50%25.svg)"})
        EXPECT_EQ(refusal(std::string(shown) + "\n"), "") << shown;
    for (const char* missing : {"![R](none.svg)", "![R](img/none.svg)", "![R](Rig.svg)"}) {
        const std::string message = refusal(std::string("One.\n\n") + missing + "\n");
        EXPECT_THAT(message,
                    AllOf(HasSubstr("report.md:3: the picture \""), HasSubstr("is not in the folder of this file"),
                          Not(HasSubstr(folder_.path().string()))))
            << missing;
    }
    EXPECT_THAT(refusal("![R](../out.svg)\n"), HasSubstr("is outside the folder"));
}

TEST_F(slots, a_table_has_its_caption_and_numbers_to_the_right) {
    record_.tables["models"] = {{"Model", "Fit", "Printed"}, {{"P1 *", "-93.2", "−3"}, {"P2", "7", "4"}}};
    const std::string text = html("::: {.table name=models}\nTwo models. {#tbl:models}\n:::\n\nSee @tbl:models.\n");
    EXPECT_THAT(text, HasSubstr("<strong>Table 1.</strong> Two models.</caption>"));
    EXPECT_THAT(text, HasSubstr("<td style=\"text-align: right;\">−93.2</td>"));
    EXPECT_THAT(text, HasSubstr("<td style=\"text-align: right;\">−3</td>")) << "a minus as it is printed";
    EXPECT_THAT(text, HasSubstr("<td style=\"text-align: left;\">P1 *</td>"));
    EXPECT_THAT(text, HasSubstr("<a href=\"#tbl:models\">Table 1</a>"));
}

TEST_F(slots, a_figure_takes_the_scripts_caption_unless_the_template_has_one) {
    add_figure("raw", "Raw *data*", DocumentFormat::kHtml);
    const std::string text = html("![](figure:raw){#fig:raw}\n\n![My own](figure:raw){#fig:own}\n");
    EXPECT_THAT(text, HasSubstr("<strong>Figure 1.</strong> Raw <em>data</em></figcaption>"));
    EXPECT_THAT(text, HasSubstr("<strong>Figure 2.</strong> My own</figcaption>"));
    EXPECT_THAT(text, HasSubstr("alt=\"Raw data\""));
    EXPECT_THAT(text, HasSubstr("src=\"data:image/svg+xml;base64,"));
}

TEST_F(slots, a_text_is_markdown_with_slots_and_references_of_its_own) {
    record_.values["fit"] = {93.2, "93.2"};
    record_.texts["end"] = {"All **good**: `fit`{.value}, @eq:m."};
    const std::string text = html("$$ y = x $$ {#eq:m}\n\n::: {.text name=end}\n:::\n");
    EXPECT_THAT(text, HasSubstr("All <strong>good</strong>: 93.2, <a href=\"#eq:m\">Equation 1</a>."));
}

TEST_F(slots, a_list_may_follow_a_line_of_text_at_once) {
    const std::string bullets = html("Much:\n- one *x*\n  and more\n- two\n");
    EXPECT_THAT(bullets, HasSubstr("<p>Much:</p>"));
    EXPECT_THAT(bullets, ContainsRegex("<li>one <em>x</em>\\s+and more</li>\\s*<li>two</li>\\s*</ul>"));
    EXPECT_THAT(html("Steps:\n1. one\n2. two\n"), ContainsRegex("<ol[^>]*>\\s*<li>one</li>\\s*<li>two</li>\\s*</ol>"));
    EXPECT_THAT(html("Steps:\n1. one\n- sub\n2. two\n"), ContainsRegex("<li>one\\s+- sub</li>\\s*<li>two</li>"));
    EXPECT_THAT(html("Seen:\n- in\n2010. It\n"), ContainsRegex("<li>in\\s+2010. It</li>"));
    for (const char* text : {"In the year\n1896. Then\n", "From 3\n– 4 of them\n", "It is $x\n- y$.\n", "a-\nb - c\n"})
        EXPECT_THAT(html(text), Not(HasSubstr("<li>"))) << text;
}

TEST_F(slots, an_entry_that_is_missing_is_named_with_the_nearest_name_and_the_line) {
    record_.values["fit"] = {93.2, "93.2"};
    EXPECT_THAT(refusal("Text\n\nThe `fti`{.value}.\n"),
                HasSubstr("report.md:3: the script reported no value \"fti\"; did you mean \"fit\"?"));
    EXPECT_THAT(refusal("![A](figure:raw){#fig:raw}\n"),
                HasSubstr("report.md:1: the script reported no figure \"raw\""));
    EXPECT_THAT(refusal("::: {.table name=models}\n:::\n"),
                HasSubstr("report.md:1: the script reported no table \"models\""));
    EXPECT_THAT(refusal("::: {.text name=end}\n:::\n"), HasSubstr("report.md:1: the script reported no text \"end\""));
}

TEST_F(slots, a_script_that_stopped_leaves_gaps_with_names_and_its_error_first) {
    record_.error = RecordedError{Message("unknown function '{}'", "f`oo"), "analysis.lua", 10};
    record_.values["fit"] = {93.2, "93.2"};
    const std::string text = html(
        "Fit `fit`{.value}, later `late`{.value}, @fig:raw.\n\n![A](figure:raw){#fig:raw}\n\n"
        "::: {.table name=models}\n:::\n\n::: {.text name=end}\n:::\n");
    EXPECT_THAT(text, HasSubstr("<pre class=\"error\"><code>analysis.lua:10: unknown function 'f`oo'"));
    EXPECT_LT(text.find("analysis.lua:10"), text.find("Fit 93.2"));
    EXPECT_THAT(text, HasSubstr("Fit 93.2, later <strong>[late]</strong>, fig:raw."));
    for (const char* name : {"raw", "models", "end"})
        EXPECT_THAT(text, HasSubstr("<strong>[" + std::string(name) + " is not there yet]"));
}

TEST_F(slots, an_entry_of_another_kind_is_named_with_its_kind) {
    record_.tables["fit"] = {{"a"}, {{"1"}}};
    EXPECT_THAT(refusal("`fit`{.value}\n"),
                HasSubstr("report.md:1: \"fit\" is a table in the run results, but this slot expects a value"));
    record_.tables.clear();
    record_.values["raw"] = {1.0, "1"};
    EXPECT_THAT(refusal("![A](figure:raw)\n"), HasSubstr("\"raw\" is a value"));
}

TEST_F(slots, unknown_classes_are_errors_that_name_the_slot) {
    EXPECT_THAT(refusal("`fit`{.valeu}\n"), HasSubstr("report.md:1: the slot `fit`{.valeu} has an unknown class"));
    EXPECT_THAT(refusal("::: {.tabel name=x}\n:::\n"), HasSubstr("did you mean \"table\"?"));
    EXPECT_THAT(refusal("[text]{.small}\n"), HasSubstr("\"small\""));
    EXPECT_THAT(refusal("```{.brainfuck}\nx\n```\n"), HasSubstr("\"brainfuck\""));
}

TEST_F(slots, a_figure_inside_a_sentence_is_refused_not_misplaced) {
    add_figure("raw", "Raw", DocumentFormat::kHtml);
    EXPECT_THAT(refusal("See ![A](figure:raw) here.\n"), HasSubstr("must be separate"));
}

TEST_F(slots, a_figure_that_was_never_drawn_or_whose_file_is_gone_is_an_error) {
    record_.figures["raw"].caption = "Raw";
    EXPECT_THAT(refusal("![](figure:raw)\n"), HasSubstr("report.md:1: the figure \"raw\" was not drawn"));
    record_.figures["raw"].file = file("gone.svg");
    EXPECT_THAT(refusal("![](figure:raw)\n"), HasSubstr("gone.svg does not exist"));
}

TEST_F(slots, every_mistake_is_reported_at_once_up_to_ten) {
    std::string text;
    for (int i = 0; i < 12; ++i) text += "`name" + std::to_string(i) + "`{.value}\n\n";
    const std::string message = refusal(text);
    EXPECT_THAT(message, HasSubstr("report.md:1: "));
    EXPECT_THAT(message, HasSubstr("report.md:19: "));
    EXPECT_THAT(message, HasSubstr("and 2 more"));
}

TEST_F(slots, comments_never_reach_the_document) {
    const std::string text = html("One <!-- secret --> two.\n\n<!-- secret\nblock -->\n\nThree.\n");
    EXPECT_THAT(text, Not(HasSubstr("secret")));
    EXPECT_THAT(text, HasSubstr("Three."));
}

TEST_F(slots, mistakes_in_woven_cells_name_the_script) {
    cells_.append("text `nothing`{.value}\n", "lesson.lua", 42);
    EXPECT_THAT(refusal("# T\n\n::: {.cells}\n:::\n"), HasSubstr("lesson.lua:42: the script reported no value"));
}

// Oracle: the same blocks outside of a box.
TEST_F(slots, boxes_hold_figures_and_tables) {
    add_figure("raw", "Raw data", DocumentFormat::kPdf);
    record_.tables["models"] = {{"model", "fit"}, {{"first", "93"}}};
    const std::string blocks =
        "![](figure:raw){#fig:raw}\n\nSee @fig:raw.\n\n::: {.table name=models}\nAll of them.\n:::\n";
    const std::string plain = inspect_pdf(make(blocks, "plain.pdf")).pages.at(0);
    const std::string boxed = inspect_pdf(make("::: note\n" + blocks + ":::\n", "boxed.pdf")).pages.at(0);
    for (const char* shown : {"Figure 1. Raw data", "See Figure 1.", "Table 1. All of them.", "first"}) {
        EXPECT_THAT(plain, HasSubstr(shown));
        EXPECT_THAT(boxed, HasSubstr(shown));
    }
}

}  // namespace test_slots
}  // namespace dynlab
