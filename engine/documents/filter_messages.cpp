#include "documents/filter_messages.h"

#include <algorithm>
#include <map>
#include <set>

#include "documents/text_lines.h"
#include "platform/spelling.h"

namespace dynlab::inline documents {
namespace {

std::vector<std::string> split_at(const std::string& line, char separator) {
    std::vector<std::string> fields(1);
    for (char c : line) {
        if (c == separator)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

template <typename Entry>
std::vector<std::string> names_of(const std::map<std::string, Entry>& entries) {
    std::vector<std::string> names;
    for (const auto& [name, entry] : entries) names.push_back(name);
    return names;
}

std::vector<std::string> names_of(const RunRecord& record, const std::string& kind) {
    if (kind == "value") return names_of(record.values);
    if (kind == "table") return names_of(record.tables);
    if (kind == "figure") return names_of(record.figures);
    return names_of(record.texts);
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates) {
    const auto near = nearest_word(name, candidates);
    return near ? "; did you mean \"" + *near + "\"?" : "";
}

std::string quoted(const std::string& text) {
    return "\"" + text + "\"";
}

/// Turns the filter's codes into sentences. Fields: [0] the sign, [1] code, [2] text to look for, [3...] details.
class Sentences {
  public:
    Sentences(const MarkdownText& markdown, const RunRecord& record) : markdown_(markdown), record_(record) {}

    std::string of(const std::vector<std::string>& fields) const {
        const auto detail = [&](std::size_t i) { return i + 3 < fields.size() ? fields[i + 3] : std::string(); };
        const std::string& code = fields[1];
        const std::string first = detail(0), second = detail(1), third = detail(2);
        if (code == "no-entry") return no_entry(first, second);
        if (code == "wrong-kind")
            return quoted(second) + " is a " + third + " in the run's record, but this slot wants a " + first +
                   "; use the slot for a " + third + " or report.value, report.table, report.figure, report.text alike";
        if (code == "dangling") return dangling(first);
        if (code == "duplicate-label") return "the label " + quoted(first) + " is used twice; give each its own name";
        if (code == "label-kind")
            return "the label " + quoted(first) + " must start with \"" + second + ":\" here, as in {#" + second +
                   ":name}";
        if (code == "reference-kind")
            return "the cross reference @" + first + " must start with @fig:, @tbl:, @eq: or @sec:";
        if (code == "no-bibliography")
            return "@" + first +
                   " cites literature, but there is no \"bibliography: references.bib\" in the header; name one, or "
                   "write \\@" +
                   first + " for the text itself";
        if (code == "unknown-citation")
            return "the bibliography has no entry " + quoted(first) + suggestion(first, split_at(second, ' '));
        if (code == "diagram") return "in this block diagram " + quoted(fields[2]) + ": " + first;
        if (code == "unknown-drawing")
            return "there is no drawing " + quoted(first) + suggestion(first, split_at(second, ' ')) + "; there are " +
                   replaced(second, " ", ", ");
        if (code == "drawing-content")
            return "the drawing " + quoted(first) + " may hold nothing but one line with its caption";
        if (code == "choice") return "in the question " + quoted(fields[2]) + ": " + first;
        if (code == "unknown-measure")
            return "there is no measure " + quoted(first) + suggestion(first, split_at(second, ' ')) +
                   "; dynlab help measures lists them";
        if (code == "bibliography") return "the bibliography cannot be read: " + first;
        if (code == "latex")
            return "the LaTeX command " + first +
                   " would be printed as it stands; formulas stand between dollar signs, text is written in Markdown "
                   "(::: pagebreak, {#fig:name} and @fig:name, *italic*, **bold**)";
        if (code == "figure-not-alone")
            return "the figure " + quoted(first) + " must stand alone, with an empty line before and after it";
        if (code == "table-content")
            return "the table block " + quoted(first) + " may hold nothing but one line with its caption";
        if (code == "table-width")
            return "the table " + quoted(first) + " with its " + second +
                   " columns is too wide for the page; report fewer columns or shorter cells";
        if (code == "nested-text")
            return "the text " + quoted(first) +
                   " contains a text slot; a text written by a script cannot show another";
        if (code == "mathematics") return refused_in_formula(first, second, third);
        if (code == "raw") return "HTML such as " + first + " is not possible in documents; use Markdown instead";
        if (code == "raw-attribute")
            return "raw output marked " + first + " is not possible in documents; use Markdown instead";
        if (code == "link")
            return "the link " + quoted(first) + " must start with https://, http://, mailto: or # (a section's name)";
        if (code == "attribute") return "the attribute " + quoted(first) + " is not possible on " + second;
        if (code == "width")
            return "the width " + quoted(first) + " must be a percentage, cm or mm, such as 60% or 8cm";
        if (code == "column-width")
            return "a column needs its width in percent, as in ::: {.column width=60%}, not " + quoted(first);
        if (code == "not-a-column")
            return "a block ::: columns holds nothing but blocks ::: {.column width=50%}, which occur nowhere else";
        return unknown_class(code, first, second);
    }

  private:
    std::string no_entry(const std::string& kind, const std::string& name) const {
        const std::vector<std::string> names = names_of(record_, kind);
        std::string sentence = "the script reported no " + kind + " " + quoted(name);
        if (const auto near = nearest_word(name, names)) return sentence + "; did you mean " + quoted(*near) + "?";
        if (names.empty()) return sentence + " (it reported no " + kind + " at all)";
        sentence += "; it reported";
        for (const std::string& known : names) sentence += (known == names.front() ? " " : ", ") + known;
        return sentence;
    }

    /// `known`: the names of all commands that are allowed, with spaces between them.
    static std::string refused_in_formula(const std::string& kind, const std::string& written,
                                          const std::string& known) {
        if (kind == "comment")
            return "a percent sign in a formula is written \\%, as % would hide the rest of the line";
        if (kind == "environment")
            return "the environment " + written +
                   " is not allowed in formulas; there are matrix (with b, p, v, V), array, cases, aligned, gathered, "
                   "split and the others of amsmath";
        static const std::set<std::string> numbering = {"\\label", "\\ref",   "\\eqref",   "\\pageref",
                                                        "\\tag",   "\\notag", "\\nonumber"};
        const std::string refusal = "the command " + written + " is not allowed in formulas";
        if (numbering.contains(written)) return refusal + ": number a formula with {#eq:name} after it";
        const auto near = nearest_word(written.substr(1), split_at(known, ' '));
        return refusal + ", which reach no files and make no macros: only commands that set mathematics are" +
               (near ? "; did you mean \\" + *near + "?" : "");
    }

    std::string dangling(const std::string& label) const {
        std::vector<std::string> labels;
        for (std::size_t at = markdown_.text.find("{#"); at != std::string::npos;
             at = markdown_.text.find("{#", at + 1)) {
            const std::size_t end = markdown_.text.find_first_of("} \n", at);
            labels.push_back(markdown_.text.substr(at + 2, end == std::string::npos ? end : end - at - 2));
        }
        const std::string nothing = "the cross reference @" + label + " points to nothing: ";
        if (std::find(labels.begin(), labels.end(), label) != labels.end())
            return nothing + "{#" + label + "} names nothing that is shown";
        return nothing + "there is no {#" + label + "}" + suggestion(label, labels);
    }

    static std::string unknown_class(const std::string& code, const std::string& name, const std::string& text) {
        if (code == "division-class") {
            if (name.empty())
                return "a ::: block needs a class: table, text, note, warning, exercise, columns, column, "
                       "block-diagram, choice, drawing, references, measures or pagebreak";
            return "the block class " + quoted(name) + " is not known" +
                   suggestion(name,
                              {"table", "text", "note", "warning", "exercise", "columns", "column", "block-diagram",
                               "choice", "drawing", "references", "measures", "pagebreak", "cells"}) +
                   "; known are table, text, cells, note, warning, exercise, columns, column, block-diagram, "
                   "choice, drawing, references, measures, pagebreak";
        }
        if (code == "code-class")
            return "the slot `" + text + "`{." + name + "} has an unknown class; values are written `" + text +
                   "`{.value}";
        if (code == "block-class") return "the class " + quoted(name) + " of a code block is not a known language";
        if (code == "span-class")
            return "the class " + quoted(name) + " of a bracketed text is not known; write the text without it";
        return "the document filter reports " + code + " " + name;
    }

    const MarkdownText& markdown_;
    const RunRecord& record_;
};

/// A line of Pandoc's own, such as "[WARNING] Could not convert TeX math ...": something would be missing.
void add_pandoc_warning(const std::string& line, const SourceLine& where, Complaints& complaints) {
    const std::string sign = "[WARNING] ";
    complaints.add(where, "Pandoc reports: " + (line.starts_with(sign) ? line.substr(sign.size()) : line));
}

/// The formula named in "Could not convert TeX math FORMULA, rendering as TeX:".
std::string formula_in(const std::string& line) {
    const std::string before = "TeX math ", after = ", rendering as TeX";
    const std::size_t start = line.find(before), end = line.find(after);
    if (start == std::string::npos || end == std::string::npos) return {};
    return trimmed(line.substr(start + before.size(), end - start - before.size()));
}

Counts counts_in(const std::vector<std::string>& fields) {
    Counts counts{};
    for (std::size_t i = 0; i < counts.size() && i + 2 < fields.size(); ++i) counts[i] = std::stoi(fields[i + 2]);
    return counts;
}

/// Whether the line tells of a chunk.
bool read_chunk_message(const std::vector<std::string>& fields, ChunkMessages& chunks) {
    if (fields[0] == "dynlab:chunk" && fields.size() > 1)
        chunks.begin[std::stoi(fields[1])] = counts_in(fields);
    else if (fields[0] == "dynlab:chunk-end" && fields.size() > 1)
        chunks.end[std::stoi(fields[1])] = counts_in(fields);
    else if (fields[0] == "dynlab:label" && fields.size() == 4)
        chunks.labels[std::stoi(fields[1])][fields[2]] = fields[3];
    else
        return false;
    return true;
}

}  // namespace

FilterMessages read_filter_messages(const std::string& error_output, const MarkdownText& markdown,
                                    const std::filesystem::path& template_file, const RunRecord& record,
                                    Complaints& complaints) {
    FilterMessages messages;
    const Sentences sentences(markdown, record);
    for (const std::string& line : lines_of(error_output)) {
        const std::vector<std::string> fields = split_at(line, '\t');
        if (fields[0] == "dynlab:use" && fields.size() == 4) {
            messages.pictures.push_back({std::stoi(fields[1]), fields[2] == "figure", fields[3]});
        } else if (read_chunk_message(fields, messages.chunks)) {
            continue;
        } else if (fields[0] == "dynlab:gap" && fields.size() >= 3) {
            messages.gaps.add(find_in(markdown, fields[2], template_file), sentences.of(fields));
        } else if (fields[0] == "dynlab:error" && fields.size() >= 3) {
            const int occurrence = fields[1] == "duplicate-label" ? 2 : 1;
            complaints.add(find_in(markdown, fields[2], template_file, occurrence), sentences.of(fields));
        } else if (!is_blank(line) && line[0] != ' ') {
            add_pandoc_warning(line, find_in(markdown, formula_in(line), template_file), complaints);
        }
    }
    return messages;
}

}  // namespace dynlab::inline documents
