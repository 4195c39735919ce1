#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "course/findings/document_findings.h"

namespace dynlab::inline course {

struct Inspection {
    int rules_broken = 0;
    bool names = false;   ///< somebody of the course is named
    std::string trouble;  ///< id of the finding that keeps the file from being read: damaged, ...; else empty
    Message reason;       ///< the same in a sentence
    std::string json;     ///< findings_as_json; empty when nothing was looked at
};

/// The part of files that are kept although they are not the assignment's: no file comes without a trace. Files that
/// nobody can read have a receipt, but replace nothing.
inline constexpr char kUnreadable[] = "unreadable";
/// Troubles of files that somebody could read: nobody knows whose they are or where they belong; or they came beside
/// the file that counts.
inline constexpr char kNotTaken[] = "not-taken", kBeside[] = "beside";

/// What is kept beside such a file.
Inspection unreadable_inspection(const std::string& trouble, const Message& reason);

/// Looks at PDFs as dynlab check does. Several threads may use one at once.
class Inspector {
  public:
    /// Reviews are searched for `names`, as they go to others without change; other first versions may be signed, and
    /// are searched when copies of them are made. Reports are held against what `lesson` asks of them, or the lab
    /// report where it is empty or not installed here.
    Inspector(std::shared_ptr<const IdentityMatcher> names, const std::string& lesson);

    /// Whether PDFs under this part are looked at: "report", "slides", "review".
    bool looks_at(const std::string& part) const { return wishes_.contains(part); }
    /// A PDF that cannot be read is no failure: the result says so.
    Inspection inspect(const std::filesystem::path& pdf, const std::string& part) const;

  private:
    std::map<std::string, CheckOptions> wishes_;  ///< by part
};

/// The same from the JSON that the store holds. Throws EnvironmentError for any other text.
Inspection inspection_from(const std::string& json);

}  // namespace dynlab::inline course
