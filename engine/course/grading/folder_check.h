#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>

#include "course/issues/document_issues.h"
#include "platform/time_limits.h"

namespace dynlab::inline course {

/// What a student's folder may cost.
struct FolderLimits {
    TimeLimits time{std::chrono::seconds(120)};  ///< for the analysis and its report
    std::uint64_t folder_bytes = 500ull << 20;   ///< of all files together
    int files = 5000;
    PdfLimits pdf;
};

/// Checks a folder created by `dynlab new`. dynlab copies the folder without links that lead outside, runs its analysis
/// and creates its report with `program` (dynlab), and then checks the report. The sandbox is that of grading: the
/// strongest isolation of this machine, time limits, no caches, and no files except those of the folder and the
/// installed data. The folder itself is not changed. Findings in addition to those of check_pdf:
/// * rules: analysis-missing, folder-too-large, file-outside (the analysis loads a file outside the folder),
///   analysis-fails, answer-open, answer-missing
/// * hints: not-shown (reported, but without a place in the text), members-missing (group.toml contains no names),
///   pdf-outdated, pdf-differs, link-left-out, script-empty, and check-failed, by the checks of the lesson; these
///   checks use the data sets of the group if the folder has some
/// The standard is the template in the header of analysis.lua, or the header of report.md if the template demands
/// nothing.
/// Throws MissingProgram if a program is missing on this machine.
CheckResult check_folder(const std::filesystem::path& folder, const std::filesystem::path& program,
                         const CheckOptions& check_options = {}, const FolderLimits& limits = {});

}  // namespace dynlab::inline course
