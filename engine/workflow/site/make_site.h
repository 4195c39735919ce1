#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"
#include "workflow/site/site_page.h"

namespace dynlab::inline workflow {

struct SiteRequest {
    std::filesystem::path folder;
    std::optional<std::filesystem::path>
        engine;            ///< folder of dynlab.js, dynlab.wasm and what they fetch; none: no cell runs
    SiteFiles page_files;  ///< scripts and styles of the pages, by their place in the site
    std::function<void(const Message&)> step = {};  ///< called with each step as it begins; may be empty
};

struct SiteResult {
    std::size_t pages = 0;
    std::vector<std::pair<Message, double>> timings;  ///< seconds of each step
};

/// Makes the course as a static site, for any folder of any web server: lessons as students get them (without
/// solutions, in each language that they have), data sets, demonstrations, guides, every function with its example,
/// methods, a gallery, a search; with an engine also cells that run, and the workbench. All text is made from its
/// source. All links are relative, and no page contains a script. Which folders are accepted: site_folder.h. Writes
/// nothing unless all could be made. Throws DocumentError, EnvironmentError.
SiteResult make_site(const SiteRequest& request);

/// The folder of the engine for browsers: share/dynlab/web beside the installed program, or build/web/engine in the
/// source tree of `scripts/build web`. None where there is no engine.
std::optional<std::filesystem::path> web_engine();

}  // namespace dynlab::inline workflow
