#pragma once
#include <string>

#include "base/message.h"
#include "course/store/assignments.h"
#include "course/store/incoming.h"
#include "course/store/inspection.h"

namespace dynlab::inline course {

/// What kind of file it is that can be read at `file` and was received under `name`, by its first bytes and its name's
/// ending: "pdf", "pack" (zip or tar), "script" (.lua), "text" (what a word processor writes: .docx, .odt, ...), or
/// empty for anything else. Throws EnvironmentError.
std::string kind_of_file_at(const std::string& name, const std::filesystem::path& file);

/// What a file that came in is. Its content says so; its name counts only where the content leaves it open.
struct RecognizedFile {
    std::string part;          ///< report, slides, script, review, pack; kUnreadable
    std::string name;          ///< under which it is kept: a PDF's ends in .pdf, so that all that follows knows it
    std::string error_reason;  ///< id of the reason why the file is unreadable: "empty", "closed-archive",
                               ///< "other-kind"; else empty
    Message reason;            ///< the same in a sentence
    Message remark;            ///< a clause where name and content differ
    bool text = false;         ///< a word processor's: kept as the document, which it is, though no PDF
};
/// `stage`: "first", "review" or "final". Throws EnvironmentError for a file that cannot be opened.
RecognizedFile recognize(const IncomingFile& file, const Assignment& assignment, const std::string& stage);

}  // namespace dynlab::inline course
