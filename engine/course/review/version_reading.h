#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/review/word_diff.h"
#include "course/sandbox_jobs/sandboxed_document.h"
#include "documents/run_record.h"
#include "platform/sandbox.h"

namespace dynlab::inline course {

/// One version of a group's report.
struct VersionFiles {
    std::optional<std::filesystem::path> pdf;
    std::optional<std::filesystem::path> pack;
};

/// A version as it can be compared.
struct ReadVersion {
    std::optional<int> pages;
    std::optional<std::vector<ReportWord>> source;   ///< report.md of the pack, its slots filled by the pack's analysis
    std::optional<std::vector<ReportWord>> printed;  ///< the text of the PDF
    std::optional<RunRecord> record;                 ///< of a run of the pack's analysis
    std::vector<Message> problems;                   ///< sentences: what cannot be read, and why
};

/// Reads a version: unpacks the pack and runs its analysis in sandboxes, reads the PDF in a guarded process. What is
/// wrong with a group's files becomes a problem. Throws MissingProgram.
ReadVersion read_version(const VersionFiles& files, Isolation level, const std::filesystem::path& program);

/// Runs the analysis in `folder` with `program` in a sandbox and creates its record.json, report.md and, if wanted,
/// report.pdf in `made`, an empty folder. Returns the reason for a failure, without a full stop; empty on success.
Message make_version_in_sandbox(const std::filesystem::path& folder, const std::filesystem::path& made, bool pdf,
                                Isolation level, const std::filesystem::path& program);

/// Job that creates a version inside a sandbox. All paths are paths in the sandbox.
struct VersionJob {
    static constexpr char kWork[] = "version";
    using Result = SandboxOutcome;

    std::filesystem::path folder;  ///< of analysis.lua and report.md
    std::filesystem::path to;      ///< an empty folder
    bool pdf = false;              ///< whether to make the PDF
};

/// The part that runs inside the sandbox. Writes record.json, report.md and report.pdf into `to`.
SandboxOutcome make_version(const VersionJob& job);

}  // namespace dynlab::inline course
