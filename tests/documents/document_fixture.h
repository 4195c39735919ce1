#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "documents/document.h"
#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/temporary_folder.h"

namespace dynlab {

/// A folder with a template and run results, from which a test makes documents.
class DocumentTest : public testing::Test {
  protected:
    DocumentTest() {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        record_.script = "analysis.lua";
    }

    std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

    void write(const std::string& name, const std::string& content) const {
        std::filesystem::create_directories(file(name).parent_path());
        std::ofstream(file(name), std::ios::binary) << content;
    }

    static std::string read(const std::filesystem::path& path) {
        std::ostringstream content;
        content << std::ifstream(path, std::ios::binary).rdbuf();
        return content.str();
    }

    /// A small drawing in the format a document wants, made without gnuplot.
    void add_figure(const std::string& name, const std::string& caption, DocumentFormat format) {
        RecordedFigure figure;
        figure.caption = caption;
        figure.file = file(name + (format == DocumentFormat::kPdf ? ".pdf" : ".svg"));
        write(figure.file.filename().string(), format == DocumentFormat::kPdf ? small_pdf() : small_svg());
        record_.figures[name] = figure;
    }

    static std::string small_svg() {
        return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"100\"><path d=\"M0 100 L200 0\" "
               "stroke=\"black\"/></svg>\n";
    }

    /// One page of 200 x 100 points with a line, with a correct cross-reference table.
    static std::string small_pdf() {
        const std::string drawing = "1 w 0 0 m 200 100 l S";
        const std::string objects[] = {
            "<</Type/Catalog/Pages 2 0 R>>", "<</Type/Pages/Kids[3 0 R]/Count 1>>",
            "<</Type/Page/Parent 2 0 R/MediaBox[0 0 200 100]/Contents 4 0 R/Resources<<>>>>",
            "<</Length " + std::to_string(drawing.size()) + ">>stream\n" + drawing + "\nendstream"};
        std::string pdf = "%PDF-1.4\n", table = "xref\n0 5\n0000000000 65535 f \n";
        for (int i = 0; i < 4; ++i) {
            char line[32];
            std::snprintf(line, sizeof line, "%010zu 00000 n \n", pdf.size());
            table += line;
            pdf += std::to_string(i + 1) + " 0 obj" + objects[i] + "endobj\n";
        }
        return pdf + table + "trailer<</Size 5/Root 1 0 R>>\nstartxref\n" + std::to_string(pdf.size()) + "\n%%EOF\n";
    }

    /// Makes `output` from `text` as the template report.md; returns its path.
    std::filesystem::path make(const std::string& text, const std::string& output) {
        write("report.md", text);
        DocumentSource source;
        source.template_file = file("report.md");
        source.record = &record_;
        source.cells = cells_;
        DocumentMaker::Options options;
        options.timings = &timings_;
        options.notes = &notes_;
        timings_.clear();
        notes_.clear();
        DocumentMaker(options).make(source, file(output), document_format(file(output)), nullptr);
        return file(output);
    }

    /// The document made as a draft: what is missing in it, a sentence a line, and its HTML.
    std::pair<std::string, std::string> draft(const std::string& text) {
        write("report.md", text);
        DocumentSource source;
        source.template_file = file("report.md");
        source.record = &record_;
        DocumentMaker::Options options;
        Complaints gaps;
        options.gaps = &gaps;
        DocumentMaker(options).make(source, file("draft.html"), DocumentFormat::kHtml, nullptr);
        std::string sentences;
        for (const Message& gap : gaps.messages()) sentences += message_text(gap) + "\n";
        return {replaced(sentences, folder_.path().string() + "/", ""), read(file("draft.html"))};
    }

    /// The message with which making the document fails, the test folder's path taken out; "" when it is made.
    std::string refusal(const std::string& text, const std::string& output = "out.html") {
        std::filesystem::remove(file(output));  // of a call before
        try {
            make(text, output);
        } catch (const DocumentError& error) {
            EXPECT_FALSE(std::filesystem::exists(file(output))) << "a document that failed left a file";
            return replaced(error.what(), folder_.path().string() + "/", "");
        }
        return "";
    }

    /// The HTML of a document, no-break spaces shown as spaces.
    std::string html(const std::string& text) { return replaced(read(make(text, "out.html")), "\u00A0", " "); }

    int passes() const {
        int count = 0;
        for (const auto& [step, seconds] : timings_) count += step.starts_with("latex pass");
        return count;
    }

    TemporaryFolder folder_;
    RunRecord record_;
    MarkdownText cells_;
    std::vector<std::pair<std::string, double>> timings_;
    std::vector<Message> notes_;
};

}  // namespace dynlab
