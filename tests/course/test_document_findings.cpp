// Every issue in a document that has the defect, and none in a document without it. Oracle: how the document was made.
#include <gmock/gmock.h>

#include "check_fixture.h"
#include "course/issues/issues_report.h"
#include "course/issues/text_issues.h"
#include "platform/atomic_file.h"
#include "support/message_texts.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_document_findings {

using test::inspect_pdf;
using test::texts_of;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class document_findings : public CheckTest {};

constexpr const char* kFigure = "![A step](figure:raw){#fig:raw}\n\n";

TEST_F(document_findings, a_sound_report_has_none_and_the_summary_says_what_was_looked_at) {
    add_figure("raw", "A step", DocumentFormat::kPdf);
    const CheckResult result = check_report("---\ntitle: The crane\nnumbersections: true\n---\n" +
                                            english_report(kFigure + std::string("See @fig:raw.")));
    EXPECT_THAT(ids(result), IsEmpty());
    EXPECT_TRUE(result.passed());
    EXPECT_EQ(result.language, "en");
    EXPECT_THAT(texts_of(result.checked), Contains("9 sections"));
    EXPECT_THAT(texts_of(result.checked), Contains("1 numbered figure"));
    EXPECT_THAT(texts_of(result.checked), Contains("English only"));
    EXPECT_THAT(texts_of(result.checked), Contains(HasSubstr("(limit: 6, plus 1 in the appendix)")));
}

TEST_F(document_findings, a_sound_french_report_has_none) {
    standard_->language = "fr";
    const CheckResult result = check_report("---\ntitle: La grue\n---\n" + french_report());
    EXPECT_THAT(ids(result), IsEmpty());
    EXPECT_EQ(result.language, "fr");
    EXPECT_THAT(texts_of(result.checked), Contains("French only"));
}

TEST_F(document_findings, own_wordings_of_headings_are_understood) {
    std::string body;
    for (const char* title : {"Short description of the process", "Design of the experiment",
                              "Description of the raw dataset", "Data pre-processing", "Model structure selection",
                              "Estimation of the parameters", "Model validation", "Conclusions"})
        body += std::string("\\section{") + title + "}\n" + kProse;
    EXPECT_THAT(ids(check_latex("", "\\title{Process and validation}\\author{}\\date{}\\maketitle\n" + body)),
                IsEmpty());
}

TEST_F(document_findings, a_missing_section_is_named_in_the_documents_language) {
    std::string text = english_report();
    text.erase(text.find("# Raw data"), text.find("# Pre-processing") - text.find("# Raw data"));
    const Issue missing = only(check_report(text), "section-missing");
    EXPECT_THAT(message_text(missing.what), HasSubstr("\"Raw data\""));
    EXPECT_EQ(missing.severity, Severity::kRule);

    text = french_report();
    text.erase(text.find("# Données brutes"), text.find("# Prétraitement") - text.find("# Données brutes"));
    EXPECT_THAT(message_text(only(check_report(text), "section-missing").what), HasSubstr("Données brutes"));
}

TEST_F(document_findings, empty_and_short_sections_are_distinguished) {
    std::string text = english_report();
    const std::size_t start = text.find("# Raw data"), end = text.find("# Pre-processing");
    const Issue empty =
        only(check_report(std::string(text).replace(start, end - start, "# Raw data\n\n")), "section-empty");
    EXPECT_EQ(empty.page, 1);
    EXPECT_THAT(message_text(empty.what), HasSubstr("\"Raw data\" is empty"));
    const CheckResult result = check_report(std::string(text).replace(
        start, end - start, "# Raw data\n\nThe data are good and they were used as such.\n\n"));
    EXPECT_THAT(message_text(only(result, "section-short").what), HasSubstr("10 words"));
    EXPECT_TRUE(result.passed());
    EXPECT_THAT(ids(check_report(std::string(text).replace(start, end - start,
                                                           std::string("# Raw data\n\n## The record\n\n") + kProse))),
                IsEmpty());
    EXPECT_THAT(ids(check_report(text + "# Appendix: control\n")), ElementsAre("section-empty"));
}

TEST_F(document_findings, a_form_that_was_not_filled_in_has_all_its_sections_empty) {
    std::string text = "---\ntitle: Identification of a trolley crane\n---\n";
    for (const char* title : kTitles) text += std::string("# ") + title + "\n\n";
    EXPECT_EQ(ids(check_report(text)), std::vector<std::string>(std::size(kTitles), "section-empty"));
}

