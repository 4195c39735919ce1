#pragma once
#include <string>

namespace dynlab::inline scripting {

/// A service of the runtime: the language of the document that is made, for report.language(); "en" without it.
struct ReportLanguage {
    std::string code = "en";
};

}  // namespace dynlab::inline scripting
