#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/message.h"
#include "documents/run_record.h"
#include "platform/sandbox.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {

/// Makes documents about students' work, each in a sandbox, because their texts come from students. The layout is
/// compiled once, outside the sandboxes and before any of these texts is read; the sandboxes only read it. Threads may
/// share one object.
class SandboxedDocuments {
  public:
    /// `program`: dynlab.
    SandboxedDocuments(Isolation isolation, std::filesystem::path program)
        : isolation_(isolation), program_(std::move(program)) {}

    /// Sets report_templates/`template_name`, filled from the values, texts, tables and figures of the run results
    /// (drawn already, see draw_figures), and writes `output` (.pdf or .md, with its pictures in the same folder).
    /// `metadata`: title and lang ("en", "fr"), which override the template's. Throws EnvironmentError if the document
    /// cannot be made.
    void make(const std::string& template_name, const RunRecord& record, const std::filesystem::path& output,
              const std::map<std::string, std::string>& metadata = {}) const;

    /// About letters that pdflatex does not have: the first note of each kind.
    std::vector<Message> notes() const;

  private:
    struct CompiledLayout {
        TemporaryFolder folder;
        std::once_flag made;
    };
    const std::filesystem::path& latex_format(bool french) const;
    /// What LuaLaTeX keeps of the fonts for this text; nothing where pdflatex sets it.
    std::optional<std::filesystem::path> lualatex_fonts(const std::string& text) const;
    void keep(const std::vector<Message>& notes) const;

    Isolation isolation_;
    std::filesystem::path program_;
    mutable CompiledLayout english_, french_;
    TemporaryFolder fonts_;
    mutable std::mutex mutex_;            ///< of the members below and of what is written into fonts_
    mutable std::set<std::string> read_;  ///< scripts whose fonts are in fonts_
    mutable std::vector<Message> notes_;
};

/// Outcome of a job that writes files.
struct SandboxOutcome {
    std::optional<Message> error = {};  ///< a sentence; nothing where all went well
    std::vector<Message> notes = {};
};

/// Job that creates a document inside a sandbox. All paths are paths in the sandbox.
struct DocumentJob {
    static constexpr char kWork[] = "document";
    using Result = SandboxOutcome;

    std::string template_name;
    std::map<std::string, std::string> metadata;
    RunRecord record;
    std::optional<std::filesystem::path> latex_format;  ///< of PDFs, in their language
    std::optional<std::filesystem::path> lualatex_fonts;
    std::filesystem::path to;  ///< .pdf or .md
};

/// The part that runs inside the sandbox.
SandboxOutcome make_sandboxed_document(const DocumentJob& job);

}  // namespace dynlab::inline course
