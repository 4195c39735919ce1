#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dynlab {

/// A PDF to be looked at, and what it should be: "report", "slides" or "review".
struct InspectionJob {
    std::filesystem::path file;
    std::string part;
};

struct Inspection {
    int rules_broken = 0, pages = 0;
    std::string
        trouble;       ///< id of the finding that keeps the file from being read: damaged, encrypted, ...; else empty
    std::string json;  ///< findings_as_json; empty when nothing was looked at
};

/// Looks at PDFs as dynlab check does, several at once. Reviews may have two pages. A PDF that cannot be read is no
/// failure: it is told in the result.
std::vector<Inspection> inspect_all(const std::vector<InspectionJob>& jobs,
                                    const std::function<void(std::size_t done, std::size_t total)>& progress);

/// The same from the JSON that the store holds.
Inspection inspection_from(const std::string& json);

}  // namespace dynlab
