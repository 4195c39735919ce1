#pragma once
#include <filesystem>

#include "course/boxed_document.h"
#include "course/store/final_changes.h"

namespace dynlab {

/// Writes GROUP.md and GROUP.pdf into `folder`: what changed and what became of each remark, for the instructor, made
/// from report_templates/final_changes.md. Throws EnvironmentError when that fails.
void write_change_document(const GroupChanges& changes, Course& course, const Assignment& assignment,
                           const std::filesystem::path& folder, const BoxedDocuments& documents);

}  // namespace dynlab
