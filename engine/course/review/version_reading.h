#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "course/boxes/boxed_document.h"
#include "course/review/report_text.h"
#include "course/review/value_changes.h"
#include "platform/box.h"

namespace dynlab::inline course {

/// What a group handed in as one version of its report.
struct VersionFiles {
    std::optional<std::filesystem::path> pdf;
    std::optional<std::filesystem::path> pack;  ///< its name ends as archives do
};

/// A version as it can be compared.
struct ReadVersion {
    std::optional<int> pages;
    std::optional<ReportText> source;   ///< report.md of the pack, its slots filled by the pack's analysis
    std::optional<ReportText> printed;  ///< the PDF's text
    std::optional<ShownRecord> record;  ///< of a run of the pack's analysis
    bool record_found = false;          ///< it is the pack's own record.json, as the analysis could not be run
    std::vector<Message> troubles;      ///< sentences: what could not be read, and why
};

/// Reads a version: unpacks the pack and runs its analysis in boxes, looks at the PDF in a guarded process. Without a
/// PDF of its own, the pack's report is made. Never throws for what a group's files are the reason of; throws
/// MissingProgram.
ReadVersion read_version(const VersionFiles& files, Isolation level, const std::filesystem::path& program);

/// Runs the analysis in `folder` and makes its record.json, report.md and, if wanted, report.pdf in `made`, an empty
/// folder, in a box by `program`. Returns why that did not go to its end, without a full stop; empty where it did.
Message make_version_in_box(const std::filesystem::path& folder, const std::filesystem::path& made, bool pdf,
                            Isolation level, const std::filesystem::path& program);

/// A version to be made inside a box; all paths are those in the box.
struct VersionJob {
    static constexpr char kWork[] = "version";
    using Result = BoxedOutcome;

    std::filesystem::path folder;  ///< of analysis.lua and report.md
    std::filesystem::path to;      ///< an empty folder
    bool pdf = false;              ///< whether to make the PDF
};

/// The part of it inside the box. Writes record.json, report.md and report.pdf into `to`.
BoxedOutcome make_version(const VersionJob& job);

}  // namespace dynlab::inline course
