#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "course/review/word_diff.h"
#include "course/sandbox_jobs/sandboxed_document.h"
#include "course/store/groups.h"
#include "course/store/newest_versions.h"

namespace dynlab::inline course {

/// A review as its authors received it.
struct ReleasedReview {
    std::string reviewer;  ///< the pseudonym
    Instant released = 0;
    std::vector<ReviewBlock> blocks;
    Message problem;  ///< a sentence, when its text cannot be read
};

/// The differences between the first and the final version of a group's report.
struct GroupChanges {
    std::string group;
    bool dropped_out = false;
    std::vector<ValidFile> first, final;  ///< the compared files: report, pack
    bool same_files = false;
    std::optional<int> pages_before, pages_after;
    std::optional<WordDiff> text;
    Message compared;                    ///< a sentence: the texts that were compared
    std::optional<ValueChanges> values;  ///< where the analyses of both packs can be run
    std::vector<ReleasedReview> reviews;
    std::vector<Message> problems;  ///< sentences
};

struct ChangesRequest {
    std::vector<std::string> groups;  ///< all if empty
    Isolation level = Isolation::kFull;
    std::filesystem::path program;
    std::function<void(std::size_t done, std::size_t total)> progress;
};

/// Compares the final version of each group with the version that its reviewers read (the newest first version where
/// none was sent). Leaves out groups that submitted nothing; changes nothing in the store. Throws InvalidArgument for a
/// talk or an unknown group.
std::vector<GroupChanges> version_changes(Course& course, const Assignment& assignment, const ChangesRequest& request);

/// A table for the terminal with one row per group.
std::string changes_table(const Assignment& assignment, const std::vector<GroupChanges>& groups);

/// Writes GROUP.md and GROUP.pdf into `folder` for every group with a final version, from
/// report_templates/version_changes.md: the text with its changes marked, the values that changed, the reviews. Returns
/// the number of groups. Throws EnvironmentError when a document cannot be made.
std::size_t write_changes(const std::vector<GroupChanges>& groups, Course& course, const Assignment& assignment,
                          const std::filesystem::path& folder, const SandboxedDocuments& documents,
                          const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace dynlab::inline course
