#pragma once
#include <filesystem>
#include <optional>

#include "documents/run_record.h"
#include "platform/sandbox.h"

namespace dynlab::inline course {

/// How the making of a report went.
struct FolderReport {
    bool made = false;
    std::optional<RecordedError> stopped;  ///< the analysis stopped with it
    Message failure;                       ///< a sentence: why there is no report otherwise
};

/// Creates the report of a student's folder with `program` (dynlab), in a sandbox as grading does, because the analysis
/// is untrusted. Writes report.pdf and record.json of the run into `out`, an empty folder. Errors are reported as if
/// the program had worked in the folder itself. Throws MissingProgram.
FolderReport make_folder_report(const std::filesystem::path& folder, const std::filesystem::path& out,
                                const std::filesystem::path& program, Isolation isolation, const TimeLimits& time);

}  // namespace dynlab::inline course
