#pragma once
#include <string>

#include "workflow/site/site_page.h"

namespace dynlab::inline workflow {

/// manifest.webmanifest, by which browsers offer to install the site.
std::string web_manifest();

/// files.json for the service worker: {"version": TEXT, "files": [{"path", "bytes", "sha256"}]} with all files but the
/// service worker itself. `sha256` has the first 16 digits of each file's hash; `version` is made from all of them.
std::string list_of_files(const SiteFiles& files);

}  // namespace dynlab::inline workflow
