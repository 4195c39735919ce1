#pragma once
#include <functional>

#include "base/reader.h"
#include "check_fixture.h"
#include "course/anonymity/identity_matcher.h"

namespace dynlab {

/// Documents with names in them, made with pdflatex, qpdf and bytes written into the file.
class LeakCorpus : public CheckTest {
  protected:
    LeakCorpus() {
        standard_ = DocumentStandard();
        names_ = std::make_shared<IdentityMatcher>();
        const auto know = [this](const char* id, const char* name, const char* group, const char* mail) {
            Student student;
            student.id = id;
            student.name = name;
            student.group = group;
            student.mail = mail;
            names_->add(student);
        };
        know("20214711", "Zoé Brandtner", "group-07", "zoe.brandtner@uni.example");
        know("e45678", "Jürgen Müllhauser", "group-08", "jm4567@uni.example");
        know("1007", "Anna Griffistone", "group-09", "");
        know("20215555", "Li Wu", "group-10", "");
        know("20216666", "May Park", "group-11", "");
        know("20217777", "Jean-Pierre O'Marrec", "group-12", "");
        know("20218888", "Ольга Петровская", "group-13", "");
        know("20219999", "Mark Young", "group-14", "young@uni.example");
    }

    std::filesystem::path latex(const std::string& preamble, const std::string& body, const std::string& name = "own",
                                const std::string& fonts = "\\usepackage[T1]{fontenc}\\usepackage{lmodern}") {
        write(name + ".tex", "\\documentclass[11pt,a4paper]{article}" + fonts + "\n" + preamble +
                                 "\\begin{document}\n" + body + "\\end{document}\n");
        run({"pdflatex", "-interaction=batchmode", "-no-shell-escape", name + ".tex"});
        return file(name + ".pdf");
    }
    /// One page of prose, and what `code` puts into the file.
    std::filesystem::path prose_with(const std::string& code, const std::string& name = "own") {
        return latex("\\pdfcompresslevel=0\\pdfobjcompresslevel=0\n", kProse + code, name);
    }

    void run(const std::vector<std::string>& command) {
        ChildOptions child;
        child.command = command;
        child.folder = folder_.path();
        const ChildResult result = run_child(child, command.front());
        EXPECT_EQ(result.exit_code, 0) << command.front() << ": " << result.error_output << result.output;
    }

    std::string text_of(const std::string& pdf) {
        run({"pdftotext", pdf, "text.txt"});
        return read(file("text.txt"));
    }

    /// What is found about names, as "id page"; hints in brackets.
    std::vector<std::string> found(const std::filesystem::path& pdf) const {
        CheckOptions check_options;
        check_options.standard = standard_;
        check_options.names = names_;
        std::vector<std::string> result;
        for (const Issue& issue : check_pdf(pdf, check_options).findings) {
            const bool of_names = issue.id.starts_with("name") || issue.id == "author-named" ||
                                  issue.id.starts_with("not-search") || issue.id == "damaged";
            if (!of_names) continue;
            expect_french_text({issue});
            EXPECT_TRUE(message_text(issue.what).ends_with('.')) << message_text(issue.what);
            EXPECT_TRUE(message_text(issue.remedy).ends_with('.')) << message_text(issue.remedy);
            const std::string words = issue.id + " " + std::to_string(issue.page);
            result.push_back(issue.severity == Severity::kRule ? words : "(" + words + ")");
        }
        return result;
    }

    /// A PDF of these objects, from 1 on, the catalog first.
    static std::string pdf_of(const std::vector<std::string>& objects) {
        std::string pdf = "%PDF-1.4\n";
        std::string table = "xref\n0 " + std::to_string(objects.size() + 1) + "\n0000000000 65535 f \n";
        for (std::size_t i = 0; i < objects.size(); ++i) {
            char line[32];
            std::snprintf(line, sizeof line, "%010zu 00000 n \n", pdf.size());
            table += line;
            pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
        }
        return pdf + table + "trailer<</Size " + std::to_string(objects.size() + 1) + "/Root 1 0 R>>\nstartxref\n" +
               std::to_string(pdf.size()) + "\n%%EOF\n";
    }
    static std::string stream_of(const std::string& data, const std::string& entries = "") {
        return "<<" + entries + "/Length " + std::to_string(data.size()) + ">>\nstream\n" + data + "\nendstream";
    }

    /// An update appended to a file, in which object `number` is `object`; the old one stays in the file.
    static std::string updated(const std::string& pdf, int number, const std::string& object) {
        const std::string start = pdf.substr(pdf.rfind("startxref") + 10);
        const std::string root = reference(pdf, "/Root");
        std::string result = pdf;
        const std::size_t at = result.size();
        result += std::to_string(number) + " 0 obj\n" + object + "\nendobj\n";
        const std::size_t table = result.size();
        char line[32];
        std::snprintf(line, sizeof line, "%010zu 00000 n \n", at);
        return result + "xref\n" + std::to_string(number) + " 1\n" + line + "trailer\n<</Size 1000/Root " + root +
               "/Prev " + std::to_string(std::stoul(start)) + ">>\nstartxref\n" + std::to_string(table) + "\n%%EOF\n";
    }
    /// "12 0 R" behind the last `key`.
    static std::string reference(const std::string& pdf, const std::string& key) {
        const std::size_t begin = pdf.find_first_of("0123456789", pdf.rfind(key + " "));
        return pdf.substr(begin, pdf.find('R', begin) + 1 - begin);
    }

    /// One page of this content, with a font F1 (Helvetica), a form X0 and a layer L; further entries of catalog and
    /// page, objects from 6 on.
    std::filesystem::path page_with(const std::string& content, const std::string& catalog = "",
                                    const std::string& page = "", const std::vector<std::string>& more = {}) const {
        std::vector<std::string> objects = {
            "<</Type/Catalog/Pages 2 0 R" + catalog + ">>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
            "<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</Font<</F1 5 0 R>>/XObject<<"
            "/X0 6 0 R>>/Properties<</L 6 0 R>>>>" +
                page + ">>",
            stream_of(content), "<</Type/Font/Subtype/Type1/BaseFont/Helvetica>>"};
        objects.insert(objects.end(), more.begin(), more.end());
        write("own.pdf", pdf_of(objects));
        return file("own.pdf");
    }

    std::shared_ptr<IdentityMatcher> names_;
};

}  // namespace dynlab
