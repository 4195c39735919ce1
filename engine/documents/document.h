#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "documents/complaints.h"
#include "documents/document_rules.h"
#include "documents/latex_format.h"
#include "documents/run_record.h"
#include "documents/weave.h"

namespace dynlab::inline documents {

enum class DocumentFormat { kPdf, kHtml, kMarkdown };
DocumentFormat document_format(
    const std::filesystem::path& file);  ///< by extension; throws DocumentError naming the three

/// The source of a document: a template (Pandoc Markdown with slots, metadata in its YAML header), the run results that
/// fill the slots and, for templates with a `::: {.cells}` block, the woven script. If the run stopped with an error,
/// the document shows the error (at its cell, else at the beginning), and slots without an entry say so.
struct DocumentSource {
    std::filesystem::path template_file;
    std::map<std::string, std::string> metadata;  ///< title, subtitle, lang, date...: override the template's own
    const RunRecord* record = nullptr;
    std::filesystem::path bibliography = {};           ///< of the script; that of the template, beside it, goes before
    std::map<std::string, std::string> measures = {};  ///< Markdown of each, for `::: measures` blocks that name it
    bool names_values = false;  ///< in a page: each value in a sentence is a span of the class value with data-name
    MarkdownText cells;         ///< replaces `::: {.cells}` ... `:::`
};

/// The text of a document with everything in its place but the slots.
struct PreparedText {
    MarkdownText markdown;  ///< an error of a run that shows no cells comes first
    std::map<std::string, std::string> metadata;
    DocumentRules rules;
    std::string language = "en";
    std::filesystem::path logo_named_in = {};  ///< the file that names the logo, which is beside it
};
/// Throws DocumentError for what read_template, check_metadata and with_cells refuse.
PreparedText prepared_text(const DocumentSource& source);
/// The layout in which `source` is set as a PDF, known before its script has run.
LatexLayout latex_layout(const DocumentSource& source);
/// The document's literature, copied into the folder in which Pandoc works: its name there, empty where there is none.
std::string placed_bibliography(const DocumentSource& source, const PreparedText& text,
                                const std::filesystem::path& work_folder, Complaints& complaints);

/// Makes documents: template -> Markdown -> Pandoc with our filter -> HTML, or LaTeX -> pdflatex with a precompiled
/// preamble and only the passes that references need; LuaLaTeX for letters that pdflatex does not have. The figures of
/// the run results must be drawn (their `file`: PDF for kPdf, SVG for kHtml) when `wait_for_figures` returns. Throws
/// DocumentError (with file and line or section): a slot without entry or of the wrong kind, dangling or duplicate
/// references, a missing image, metadata keys that are not allowed, file or macro commands in mathematics, control
/// characters, the first real LaTeX error; MissingProgram for pandoc and pdflatex.
class DocumentMaker {
  public:
    struct Options {
        bool use_cache = true;  ///< preamble format and .aux; never while grading
        std::filesystem::path latex_format =
            {};  ///< the folder of an existing preamble format, in the document's language (no slides)
        std::vector<std::pair<std::string, double>>* timings = nullptr;  ///< seconds of each step, appended
        CachedLatexFormat* begun_format = nullptr;  ///< of latex_layout(), begun before the script ran
        Complaints* gaps = nullptr;             ///< if set, collects slots without entry and dangling references, and
                                                ///< the document is made with a bold ?? in their places
        std::vector<Message>* notes = nullptr;  ///< about letters that pdflatex does not have, appended
        std::filesystem::path lualatex_fonts = {};               ///< made by make_lualatex_fonts
        std::vector<std::filesystem::path>* pictures = nullptr;  ///< files of pictures that the text shows, appended
    };
    explicit DocumentMaker(Options options) : options_(options) {}

    /// Writes `output` whole or not at all. `wait_for_figures` is called after Pandoc and before LaTeX, so
    /// that drawing and Pandoc overlap.
    void make(const DocumentSource& source, const std::filesystem::path& output, DocumentFormat format,
              const std::function<void()>& wait_for_figures) const;

  private:
    Options options_;
};

}  // namespace dynlab::inline documents
