#pragma once
#include <vector>

#include "workflow/manual/manual_page.h"

namespace dynlab::inline workflow {

/// The first page: what the manual holds.
ManualPage contents_page(const std::vector<ManualPage>& pages);

/// All functions by area, with their summaries.
ManualPage functions_page(const std::vector<ManualPage>& pages);

/// The figures of the pages, each with the code that stands before it, page by page.
ManualPage gallery_page(const std::vector<ManualPage>& pages);

}  // namespace dynlab::inline workflow
