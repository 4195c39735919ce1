#pragma once
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/box.h"

namespace dynlab::inline course {

/// One entry of the folder that is graded.
struct Submission {
    std::string name;            ///< the entry's name, without an archive's ending: how marks find it again
    std::filesystem::path path;  ///< a folder, or an archive
    bool archive = false;
    std::string person;  ///< from the name an LMS gave: Moodle's full name, Canvas's joined name; else as a rule empty
    std::string lms_id;  ///< the number in that name
    bool late = false;   ///< Canvas wrote LATE into it
};

/// What stands in `folder`: folders and archives (.zip, .tar, .tar.gz, .tgz, .tar.xz), sorted by name. Hidden entries
/// and Moodle's folders of typed text are passed over; links and other files go to `left_out`, each as a clause.
/// Moodle's "Name_ID_assignsubmission_file_..." and Canvas's "name_LATE_ID_ID_file.zip" are recognised. Throws
/// EnvironmentError where there is none.
std::vector<Submission> submissions_in(const std::filesystem::path& folder, std::vector<std::string>& left_out);

/// What a submission may take when it is copied or unpacked.
struct SubmissionLimits {
    std::uint64_t bytes = 200ull << 20;
    int files = 2000;
    bool keep_times = false;  ///< of the files in an archive
};

/// Unpacks a submission's archive into `to`, which is made, in a box by `program`. Returns what was left out, each
/// as a clause ("\"../x\" leads outside of the archive"). Throws SubmissionError.
std::vector<std::string> unpack_submission(const std::filesystem::path& archive, const std::filesystem::path& to,
                                           Isolation level, const std::filesystem::path& program,
                                           const SubmissionLimits& limits = {});

/// Unpacks the one zip in which an LMS exports all submissions into `to`, an empty folder, in a box.
/// Returns what was left out as unpack_submission does. Throws EnvironmentError.
std::vector<std::string> unpack_export(const std::filesystem::path& archive, const std::filesystem::path& to,
                                       Isolation level, const std::filesystem::path& program);

/// The name without an archive's ending (.zip, .tar, .tar.gz, .tgz, .tar.xz, .tar.bz2); nothing for other files.
std::optional<std::string> archive_stem(const std::string& name);

/// What Moodle or Canvas wrote into the submission's name: person, lms_id and late are set from it.
void read_lms_name(Submission& submission);

/// Brings a submission's files into `to`, an empty folder, and returns where analysis.lua stands: `to` itself, or the
/// only folder below that has one. Archives are unpacked in a box by `program`, one archive inside a folder as well.
/// Throws SubmissionError with a sentence for the student.
std::filesystem::path stage_submission(const Submission& submission, const std::filesystem::path& to, Isolation level,
                                       const std::filesystem::path& program, const SubmissionLimits& limits = {});

/// A submission that cannot be graded as it is, through its sender's doing.
class SubmissionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace dynlab::inline course
