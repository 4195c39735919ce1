#pragma once
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline course {

enum class Severity { kRule, kHint };  ///< a rule of the course is broken; something worth a look

/// A problem in a document and how to fix it. Ids are stable: programs may rely on them.
struct Issue {
    std::string id;  ///< such as "figure-not-mentioned"
    Severity severity = Severity::kRule;
    int page = 0;       ///< 1-based; 0 concerns the whole document
    std::string place;  ///< "analysis.lua:12" when a source file is concerned, else empty
    Message what;       ///< one sentence
    Message remedy;     ///< one sentence
};

using Issues = std::vector<Issue>;

}  // namespace dynlab::inline course
