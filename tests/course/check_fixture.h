#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "base/reader.h"
#include "course/issues/document_issues.h"
#include "documents/document_fixture.h"
#include "french_text.h"
#include "platform/child_process.h"

namespace dynlab {

/// Documents with defects made on purpose, and what the check finds in them.
class CheckTest : public DocumentTest {
  protected:
    static constexpr const char* kTitles[] = {"Process",
                                              "Experiment design",
                                              "Raw data",
                                              "Pre-processing",
                                              "Choice of the model structure",
                                              "Parameter estimation",
                                              "Validation",
                                              "Conclusion"};
    static constexpr const char* kFrenchTitles[] = {"Procédé",
                                                    "Plan d'expériences",
                                                    "Données brutes",
                                                    "Prétraitement",
                                                    "Choix de la structure du modèle",
                                                    "Estimation des paramètres",
                                                    "Validation",
                                                    "Conclusion"};
    static constexpr const char* kProse =
        "The trolley was moved by the motor and its position was measured with an encoder, so that the model could be "
        "compared with what the rail had really seen. The swing of the load is small but it can be seen in the record, "
        "and this is the reason for which both outputs were kept.\n\n";
    static constexpr const char* kFrenchProse =
        "Le chariot est entraîné par un moteur et sa position est mesurée avec un codeur, ce qui permet de comparer le "
        "modèle avec les mesures. Le balancement de la charge est faible mais il est visible dans les données, et "
        "c'est pour cela que les deux sorties ont été gardées dans cette étude.\n\n";

    CheckTest() {
        std::string header = "---\npages: 6\nappendix_pages: 1\nsections: |\n";
        for (std::size_t i = 0; i < std::size(kTitles); ++i)
            header += std::string("  ") + kTitles[i] + " | " + kFrenchTitles[i] + "\n";
        write("lab.md", header + "  Appendix: control | Annexe : commande | optional\n---\n");
        standard_ = standard_of(file("lab.md"));
    }

    /// The Markdown of a report with eight sections. `extra` is below the heading `at`.
    static std::string english_report(const std::string& extra = "", const std::string& at = "Validation") {
        std::string text;
        for (const char* title : kTitles)
            text += std::string("# ") + title + "\n\n" + kProse + (title == at ? extra + "\n\n" : "");
        return text;
    }
    static std::string french_report() {
        std::string text;
        for (const char* title : kFrenchTitles) text += std::string("# ") + title + "\n\n" + kFrenchProse;
        return text;
    }

    /// What is found in a report made from Markdown by dynlab itself.
    CheckResult check_report(const std::string& markdown) { return check(make(markdown, "report.pdf")); }

    /// What is found in a document of pdflatex that dynlab's layout has nothing to do with.
    CheckResult check_latex(const std::string& preamble, const std::string& body) {
        return check_tex("\\documentclass[11pt,a4paper]{article}\\usepackage[T1]{fontenc}\\usepackage{lmodern}\n" +
                         preamble + "\\begin{document}\n" + body + "\\end{document}\n");
    }
    /// Pages of 128 mm by 96 mm, as beamer makes them; each has a title and a text.
    CheckResult check_slides(const std::vector<std::pair<std::string, std::string>>& slides) {
        std::string body;
        for (const auto& [title, text] : slides)
            body += "{\\Large " + title + "}\\par\\bigskip " + text + "\\newpage\n";
        return check_latex("\\usepackage[paperwidth=128mm,paperheight=96mm,margin=10mm]{geometry}\n\\parindent0pt\n",
                           body);
    }
    CheckResult check_tex(const std::string& source) {
        write("own.tex", source);
        ChildOptions latex;
        latex.command = {"pdflatex", "-interaction=batchmode", "-no-shell-escape", "own.tex"};
        latex.folder = folder_.path();
        EXPECT_EQ(run_child(latex, "texlive-latex-base").exit_code, 0) << read(file("own.log"));
        return check(file("own.pdf"));
    }

    CheckResult check(const std::filesystem::path& pdf) const { return check_pdf(pdf, {standard_, std::nullopt}); }

    static std::vector<std::string> ids(const CheckResult& result) {
        std::vector<std::string> found;
        expect_french_text(result.findings);
        for (const Issue& issue : result.findings) {
            EXPECT_TRUE(message_text(issue.what).ends_with('.')) << message_text(issue.what);
            EXPECT_TRUE(message_text(issue.remedy).ends_with('.')) << message_text(issue.remedy);
            found.push_back(issue.id);
        }
        return found;
    }

    static Issue only(const CheckResult& result, const std::string& id) {
        EXPECT_EQ(ids(result), std::vector<std::string>{id});
        return result.findings.empty() ? Issue() : result.findings.front();
    }

    std::optional<DocumentStandard> standard_;
};

}  // namespace dynlab
