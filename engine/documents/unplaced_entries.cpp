#include "documents/unplaced_entries.h"

#include <algorithm>
#include <functional>

namespace dynlab::inline documents {
namespace {

bool ends_word(const std::string& text, std::size_t at) {
    return at >= text.size() || std::string_view(" \t\n})\"").find(text[at]) != std::string_view::npos;
}

bool holds_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if (ends_word(text, at + word.size())) return true;
    return false;
}

bool is_named_block(const std::string& markdown, const std::string& name) {
    return holds_word(markdown, "name=" + name) || holds_word(markdown, "name=\"" + name);
}

/// Figures that a cell made and dropped are shown after it: they are named "CELL-figure-K".
bool is_captured(const RunRecord& record, const std::string& figure) {
    return std::ranges::any_of(record.outputs, [&](const auto& cell) {
        return std::ranges::any_of(cell.second, [&](const CellOutput& piece) { return piece.figure == figure; });
    });
}

template <class Entries, class Shown>
std::vector<std::string> names_not_shown(const Entries& entries, const Shown& shown) {
    std::vector<std::string> names;
    for (const auto& [name, entry] : entries)
        if (!shown(name)) names.push_back(name);
    return names;
}

/// "the figure 'a' is reported, but has no place in the text".
std::string complaint(const char* kind, const std::vector<std::string>& names) {
    const bool one = names.size() == 1;
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
    return std::string("the ") + kind + (one ? " " : "s ") + list + (one ? " is" : " are") + " reported, but " +
           (one ? "has" : "have") + " no place in the text; write ";
}

}  // namespace

std::vector<std::string> unplaced_entries(const RunRecord& record, const std::string& markdown) {
    std::vector<std::string> sentences;
    const auto tell = [&](const char* kind, const std::vector<std::string>& names,
                          const std::function<std::string(const std::string&)>& line) {
        if (!names.empty()) sentences.push_back(complaint(kind, names) + line(names.front()));
    };
    tell("figure",
         names_not_shown(record.figures,
                         [&](const std::string& name) {
                             return is_captured(record, name) || holds_word(markdown, "(figure:" + name);
                         }),
         [](const std::string& name) { return "![](figure:" + name + "){#fig:" + name + "}"; });
    tell("table",
         names_not_shown(record.tables, [&](const std::string& name) { return is_named_block(markdown, name); }),
         [](const std::string& name) { return "::: {.table name=" + name + "} above and ::: below its caption"; });
    tell("text", names_not_shown(record.texts, [&](const std::string& name) { return is_named_block(markdown, name); }),
         [](const std::string& name) { return "::: {.text name=" + name + "} and ::: below"; });
    tell("value",
         names_not_shown(
             record.values,
             [&](const std::string& name) { return markdown.find("`" + name + "`{.value") != std::string::npos; }),
         [](const std::string& name) { return "`" + name + "`{.value}"; });
    return sentences;
}

}  // namespace dynlab::inline documents
