#pragma once
#include <vector>

#include "workflow/site/site_page.h"

namespace dynlab::inline workflow {

/// The first page in a language, index.html or LANGUAGE/index.html: lessons, workbench, demonstrations, guides,
/// reference. Lessons without a version in the language are listed with the one they have.
SitePage course_page(const std::vector<SitePage>& pages, const std::string& language, const SiteFrame& site);

/// All functions by area, with their summaries.
SitePage functions_page(const std::vector<SitePage>& pages);

/// The figures of the English pages, each with the preceding code, page by page.
SitePage gallery_page(const std::vector<SitePage>& pages);

}  // namespace dynlab::inline workflow
