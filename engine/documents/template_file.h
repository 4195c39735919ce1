#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "documents/weave.h"

namespace dynlab::inline documents {

/// A template: the metadata of its YAML header (scalars and `|` blocks; a white-list of keys, all else is an
/// error) and its body.
struct TemplateFile {
    std::filesystem::path file;
    std::map<std::string, std::string> metadata;
    MarkdownText body;
};

/// Throws DocumentError with file and line.
TemplateFile read_template(const std::filesystem::path& file);

/// Throws DocumentError for a key a document may not set, or a value it cannot have (lang other than en and fr, toc
/// and numbersections other than true and false, rules that document_rules.h refuses).
void check_metadata(const std::string& key, const std::string& value, const Place& where);

/// What an own course sets for all its documents, `logo` and `header`, in report_templates/settings.yaml, which is like
/// a template's header without its lines "---". Nothing where there is no such file. Throws DocumentError.
TemplateFile read_settings(const std::filesystem::path& file);

/// Whether the body has a block `::: {.cells}`.
bool shows_cells(const TemplateFile& source);

/// The body with `cells` instead of the block `::: {.cells}` ... `:::`. Throws DocumentError if the block has content
/// or occurs twice.
MarkdownText with_cells(const TemplateFile& source, const MarkdownText& cells);

}  // namespace dynlab::inline documents
