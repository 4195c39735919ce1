#pragma once
#include <string>

#include "scripting/runtime/context.h"

namespace dynlab::inline scripting {

/// A service of the runtime: the language of the document that is made, for report.language(); "en" without it.
struct ReportLanguage {
    std::string code = "en";
};

inline std::string report_language_of(const RuntimeContext& context) {
    const auto found = context.services.find(typeid(ReportLanguage).hash_code());
    return found == context.services.end() ? ReportLanguage{}.code : static_cast<ReportLanguage*>(found->second)->code;
}

}  // namespace dynlab::inline scripting
