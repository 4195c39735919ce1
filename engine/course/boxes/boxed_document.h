#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "base/message.h"
#include "documents/run_record.h"
#include "platform/box.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {

/// Makes documents about students' work, each in a box, as their texts come from students. The layout is compiled once,
/// outside and before any of these texts is read; the boxes only read it. Threads may share one.
class BoxedDocuments {
  public:
    /// `program`: dynlab.
    BoxedDocuments(Isolation isolation, std::filesystem::path program)
        : isolation_(isolation), program_(std::move(program)) {}

    /// Sets report_templates/`template_name`, filled from the record's values, texts, tables and figures (drawn
    /// already, see draw_figures), and writes `output` (.pdf or .md, with its pictures beside it). Letters that LaTeX
    /// does not have become question marks. `metadata`: title and lang ("en", "fr") in place of the template's. Throws
    /// EnvironmentError when it cannot be made.
    void make(const std::string& template_name, const RunRecord& record, const std::filesystem::path& output,
              const std::map<std::string, std::string>& metadata = {}) const;

  private:
    struct CompiledLayout {
        TemporaryFolder folder;
        std::once_flag made;
    };
    const std::filesystem::path& latex_format(bool french) const;

    Isolation isolation_;
    std::filesystem::path program_;
    mutable CompiledLayout english_, french_;
};

/// What comes of a job whose result is files.
struct BoxedOutcome {
    std::optional<Message> error;  ///< a sentence; nothing where all went well
};

/// A document to be made inside a box; all paths are those in the box.
struct DocumentJob {
    static constexpr char kWork[] = "document";
    using Result = BoxedOutcome;

    std::string template_name;
    std::map<std::string, std::string> metadata;
    RunRecord record;
    std::optional<std::filesystem::path> latex_format;  ///< of PDFs, in their language
    std::filesystem::path to;                           ///< .pdf or .md
};

/// The part of it inside the box.
BoxedOutcome make_boxed_document(const DocumentJob& job);

}  // namespace dynlab::inline course