TEST_F(document_findings, pages_beyond_the_limit_count_and_an_appendix_has_its_own) {
    const std::string page = "\n::: {.pagebreak}\n:::\n\nThis is one of the pages that were added for the test.\n";
    std::string text = english_report();
    const auto pages = [&](int more, const std::string& then = "") {
        std::string longer = text;
        for (int i = 0; i < more; ++i) longer += page;
        return check_report(longer + then);
    };
    const int own = check_report(text).pages;
    EXPECT_THAT(ids(pages(6 - own)), IsEmpty());
    const Issue seven = only(pages(7 - own), "pages");
    EXPECT_EQ(seven.page, 7);
    EXPECT_THAT(message_text(seven.what), HasSubstr("has 7 pages; at most 6 pages, and 1 page in the appendix"));
    EXPECT_THAT(message_text(seven.remedy), HasSubstr("heading \"Appendix\""));
    const std::string appendix = std::string("\n::: {.pagebreak}\n:::\n\n# Appendix: control\n\n") + kProse;
    EXPECT_THAT(ids(pages(6 - own, appendix)), IsEmpty());
    EXPECT_EQ(only(pages(7 - own, appendix), "pages").page, 8);
    EXPECT_THAT(ids(check_pdf(file("report.pdf"), {standard_, 8})), IsEmpty());
    EXPECT_THAT(ids(check_pdf(file("report.pdf"), {standard_, 7})), ElementsAre("pages"));
}

TEST_F(document_findings, a_figure_that_is_never_mentioned_is_found_in_every_caption_style) {
    add_figure("raw", "A step", DocumentFormat::kPdf);
    const Issue issue = only(check_report(english_report(kFigure)), "figure-not-mentioned");
    EXPECT_EQ(message_text(issue.what), "The text does not mention figure 1.");
    const std::vector<std::string> pages = inspect_pdf(file("report.pdf")).pages;
    EXPECT_THAT(pages.at(static_cast<std::size_t>(issue.page) - 1), HasSubstr("Figure"));

    standard_ = DocumentStandard();
    std::string captions, mentions;
    std::vector<std::string> every_figure;
    for (const char* sign : {":", ".", " --"})
        for (const char* name : {"Figure", "Fig.", "FIGURE"}) {
            const std::string number = std::to_string(every_figure.size() + 1);
            captions += "\\begin{center}\\rule{3cm}{1cm}\n\n " + std::string(name) + " " + number + sign +
                        " The response to a step\\end{center}\n\n";
            mentions += "As Fig.~" + number + " shows, it is slow. ";
            every_figure.push_back("The text does not mention figure " + number + ".");
        }
    std::vector<std::string> unmentioned;
    for (const Issue& one : check_latex("", kProse + captions + kProse).findings) {
        EXPECT_EQ(one.id, "figure-not-mentioned");
        unmentioned.push_back(message_text(one.what));
    }
    EXPECT_THAT(unmentioned, testing::ElementsAreArray(every_figure));
    EXPECT_THAT(ids(check_latex("", mentions + kProse + captions + kProse)), IsEmpty());
}

TEST_F(document_findings, lists_and_ranges_of_figures_mention_all_of_them) {
    standard_ = DocumentStandard();
    std::string captions;
    for (int i = 1; i <= 6; ++i)
        captions += "\\begin{figure}[h]\\centering\\rule{2cm}{1cm}\\caption{A response}\\end{figure}\n\n";
    const auto found = [&](const std::string& sentence) {
        std::vector<std::string> missing;
        for (const Issue& issue : check_latex("", kProse + sentence + "\n\n" + captions).findings)
            missing.push_back(message_text(issue.what));
        return missing;
    };
    EXPECT_THAT(found("See Figures 1, 2 and 3, Figs. 4--5 and figure~6."), IsEmpty());
    EXPECT_THAT(found("Voir les figures 1 \\`a 4, et (Fig. 6b)."), ElementsAre("The text does not mention figure 5."));
    EXPECT_THAT(found("Figure 1 shows 2 steps. Figures 5 et 6."),
                ElementsAre("The text does not mention figure 2.", "The text does not mention figure 3.",
                            "The text does not mention figure 4."));
    EXPECT_THAT(found("Figures 1 to 6, but also Figure 9."),
                ElementsAre("The text mentions figure 9, but no figure has this number."));
}

