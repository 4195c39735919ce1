#pragma once
#include <filesystem>

#include "workflow/manual/manual_page.h"

namespace dynlab::inline workflow {

/// Refuses (EnvironmentError, which says what to do) a folder that holds anything but a manual that write_manual_folder
/// made and nobody has changed since.
void check_manual_folder(const std::filesystem::path& folder);

/// Writes the files into the folder, which may be new, empty, or hold an older manual: of that what is no longer there
/// goes. Files that no manual has written stay where they are, and none of them is written over: such a folder is
/// refused, as check_manual_folder does, before anything is changed. What was written stands in manual-files.txt with
/// its hash.
void write_manual_folder(const std::filesystem::path& folder, const ManualFiles& files);

}  // namespace dynlab::inline workflow
