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

/// The report of a student's folder, made by `program` (dynlab) in a box as grading does, as the analysis may be
/// anybody's: report.pdf, and record.json of its run, in `out`, an empty folder. The program reports what goes wrong as
/// if it had worked in the folder itself. Throws MissingProgram.
FolderReport make_folder_report(const std::filesystem::path& folder, const std::filesystem::path& out,
                                const std::filesystem::path& program, Isolation isolation, const TimeLimits& time);

}  // namespace dynlab::inline course
