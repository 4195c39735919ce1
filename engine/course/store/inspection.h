#pragma once
#include <filesystem>
#include <string>

namespace dynlab {

struct Inspection {
    int rules_broken = 0, pages = 0;
    std::string
        trouble;       ///< id of the finding that keeps the file from being read: damaged, encrypted, ...; else empty
    std::string json;  ///< findings_as_json; empty when nothing was looked at
};

/// Looks at a PDF as dynlab check does; `part` is what it should be: "report", "slides" or "review". Reviews may have
/// two pages. A PDF that cannot be read is no failure: it is told in the result.
Inspection inspect(const std::filesystem::path& pdf, const std::string& part);

/// The same from the JSON that the store holds.
Inspection inspection_from(const std::string& json);

}  // namespace dynlab
