#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "platform/sandbox.h"

namespace dynlab::inline course {

/// Where a mark names a check or a criterion: the mark is of the whole submission.
inline constexpr char kWholeItem[] = "*";

/// A sender according to a platform's list.
struct Submitter {
    std::string name, id, mail;
};

/// One of the loose files that a platform exports of a sender.
struct LooseFile {
    std::filesystem::path path;
    std::string name;  ///< as the sender had it, without what the platform put before
};

/// One entry of the folder that is graded, or the loose files of one sender.
struct Submission {
    std::string name;            ///< the entry's name in UTF-8, without an archive's ending: how marks find it again
    std::filesystem::path path;  ///< a folder, an archive, or the first of `loose`
    bool archive = false;
    std::string
        person{};  ///< from the name an LMS gave: Moodle's full name, Canvas's joined name; else as a rule empty
    std::string lms_id{};                 ///< the number in that name
    bool late = false;                    ///< Canvas wrote LATE into it
    std::vector<LooseFile> loose{};       ///< files that are no folder and no archive by themselves
    std::vector<Submitter> submitters{};  ///< of Gradescope's list
};

/// The submissions in `folder`: folders, archives (.zip, .tar, .tar.gz, .tgz, .tar.xz), and files that can be a
/// student's work, sorted by name. The function skips hidden entries, files that systems add (__MACOSX, Thumbs.db),
/// Moodle's folders of typed text, and `results`. Links and other files go to `left_out`, each as a clause. Recognized
/// names are Moodle's "Name_ID_assignsubmission_file_..." and Canvas's "name_LATE_ID_ID_file.zip", and Gradescope's
/// submission_metadata.yml; loose Canvas files of one sender are joined. A single folder around all submissions is
/// opened. Throws EnvironmentError if there are no submissions.
std::vector<Submission> submissions_in(const std::filesystem::path& folder, std::vector<Message>& left_out,
                                       const std::filesystem::path& results = {});

/// What a submission may take when it is copied or unpacked.
struct SubmissionLimits {
    std::uint64_t bytes = 200ull << 20;
    int files = 2000;
    bool keep_times = false;  ///< of the files in an archive
};

/// Unpacks a submission's archive into `to`, which is created, with `program` in a sandbox. Returns the entries that
/// were left out, each as a clause ("\"../x\" leads outside of the archive"). Throws SubmissionError.
std::vector<Message> unpack_submission(const std::filesystem::path& archive, const std::filesystem::path& to,
                                       Isolation level, const std::filesystem::path& program,
                                       const SubmissionLimits& limits = {});

/// Unpacks the one zip in which an LMS exports all submissions into `to`, an empty folder, in a sandbox. Returns the
/// entries that were left out as unpack_submission does. Throws EnvironmentError.
std::vector<Message> unpack_export(const std::filesystem::path& archive, const std::filesystem::path& to,
                                   Isolation level, const std::filesystem::path& program);

/// The name without an archive's ending (.zip, .tar, .tar.gz, .tgz, .tar.xz, .tar.bz2); nothing for other files.
std::optional<std::string> archive_stem(const std::string& name);

/// What Moodle or Canvas wrote into the submission's name: person, lms_id and late are set from it. Returns what the
/// sender had called the file; nothing where no platform wrote.
std::optional<std::string> read_lms_name(Submission& submission);

/// A submission that cannot be graded as it is, through its sender's doing.
class SubmissionError : public ErrorOf<std::runtime_error> {
  public:
    using ErrorOf::ErrorOf;
};

}  // namespace dynlab::inline course
