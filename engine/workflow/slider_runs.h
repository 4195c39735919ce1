#pragma once
#include <filesystem>
#include <vector>

#include "workflow/make_report.h"

namespace dynlab::inline scripting {
class CallCache;
}

namespace dynlab::inline workflow {

/// Runs the script of a page, from the cells that ask for sliders on, once more for every combination of their places,
/// one cell's sliders at a time, and puts what the document shows there into the page (documents/html/slider_page.h),
/// which needs no server then. `record` is the run the page was made of, its figures drawn; nothing is done for a run
/// without sliders, or one that failed.
/// Gives the files that the further runs read.
std::vector<std::filesystem::path> add_slider_places(const ReportRequest& request, const RunRecord& record,
                                                     CallCache& calls, const std::filesystem::path& work_folder);

}  // namespace dynlab::inline workflow
