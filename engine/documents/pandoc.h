#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "documents/complaints.h"
#include "documents/document.h"
#include "documents/document_rules.h"
#include "documents/filter_messages.h"
#include "platform/child_process.h"

namespace dynlab::inline documents {

/// For a document that is set in chunks, each a block `::: {.chunk number=N}`: the counts with which chunks begin that
/// do not follow the one before them, and the labels of chunks that are not set now.
struct ChunkSurroundings {
    std::map<int, Counts> counts;
    std::map<std::string, std::string> labels;
};

/// One run of Pandoc with the project's filter (report_templates/filters).
struct PandocJob {
    MarkdownText markdown;                        ///< without YAML header
    std::map<std::string, std::string> metadata;  ///< checked keys
    DocumentRules rules;  ///< section titles are set in the document's language; pages or slides
    std::string language = "en";
    const RunRecord* record = nullptr;
    DocumentFormat format = DocumentFormat::kPdf;
    std::filesystem::path template_file;                     ///< for messages
    std::filesystem::path shared_templates;                  ///< the folder report_templates
    std::string picture_prefix;                              ///< what the writer puts before a picture's number
    std::filesystem::path work_folder;                       ///< private; slots.lua is written there
    std::string logo;                                        ///< the name under which the writer finds it, or empty
    std::string bibliography;                                ///< a file of the work folder, or empty
    std::map<std::string, std::string> measures;             ///< Markdown of each
    std::optional<ChunkSurroundings> chunks = std::nullopt;  ///< then what can be set is set, whatever is wrong
    bool unfinished = false;                                 ///< a slot without an entry says so
    bool names_values = false;                               ///< pages say of each value in a sentence which one it is
    bool draft = false;               ///< what points to nothing is shown as ?? and is no complaint
    ChildProcess* started = nullptr;  ///< by start_pandoc, for a job of the same format in the same folder
};

struct PandocResult {
    std::string text;  ///< LaTeX from \begin{document} on, whole HTML, or Markdown
    std::vector<UsedPicture> pictures;
    ChunkMessages chunks;
    Complaints gaps;  ///< of a draft
};

/// Adds to `complaints` what filter and Pandoc found; `text` is then empty, unless the job sets chunks.
PandocResult run_pandoc(const PandocJob& job, Complaints& complaints);
/// A Pandoc that has begun and waits for the job's text; all else of the job is only read when it comes.
ChildProcess start_pandoc(const PandocJob& job);

std::string figure_extension(DocumentFormat format);  ///< "pdf" or "svg"

}  // namespace dynlab::inline documents
