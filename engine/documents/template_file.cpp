#include "documents/template_file.h"

#include <re2/re2.h>

#include <algorithm>

#include "base/languages.h"
#include "documents/bibliography.h"
#include "documents/document_rules.h"
#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/spelling.h"

namespace dynlab::inline documents {
namespace {

const std::vector<std::string> kAllowedKeys = {
    "title", "subtitle",       "date",        "lang",   "abstract",     "toc",  "numbersections", "sections",
    "pages", "appendix_pages", "least_pages", "layout", "bibliography", "logo", "header"};
const std::vector<std::string> kSettings = {"logo", "header"};

/// A file's name without a folder, of one of these kinds.
bool is_name_of_kind(const std::string& name, std::initializer_list<std::string_view> kinds) {
    const std::string kind = std::filesystem::path(name).extension().string();
    return name.find_first_of("/\\") == std::string::npos && !name.starts_with('.') &&
           std::ranges::find(kinds, kind) != kinds.end();
}

std::string scalar(const std::string& value, const Place& where) {
    if (value.empty()) return value;
    const char first = value[0];
    if (first == '"' || first == '\'') {
        if (value.size() < 2 || value.back() != first)
            throw DocumentError(where, Message("the quotation mark of {} is not closed", value));
        return value.substr(1, value.size() - 2);
    }
    if (std::string("[{&*!%@").find(first) != std::string::npos)
        throw DocumentError(where, Message("the value {} must be plain text; enclose it in quotation marks", value));
    const std::size_t comment = value.find(" #");
    return trimmed(value.substr(0, comment));
}

bool is_block_sign(const std::string& value) {
    return value == "|" || value == ">" || value == "|-" || value == ">-";
}

/// Reads header lines [begin, end) of `lines`.
void read_metadata(const std::vector<std::string>& lines, std::size_t begin, std::size_t end, TemplateFile& result) {
    for (std::size_t i = begin; i < end; ++i) {
        const std::string& line = lines[i];
        if (is_blank(line) || line[0] == '#') continue;
        const std::size_t colon = line.find(':');
        const Place where{result.file, static_cast<int>(i) + 1};
        if (colon == std::string::npos || line[0] == ' ' || line[0] == '-')
            throw DocumentError(where, Message("\"{}\" does not have the form \"key: value\"", trimmed(line)));
        const std::string key = trimmed(line.substr(0, colon));
        std::string value = trimmed(line.substr(colon + 1));
        if (is_block_sign(value)) {
            value.clear();
            while (i + 1 < end && (is_blank(lines[i + 1]) || lines[i + 1][0] == ' '))
                value += trimmed(lines[++i]) + "\n";
        } else {
            value = scalar(value, where);
        }
        check_metadata(key, value, where);
        if (!result.metadata.emplace(key, value).second)
            throw DocumentError(where, Message("key \"{}\" occurs twice", key));
    }
}

std::size_t end_of_metadata(const std::vector<std::string>& lines, const std::filesystem::path& file) {
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (trimmed(lines[i]) == "---" || trimmed(lines[i]) == "...") return i;
    throw DocumentError({file, 1}, Message("the header is not closed; add a line \"---\" after the header"));
}

bool opens_cells(const std::string& line) {
    static const RE2 opening(R"(:::+\s*(\{\s*\.cells\s*\}|cells)\s*:*\s*)", RE2::Latin1);
    return RE2::FullMatch(line, opening);
}

}  // namespace

void check_metadata(const std::string& key, const std::string& value, const Place& where) {
    if (std::ranges::find(kAllowedKeys, key) == kAllowedKeys.end()) {
        if (key == "author" || key == "authors")
            throw DocumentError(
                where,
                Message("a document must not name an author, because reports are reviewed anonymously; remove \"{}\"",
                        key));
        if (const auto near = nearest_word(key, kAllowedKeys))
            throw DocumentError(where, Message("metadata key \"{}\" is not allowed; did you mean \"{}\"?", key, *near));
        throw DocumentError(
            where, Message("metadata key \"{}\" is not allowed; the allowed keys are {}", key, listed(kAllowedKeys)));
    }
    if (key == "lang" && !is_language(value))
        throw DocumentError(
            where, Message("unknown language \"{}\" in \"lang\"; write {}", value, listed(languages(), Join::kOr)));
    if ((key == "toc" || key == "numbersections") && value != "true" && value != "false")
        throw DocumentError(where, Message("{} must be true or false, not \"{}\"", key, value));
    if (key == "bibliography")
        if (const Message fault = fault_of_bibliography_name(value); !fault.empty()) throw DocumentError(where, fault);
    if (key == "logo" && !is_name_of_kind(value, {".png", ".jpg", ".jpeg", ".pdf"}))
        throw DocumentError(where, Message("\"logo\" must be the name of a .png, .jpg or .pdf file in the same folder, "
                                           "such as logo.png, not \"{}\"",
                                           value));
    DocumentRules rules;
    read_document_rule(key, value, where, rules);
}

TemplateFile read_template(const std::filesystem::path& file) {
    TemplateFile result;
    result.file = file;
    const std::vector<std::string> lines = lines_of(text_of_source(file));
    std::size_t first = 0;
    if (!lines.empty() && trimmed(lines[0]) == "---") {
        const std::size_t end = end_of_metadata(lines, file);
        read_metadata(lines, 1, end, result);
        first = end + 1;
    }
    for (std::size_t i = first; i < lines.size(); ++i)
        result.body.append(lines[i] + "\n", file, static_cast<int>(i) + 1);
    return result;
}

TemplateFile read_settings(const std::filesystem::path& file) {
    TemplateFile result;
    result.file = file;
    if (!std::filesystem::is_regular_file(file)) return result;
    const std::vector<std::string> lines = lines_of(text_of_source(file));
    read_metadata(lines, 0, lines.size(), result);
    for (const auto& [key, value] : result.metadata)
        if (std::ranges::find(kSettings, key) == kSettings.end())
            throw DocumentError({file},
                                Message("\"{}\" is a template setting and not allowed here; the settings are {}", key,
                                        listed(kSettings)));
    return result;
}

bool shows_cells(const TemplateFile& source) {
    FencedCode fence;
    const std::vector<std::string> lines = lines_of(source.body.text);
    return std::ranges::any_of(lines, [&](const std::string& line) { return !fence.holds(line) && opens_cells(line); });
}

MarkdownText with_cells(const TemplateFile& source, const MarkdownText& cells) {
    const std::vector<std::string> lines = lines_of(source.body.text);
    MarkdownText result;
    FencedCode fence;
    bool is_placed = false;
    const auto place = [&](std::size_t i) { return Place{source.file, source.body.origin[i].line}; };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Place from = source.body.origin[i];
        if (fence.holds(lines[i]) || !opens_cells(lines[i])) {
            result.append(lines[i] + "\n", from.file, from.line);
            continue;
        }
        if (is_placed)
            throw DocumentError(place(i), Message("the block ::: {.cells} occurs twice; remove one of the blocks"));
        is_placed = true;
        std::size_t end = i + 1;
        while (end < lines.size() && is_blank(lines[end])) ++end;
        if (end == lines.size() || !trimmed(lines[end]).starts_with(":::"))
            throw DocumentError(place(i),
                                Message("the block ::: {.cells} must be empty and closed with a line \":::\""));
        result.append("\n", from.file, from.line);
        result.text += cells.text;
        result.origin.insert(result.origin.end(), cells.origin.begin(), cells.origin.end());
        result.append("\n", from.file, from.line);
        i = end;
    }
    return result;
}

}  // namespace dynlab::inline documents
