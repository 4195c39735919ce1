#pragma once
#include "workflow/site/site_page.h"

namespace dynlab::inline workflow {

/// The course's data sets for a site: data/NAME/FILE, and data/index.json, which lists the files of each with their
/// sizes. A data set of a Debian package becomes NAME.csv, with every digit.
SiteFiles data_of_site();

}  // namespace dynlab::inline workflow
