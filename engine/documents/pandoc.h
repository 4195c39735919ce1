#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "documents/complaints.h"
#include "documents/document.h"
#include "documents/document_rules.h"
#include "documents/filter_messages.h"

namespace dynlab::inline documents {

/// One run of Pandoc with the project's filter (report_templates/filters).
struct PandocJob {
    MarkdownText markdown;                        ///< without YAML header
    std::map<std::string, std::string> metadata;  ///< checked keys
    DocumentRules rules;  ///< section titles are set in the document's language; pages or slides
    std::string language = "en";
    const RunRecord* record = nullptr;
    DocumentFormat format = DocumentFormat::kPdf;
    std::filesystem::path template_file;          ///< for messages
    std::filesystem::path shared_templates;       ///< the folder report_templates
    std::string picture_prefix;                   ///< what the writer puts before a picture's number
    std::filesystem::path work_folder;            ///< private; slots.lua is written there
    std::string bibliography;                     ///< a file of the work folder, or empty
    std::map<std::string, std::string> measures;  ///< Markdown of each
};

struct PandocResult {
    std::string text;  ///< LaTeX from \begin{document} on, whole HTML, or Markdown
    std::vector<UsedPicture> pictures;
};

/// Adds to `complaints` what filter and Pandoc found; `text` is then empty.
PandocResult run_pandoc(const PandocJob& job, Complaints& complaints);

std::string figure_extension(DocumentFormat format);  ///< "pdf" or "svg"

}  // namespace dynlab::inline documents
