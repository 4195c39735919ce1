#pragma once
#include <filesystem>
#include <vector>

#include "workflow/make_report.h"

namespace dynlab::inline scripting {
class CallCache;
}

namespace dynlab::inline workflow {

/// Runs the script of a page again for every combination of slider places, from the cells that request sliders on, one
/// cell's sliders at a time. It puts the document's results for these places into the page
/// (documents/html/slider_page.h), which then needs no server. The run results must be those of the page, with figures
/// drawn; nothing is done for a run without sliders, or for a failed run. Returns the files that the further runs read.
std::vector<std::filesystem::path> add_slider_places(const ReportRequest& request, const RunRecord& record,
                                                     CallCache& calls, const std::filesystem::path& work_folder);

}  // namespace dynlab::inline workflow
