#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::test {

/// What poppler reads from a PDF: text of each page and the document's metadata.
struct PdfContent {
    std::vector<std::string> pages;
    std::vector<std::pair<std::string, std::string>> metadata;
};
PdfContent inspect_pdf(const std::filesystem::path& file);  ///< throws EnvironmentError for a damaged or encrypted file

}  // namespace dynlab::test
