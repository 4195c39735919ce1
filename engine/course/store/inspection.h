#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "course/issues/document_issues.h"

namespace dynlab::inline course {

struct Inspection {
    int rules_broken = 0;
    bool names = false;        ///< the document names a member of the course
    std::string error_reason;  ///< id of the finding that keeps the file from being read: damaged, ...; else empty
    Message reason;            ///< the same in a sentence
    std::string json;          ///< issues_as_json; empty when nothing was looked at
};

/// Part of a file that the course stores although it belongs to no part of the assignment. A file that cannot be read
/// gets a receipt, but replaces no version.
inline constexpr char kUnreadable[] = "unreadable";
/// Reasons for files that can be read: the owner or the assignment of the file is unknown (kNotTaken), or the file
/// arrived together with the file that counts (kBeside).
inline constexpr char kNotTaken[] = "not-taken", kBeside[] = "beside";

/// The inspection that is stored with such a file.
Inspection unreadable_inspection(const std::string& error_reason, const Message& reason);

/// Looks at PDFs as dynlab check does. Several threads may use one at once.
class Inspector {
  public:
    /// Reviews are searched for `names`, as they go to others without change; other first versions may be signed, and
    /// are searched when copies of them are made. Reports are held against what `lesson` asks of them, or the lab
    /// report where it is empty or not installed here.
    Inspector(std::shared_ptr<const IdentityMatcher> names, const std::string& lesson);

    /// Whether PDFs under this part are looked at: "report", "slides", "review".
    bool looks_at(const std::string& part) const { return options_by_part_.contains(part); }
    /// A PDF that cannot be read is no failure: the result says so.
    Inspection inspect(const std::filesystem::path& pdf, const std::string& part) const;

  private:
    std::map<std::string, CheckOptions> options_by_part_;  ///< by part
};

/// The same from the JSON that the store holds. Throws EnvironmentError for any other text.
Inspection inspection_from(const std::string& json);

}  // namespace dynlab::inline course
