#pragma once
#include <filesystem>

#include "course/boxes/boxed_document.h"
#include "course/review/final_changes.h"

namespace dynlab::inline course {

/// Writes GROUP.md and GROUP.pdf into `folder` for every group with a final version: what changed and what became of
/// each remark, for the instructor, made from report_templates/final_changes.md. Returns for how many. Throws
/// EnvironmentError when one cannot be made.
std::size_t write_change_documents(const std::vector<GroupChanges>& groups, Course& course,
                                   const Assignment& assignment, const std::filesystem::path& folder,
                                   const BoxedDocuments& documents,
                                   const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace dynlab::inline course