TEST_F(document_findings, what_was_left_unfilled_is_quoted_with_its_page) {
    const std::pair<const char*, const char*> leftovers[] = {
        {"The fit is \\{.value} percent.", "slot-unfilled"},
        {"See @@fig:raw for this.", "slot-unfilled"},
        {"This is shown in Figure ?? of it.", "reference-unresolved"},
        {"TODO: say more of this.", "placeholder-left"},
        {"The gain is \\_\\_\\_\\_\\_ here.", "placeholder-left"},
        {"Lorem ipsum dolor sit amet.", "placeholder-left"}};
    standard_ = DocumentStandard();
    std::string body = kProse;
    std::vector<std::string> expected;
    for (const auto& [sentence, id] : leftovers) {
        body += "\\newpage\n" + replaced(replaced(sentence, "\\{.value}", "\\{.value\\}"), "@@", "@") + "\n\n";
        expected.push_back(std::string(id) + " " + std::to_string(expected.size() + 2));
    }
    std::vector<std::string> found;
    for (const Issue& issue : check_latex("", body).findings) {
        found.push_back(issue.id + " " + std::to_string(issue.page));
        EXPECT_EQ(issue.severity, Severity::kRule);
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
    EXPECT_THAT(ids(check_latex(
                    "", std::string(kProse) + "\\texttt{local x = f(a ?? b) -- TODO}\n\nThe mastodon is a word.\n")),
                IsEmpty());
}

TEST_F(document_findings, guidance_of_the_template_must_not_be_printed) {
    standard_ = DocumentStandard{
        "mine", {}, guidance_of("# A\n\n<!-- What moves the process, and what is measured on it? Be brief. -->\n"), {}};
    const std::string sentence = "What moves the process, and what is measured on it?\n";
    const Issue issue = only(check_latex("", kProse + ("\\newpage\n" + sentence)), "guidance-left");
    EXPECT_THAT(message_text(issue.what), HasSubstr("What moves the process"));
    EXPECT_EQ(issue.page, 2);
    for (const std::string& other : {std::string("Be brief. What moves it is measured.\n"), "Some" + sentence})
        EXPECT_THAT(ids(check_latex("", kProse + other)), IsEmpty()) << other;
}

// oracle: the same document, read before
TEST_F(document_findings, a_process_that_is_prepared_for_many_documents_finds_the_same) {
    const auto found = [&] { return check_latex("", std::string(kProse) + "See figure ?? of \\textbf{all}.\n"); };
    const std::string before = issues_as_json(found());
    EXPECT_THAT(before, HasSubstr("reference-unresolved"));
    prepare_to_read_pdfs();
    prepare_to_read_pdfs();
    EXPECT_EQ(issues_as_json(found()), before);
}

TEST_F(document_findings, guidance_of_the_french_template_must_not_be_printed_either) {
    for (const char* name : {"lab_report", "slides", "peer_review"}) {
        const std::string folder = DYNLAB_SOURCE_DIR "/report_templates/", text = read_file(folder + name + ".fr.md");
        const std::vector<std::string> both = standard_of(name).guidance;
        for (const std::string& sentence : guidance_of(text)) EXPECT_THAT(both, testing::Contains(sentence)) << name;
        EXPECT_GT(both.size(), guidance_of(text).size()) << "and the English one";
        // Both languages demand the same sections and pages.
        const DocumentRules rules = standard_of(name).rules,
                            french = document_rules(read_template(folder + name + ".fr.md"));
        ASSERT_EQ(french.sections.size(), rules.sections.size());
        for (std::size_t i = 0; i < rules.sections.size(); ++i) {
            EXPECT_EQ(french.sections[i].french, rules.sections[i].french);
            if (rules.sections[i].optional) continue;
            EXPECT_THAT(text, HasSubstr("\n# " + rules.sections[i].french));
        }
        EXPECT_EQ(french.pages, rules.pages);
    }
    try {
        standard_of("novel");
        FAIL();
    } catch (const EnvironmentError& error) {
        EXPECT_THAT(error.what(), testing::Not(HasSubstr("slides.fr")));
    }
}

TEST_F(document_findings, a_passage_in_the_other_language_is_a_hint_with_its_page) {
    const CheckResult result = check_report(english_report(kFrenchProse));
    const Issue issue = only(result, "language-mixed");
    EXPECT_EQ(issue.severity, Severity::kHint);
    EXPECT_THAT(message_text(issue.what), HasSubstr("seems to be in French: \""));
    EXPECT_TRUE(result.passed());
    EXPECT_THAT(message_text(only(check_report(french_report() + kProse), "language-mixed").what),
                HasSubstr("seems to be in English"));
    EXPECT_THAT(
        ids(check_report(english_report("A term such as *mise en \u0153uvre* or *coup de force* is none, nor is the "
                                        "title *Identification des syst\u00E8mes* in a reference."))),
        IsEmpty());
    const std::string title =
        "Discovering the equations of the systems that we have, and what is to be found in the data by "
        "the sparse identification of them";
    EXPECT_THAT(ids(check_report(french_report() + "\n\nDans « " + title + " », 2016.\n")), IsEmpty());
    EXPECT_THAT(message_text(only(check_report(french_report() + "\n\n" + title + ".\n"), "language-mixed").what),
                HasSubstr("English"));
    standard_->language = "fr";
    EXPECT_THAT(message_text(only(check_report(english_report()), "language-differs").what), HasSubstr("lang: fr"));
}

TEST_F(document_findings, small_text_and_narrow_margins_break_the_rules) {
    standard_ = DocumentStandard();
    std::string prose;
    for (int i = 0; i < 4; ++i) prose += kProse;
    EXPECT_THAT(ids(check_latex("", prose)), IsEmpty());
    EXPECT_THAT(ids(check_latex("\\usepackage[margin=16mm]{geometry}", prose)), IsEmpty());
    EXPECT_THAT(ids(check_latex("", "\\small " + prose)), IsEmpty());
    EXPECT_THAT(message_text(only(check_latex("", "\\footnotesize " + prose), "text-small").what), HasSubstr("9.0 pt"));
    EXPECT_EQ(only(check_latex("", prose + "\\newpage\\scriptsize " + prose), "text-small").page, 2);
    EXPECT_EQ(only(check_latex("\\usepackage[margin=8mm]{geometry}", prose), "margins").severity, Severity::kRule);
    EXPECT_THAT(ids(check_latex("\\usepackage[left=12mm,right=25mm]{geometry}", prose)), ElementsAre("margins"));
}

TEST_F(document_findings, a_line_in_the_margin_is_a_hint_and_over_the_edge_a_rule) {
    standard_ = DocumentStandard();
    const CheckResult overflow =
        check_latex("", kProse +
                            std::string("\\mbox{This line is much longer than the width of the text and it can not be "
                                        "broken since it stands in a box.}\n\n") +
                            kProse);
    EXPECT_THAT(message_text(only(overflow, "text-overflow").what), HasSubstr("This line is much longer"));
    EXPECT_THAT(
        ids(check_latex("", kProse + std::string("\\hspace*{13.4cm}\\mbox{Ausserordentlichlang}\n\n") + kProse)),
        Contains("text-cut-off"));
}

TEST_F(document_findings, slides_are_held_against_their_own_limits) {
    standard_ = DocumentStandard{"slides", {{{"Process", "Procédé"}, {"Validation", "Validation"}}, 3, {}}, {}, {}};
    const std::string text =
        "The thruster was driven by a chirp, and the force was measured by a load cell on the arm.";
    using Slides = std::vector<std::pair<std::string, std::string>>;
    const auto found = [&](Slides slides, const std::pair<std::string, std::string>& last) {
        slides.push_back(last);
        return check_slides(slides);
    };
    const Slides one = {{"The process", text}}, four(4, {"The process", text});
    EXPECT_THAT(ids(found(one, {"Validation of the model", text})), IsEmpty());
    EXPECT_THAT(ids(found(one, {"Raw data", text})), ElementsAre("section-missing"));
    EXPECT_EQ(only(found(one, {"Validation", "None."}), "section-empty").page, 2);
    EXPECT_THAT(message_text(only(found(four, {"Validation", text}), "pages").what),
                HasSubstr("has 5 slides; at most 3 slides are allowed"));
    std::string much;
    for (int i = 0; i < 6; ++i) much += text + " ";
    EXPECT_EQ(only(found(one, {"Validation", "\\tiny " + much}), "text-small").page, 2);
}

TEST_F(document_findings, without_an_option_pages_and_headings_determine_the_kind) {
    const auto known = [](const std::string& name) {
        return std::filesystem::exists(DYNLAB_SOURCE_DIR "/report_templates/" + name + ".md") ? name : "";
    };
    check_latex("", kProse);
    EXPECT_EQ(check_pdf(file("own.pdf")).template_name, known("lab_report"));
    const auto with_headings = [&](const std::vector<const char*>& titles) {
        std::string body;
        for (const char* title : titles) body += std::string("\\section{") + title + "}\n" + kProse;
        check_latex("", body);
        return check_pdf(file("own.pdf")).template_name;
    };
    EXPECT_EQ(with_headings({"Process", "Raw data", "Validation", "Conclusions", "Suggestions"}), known("lab_report"));
    EXPECT_EQ(with_headings({"Data and experiments", "Steps of the identification", "Suggestions"}),
              known("peer_review"));
    EXPECT_EQ(with_headings({"Principale qualité", "Conclusions", "Suggestions"}), known("peer_review"));
    check_slides({{"Process", "A chirp."}});
    EXPECT_EQ(check_pdf(file("own.pdf")).template_name, known("slides"));
}

}  // namespace test_document_findings
}  // namespace dynlab
