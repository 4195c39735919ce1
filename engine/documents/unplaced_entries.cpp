#include "documents/unplaced_entries.h"

#include <algorithm>
#include <utility>

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

}  // namespace

MessageList UnplacedEntries::quoted_names() const {
    std::vector<std::string> quoted;
    for (const std::string& name : names) quoted.push_back("'" + name + "'");
    return listed(quoted);
}

std::string UnplacedEntries::slot() const {
    const std::string& name = names.front();
    if (kind == Kind::kFigure) return "![](figure:" + name + "){#fig:" + name + "}";
    if (kind == Kind::kValue) return "`" + name + "`{.value}";
    return std::string("::: {.") + (kind == Kind::kTable ? "table" : "text") + " name=" + name + "}";
}

Message UnplacedEntries::message() const {
    const bool one = names.size() == 1;
    const MessageList all = quoted_names();
    const std::string& first = names.front();
    switch (kind) {
        case Kind::kTable:
            return one ? Message(
                             "the table {} is passed to the report but never shown; write ::: {.table name={}} above "
                             "its caption and ::: below the caption",
                             all, first)
                       : Message(
                             "the tables {} are passed to the report but never shown; for each table, write ::: with "
                             "its name, such as ::: {.table name={}}, above its caption, and ::: below the caption",
                             all, first);
        case Kind::kText:
            return one ? Message(
                             "the text {} is passed to the report but never shown; write ::: {.text name={}} and, on a "
                             "later line, :::",
                             all, first)
                       : Message(
                             "the texts {} are passed to the report but never shown; for each text, write ::: with its "
                             "name, such as ::: {.text name={}}, and, on a later line, :::",
                             all, first);
        case Kind::kValue:
            return one ? Message("the value {} is passed to the report but never shown; write {}", all, slot())
                       : Message("the values {} are passed to the report but never shown; write {}", all, slot());
        case Kind::kFigure:
            break;
    }
    return one ? Message("the figure {} is passed to the report but never shown; write {}", all, slot())
               : Message("the figures {} are passed to the report but never shown; write {}", all, slot());
}

std::string with_texts_of_script(const RunRecord& record, const std::string& markdown) {
    const auto shows = [&](const std::string& name) { return markdown.find(name) != std::string::npos; };
    std::string text = markdown;
    const auto add = [&text](const std::string& more) {
        if (more.find("{.") != std::string::npos) text += more + "\n";  // other texts show no run results
    };
    for (const auto& [name, shown] : record.texts)
        if (shows(name)) add(shown.markdown);
    for (const auto& [name, figure] : record.figures)
        if (shows(name)) add(figure.caption);
    for (const auto& [name, table] : record.tables) {
        if (!shows(name)) continue;
        for (const std::string& title : table.header) add(title);
        for (const auto& row : table.rows)
            for (const std::string& cell : row) add(cell);
    }
    return text;
}

std::vector<UnplacedEntries> unplaced_entries(const RunRecord& record, const std::string& markdown) {
    using Kind = UnplacedEntries::Kind;
    std::vector<UnplacedEntries> found;
    const auto add = [&found](Kind kind, std::vector<std::string> names) {
        if (!names.empty()) found.push_back({kind, std::move(names)});
    };
    add(Kind::kFigure, names_not_shown(record.figures, [&](const std::string& name) {
            return is_captured(record, name) || holds_word(markdown, "(figure:" + name);
        }));
    const std::string text = with_texts_of_script(record, markdown);
    const auto has_block = [&](const std::string& name) { return is_named_block(markdown, name); };
    add(Kind::kTable, names_not_shown(record.tables, has_block));
    add(Kind::kText, names_not_shown(record.texts, has_block));
    add(Kind::kValue, names_not_shown(record.values, [&](const std::string& name) {
            return text.find("`" + name + "`{.value") != std::string::npos;
        }));
    return found;
}

}  // namespace dynlab::inline documents
