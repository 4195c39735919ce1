#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>

#include "course/findings/document_findings.h"
#include "platform/time_limits.h"

namespace dynlab::inline course {

/// What a student's folder may cost.
struct FolderLimits {
    TimeLimits time{std::chrono::seconds(120)};  ///< for the analysis and its report
    std::uint64_t folder_bytes = 500ull << 20;   ///< of all files together
    int files = 5000;
    PdfLimits pdf;
};

/// Checks a folder made by `dynlab new`: copies it, without links that lead elsewhere, runs its analysis and makes its
/// report there with `program` (dynlab), in a box as grading does (the strongest isolation of this machine), with
/// limits of time, without caches and without any file but the folder's and the installed data; then checks that
/// report. Nothing is written into the folder. Findings besides those of check_pdf: analysis-missing, folder-too-large,
/// file-outside (the analysis loads what is not in the folder), analysis-fails, answer-open, answer-missing (rules),
/// not-shown (reported without a place in the text), members-missing (group.toml names nobody), pdf-outdated,
/// pdf-differs, link-left-out, and check-failed, by the lesson's own checks (hints), which are tried on
/// the group's own records where the folder has such. The standard is the template that the header of analysis.lua
/// names, or report.md's own header when that demands nothing. Throws MissingProgram when something is missing on this
/// machine rather than in the folder.
CheckResult check_folder(const std::filesystem::path& folder, const std::filesystem::path& program,
                         const CheckOptions& wishes = {}, const FolderLimits& limits = {});

}  // namespace dynlab::inline course
