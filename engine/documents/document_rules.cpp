#include "documents/document_rules.h"

#include "documents/error.h"
#include "documents/text_lines.h"
#include "platform/text/read_number.h"

namespace dynlab::inline documents {
namespace {

constexpr const char* kRuleKeys[] = {"sections", "pages", "appendix_pages", "least_pages", "layout"};

SectionRule section_rule(const std::string& line, const Place& where) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find('|', begin), line.size());
        parts.push_back(trimmed(line.substr(begin, end - begin)));
        begin = end + 1;
    }
    const bool optional = parts.size() == 3 && parts[2] == "optional";
    if ((parts.size() != 2 && !optional) || parts[0].empty() || parts[1].empty())
        throw DocumentError(where, Message("section \"{}\" must be \"English title | French title\", followed by \"| "
                                           "optional\" if it may be missing",
                                           line));
    return {parts[0], parts[1], optional};
}

int page_count(const std::string& key, const std::string& value, const Place& where) {
    const int count = read_number<int>(value).value_or(0);
    if (count >= 1) return count;
    throw DocumentError(where, Message("{} must be a number of pages such as 6, not \"{}\"", key, value));
}

bool is_slides(const std::string& value, const Place& where) {
    if (value != "pages" && value != "slides")
        throw DocumentError(where, Message("\"layout\" must be \"pages\" or \"slides\", not \"{}\"", value));
    return value == "slides";
}

}  // namespace

bool is_document_rule(const std::string& key) {
    for (const char* known : kRuleKeys)
        if (key == known) return true;
    return false;
}

void read_document_rule(const std::string& key, const std::string& value, const Place& where, DocumentRules& rules) {
    if (key == "pages") rules.pages = page_count(key, value, where);
    if (key == "appendix_pages" && value != "0") rules.appendix_pages = page_count(key, value, where);
    if (key == "least_pages") rules.least_pages = page_count(key, value, where);
    if (key == "layout") rules.slides = is_slides(value, where);
    if (key != "sections") return;
    for (const std::string& line : lines_of(value))
        if (!is_blank(line)) rules.sections.push_back(section_rule(line, where));
}

DocumentRules document_rules(const TemplateFile& source) {
    DocumentRules rules;
    for (const auto& [key, value] : source.metadata) read_document_rule(key, value, {source.file}, rules);
    return rules;
}

}  // namespace dynlab::inline documents
