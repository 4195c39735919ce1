#pragma once
#include <filesystem>

#include "workflow/site/site_page.h"

namespace dynlab::inline workflow {

/// Refuses (EnvironmentError, with the remedy) a folder with anything but an unchanged site of write_site_folder.
void check_site_folder(const std::filesystem::path& folder);

/// Writes the files into the folder, which may be new, empty, or hold an older site, whose other files are removed.
/// Files that belong to no site stay and are never overwritten: before anything is changed, the folder is checked and
/// refused as by check_site_folder. site-files.txt lists the written files with their hashes.
void write_site_folder(const std::filesystem::path& folder, const SiteFiles& files);

}  // namespace dynlab::inline workflow
