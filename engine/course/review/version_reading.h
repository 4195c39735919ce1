#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "course/review/report_text.h"
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
    std::optional<ReportText> source;      ///< report.md of the pack, its slots filled by the pack's analysis
    std::optional<ReportText> printed;     ///< the PDF's text
    std::optional<nlohmann::json> record;  ///< of a run of the pack's analysis
    bool record_found = false;             ///< it is the pack's own record.json, as the analysis could not be run
    std::vector<std::string> troubles;     ///< sentences: what could not be read, and why
};

/// Reads a version: unpacks the pack and runs its analysis in boxes, looks at the PDF in a guarded process. Without a
/// PDF of its own, the pack's report is made. Never throws for what a group's files are the reason of; throws
/// MissingProgram.
ReadVersion read_version(const VersionFiles& files, Isolation level, const std::filesystem::path& program);

/// The part of it inside the box. `job`: {"folder": place of analysis.lua and report.md, "to": place of an empty
/// folder, "pdf": whether to make the PDF}. Writes record.json, report.md and report.pdf into `to`; returns {} or
/// {"error": sentence}.
nlohmann::json make_version(const nlohmann::json& job);

}  // namespace dynlab::inline course
