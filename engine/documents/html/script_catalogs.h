#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dynlab::inline documents {

/// The script before report_templates/html/words.js: `const dynlabCatalogs = {...};` with the translations of the
/// messages that JavaScript marks: tr("English"), trIn("context", "English"), trPlural("one", "many"). Each mark and
/// its texts are in one line. By the code of the language: `decimalSign`; `forms`, the digits of the plural forms of 0
/// to 199; `texts` by message, with its context before it as gettext has it, or the list of its plural forms. A
/// language without a catalog, such as "en", has no entry.
std::string script_catalogs(std::string_view javascript, const std::vector<std::string>& languages);

}  // namespace dynlab::inline documents
