#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/message.h"

namespace dynlab::inline workflow {

struct ManualRequest {
    std::filesystem::path folder;
    std::function<void(const Message&)> step = {};  ///< called with each step as it begins; may be empty
};

struct ManualResult {
    std::size_t pages = 0;
    std::vector<std::pair<Message, double>> timings;  ///< seconds of each step
};

/// The manual as a site that needs neither network nor server: the lessons as students get them (without solutions),
/// demonstrations, guides, every function with its example run, methods, a gallery, an index to search; and lessons,
/// guides, functions and methods as manual.pdf. All text comes from what it describes. What may stand in the folder
/// already: manual_folder.h. Nothing is written unless all could be made.
ManualResult make_manual(const ManualRequest& request);

}  // namespace dynlab::inline workflow
