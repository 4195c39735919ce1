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

Message noun_of(const std::string& kind) {
    if (kind == "value") return Message("value");
    if (kind == "table") return Message("table");
    if (kind == "figure") return Message("figure");
    return Message("text");
}

/// What an attribute is not possible on; `name`: the class of a block.
Message element_named(const std::string& kind, const std::string& name) {
    if (kind == "picture") return Message("a picture");
    if (kind == "heading") return Message("a heading");
    if (kind == "block") return Message("a block of class {}", name);
    if (kind == "code") return Message("code");
    if (kind == "code-block") return Message("a code block");
    return kind == "link" ? Message("a link") : Message("a span");
}

/// What report_templates/filters/diagram.lua reports.
Message wrong_in_diagram(const std::string& code, const std::string& first, const std::string& second) {
    if (code == "list")
        return Message(
            "a block diagram must be a list of nodes and arrows, followed by at most one line with the caption");
    if (code == "node") return Message("a node must have the form NAME = KIND COLUMN ROW: label");
    if (code == "kind") return Message("unknown kind \"{}\"; the kinds are block, sum, signal and branch", first);
    if (code == "place") return Message("column and row must be whole numbers from 1 to {}", first);
    if (code == "node-twice") return Message("the node {} is defined twice", first);
    if (code == "most-nodes") return Message("a diagram can have at most {} nodes; split the diagram", first);
    if (code == "sign") return Message("between two nodes, write ->, -| or |-, not {}", first);
    if (code == "no-node")
        return Message("the node {} is not defined above this line; define nodes before arrows", first);
    if (code == "arrow") return Message("an arrow must connect two nodes, as in u -> G");
    if (code == "not-straight")
        return Message(
            "the arrow -> requires {} and {} in different cells of one row or one column; "
            "move a node, or write -| or |-",
            first, second);
    return Message(
        "formulas and formatted text are allowed only in labels; "
        "write names, numbers and arrows first, then a colon and the label");
}

/// What report_templates/filters/choice.lua reports.
Message wrong_in_choice(const std::string& code) {
    if (code == "list")
        return Message(
            "a choice must consist of a question and a list of options: - [x] for a correct option, - [ ] for a wrong "
            "option");
    if (code == "option")
        return Message(
            "each option must start with [x] or [ ], and a separate, indented paragraph must explain why the option is "
            "correct or wrong");
    return Message("a choice needs at least two options, including a correct option");
}

/// Turns the filter's codes into sentences. Fields: [0] the sign, [1] code, [2] text to look for, [3...] details.
class Sentences {
  public:
    Sentences(const MarkdownText& markdown, const RunRecord& record) : markdown_(markdown), record_(record) {}

    Message of(const std::vector<std::string>& fields) const {
        const auto detail = [&](std::size_t i) { return i + 3 < fields.size() ? fields[i + 3] : std::string(); };
        const std::string& code = fields[1];
        const std::string first = detail(0), second = detail(1), third = detail(2);
        if (code == "no-entry") return no_entry(first, second);
        if (code == "wrong-kind")
            return Message(
                "\"{}\" is a {} in the run results, but this slot expects a {}. Use the slot for a {}, or change "
                "report.value, report.table, report.figure or report.text",
                second, noun_of(third), noun_of(first), noun_of(third));
        if (code == "dangling") return dangling(first);
        if (code == "duplicate-label") return Message("the label \"{}\" is used twice; use different labels", first);
        if (code == "label-kind")
            return Message("the label \"{}\" must start with \"{}\", as in {#{}:name}", first, second + ":", second);
        if (code == "reference-kind")
            return Message(
                "the cross-reference @{} must start with @fig:, @tbl:, @eq: or @sec:. A literature key with a colon "
                "must be in the bibliography that the header names",
                first);
        if (code == "no-bibliography")
            return Message(
                "@{} cites literature, but the header declares no bibliography. Put a BibTeX file, such as "
                "references.bib, in the same folder. Add \"bibliography: references.bib\" to the header (in a script: "
                "\"-- bibliography: references.bib\" between two lines \"-- ---\" at the start). To print the text "
                "itself, write \\@{}",
                first, first);
        if (code == "bibliography") return Message("the bibliography cannot be read: {}", first);
        if (code == "unknown-citation") {
            const auto near = nearest_word(first, split_at(second, ' '));
            return near ? Message("the bibliography has no entry \"{}\"; did you mean \"{}\"?", first, *near)
                        : Message("the bibliography has no entry \"{}\"; add the entry, or correct the key", first);
        }
        if (code == "slot-in-formula")
            return Message(
                "the formula contains `{}`, which would be printed with its backticks; write a value in a formula as "
                "`{}`{.value}, without a space",
                first, first);
        if (code == "slot-form")
            return Message("\"{}\" is not a value slot; write `name`{.value}, with backticks and without a space",
                           first);
        if (code == "slot-in-address")
            return Message(
                "the address \"{}\" contains a value slot, which is not filled in; write the complete address, or "
                "write this paragraph in the script with report.text",
                first);
        if (code == "pasted-picture")
            return Message(
                "the picture \"{}\" was pasted into the notebook, and a report cannot read pasted pictures. Save the "
                "picture as a file next to the notebook and give the file name in the text",
                first);
        if (code == "mathematics") return refused_in_formula(first, second, third);
        if (code == "latex")
            return Message(
                "the LaTeX command {} would be printed unchanged; put formulas between dollar signs and write text in "
                "Markdown {}",
                first, "(::: pagebreak, {#fig:name} and @fig:name, *italic*, **bold**)");
        if (code == "raw") return Message("HTML such as {} is not supported in documents; use Markdown instead", first);
        if (code == "raw-attribute")
            return Message("raw output marked {} is not supported in documents; use Markdown instead", first);
        if (code == "link")
            return Message("the link \"{}\" must start with https://, http://, mailto: or # (a section's name)", first);
        if (code == "attribute")
            return Message("the attribute \"{}\" is not supported on {}; remove the attribute", first,
                           element_named(second, third));
        return of_block(code, fields[2], first, second, third);
    }

  private:
    static Message of_block(const std::string& code, const std::string& needle, const std::string& first,
                            const std::string& second, const std::string& third) {
        if (code == "diagram")
            return Message("in the block diagram \"{}\": {}", needle, wrong_in_diagram(first, second, third));
        if (code == "choice") return Message("in the question \"{}\": {}", needle, wrong_in_choice(first));
        if (code == "unknown-drawing") {
            const std::vector<std::string> known = split_at(second, ' ');
            const auto near = nearest_word(first, known);
            return near ? Message("unknown drawing \"{}\"; did you mean \"{}\"? The drawings are {}", first, *near,
                                  listed(known))
                        : Message("unknown drawing \"{}\"; the drawings are {}", first, listed(known));
        }
        if (code == "drawing-content")
            return Message("the drawing \"{}\" may contain only one line with its caption", first);
        if (code == "unknown-measure") {
            const auto near = nearest_word(first, split_at(second, ' '));
            return near
                       ? Message(
                             "unknown measure \"{}\"; did you mean \"{}\"? For a list of the measures, run dynlab help "
                             "measures",
                             first, *near)
                       : Message("unknown measure \"{}\"; for a list of the measures, run dynlab help measures", first);
        }
        if (code == "figure-not-alone")
            return Message("the figure \"{}\" must be separate, with an empty line before and after it", first);
        if (code == "table-content")
            return Message("the table block \"{}\" may contain only one line with its caption", first);
        if (code == "table-width")
            return Message(
                "the table \"{}\" with {} columns is too wide for the page; report fewer columns or shorter cells",
                first, second);
        if (code == "nested-text")
            return Message("the text \"{}\" contains a text slot, which is not supported in text from a script", first);
        if (code == "width")
            return Message("the width \"{}\" must be a percentage or a length in cm or mm, such as 60% or 8cm", first);
        if (code == "column-width")
            return Message("a column needs a width in percent, as in ::: {.column width=60%}, not \"{}\"", first);
        if (code == "not-a-column")
            return Message(
                "a block ::: columns may contain only blocks ::: {.column width=50%}, which are allowed only there");
        return unknown_class(code, first, second);
    }

    Message no_entry(const std::string& kind, const std::string& name) const {
        const std::vector<std::string> names = names_of(record_, kind);
        const Message noun = noun_of(kind);
        if (const auto near = nearest_word(name, names))
            return Message("the script reported no {} \"{}\"; did you mean \"{}\"?", noun, name, *near);
        if (names.empty())
            return Message("the script reported no {} \"{}\"; add a call of report.{} to the script", noun, name, kind);
        return Message("the script reported no {} \"{}\"; it reported {}", noun, name, listed(names));
    }

    /// `known`: the names of all commands that are allowed, with spaces between them.
    static Message refused_in_formula(const std::string& kind, const std::string& written, const std::string& known) {
        if (kind == "comment")
            return Message("write a percent sign in a formula as \\%, because % hides the rest of the line");
        if (kind == "environment")
            return Message(
                "the environment {} is not allowed in formulas. The allowed environments are matrix (also with the "
                "prefix b, p, v or V), array, cases, aligned, gathered, split and the other environments of amsmath",
                written);
        static const std::set<std::string> numbering = {"\\label", "\\ref",   "\\eqref",   "\\pageref",
                                                        "\\tag",   "\\notag", "\\nonumber"};
        if (numbering.contains(written))
            return Message("the command {} is not allowed in formulas: to number a formula, write {#eq:name} after it",
                           written);
        if (const auto near = nearest_word(written.substr(1), split_at(known, ' ')))
            return Message(
                "the command {} is not allowed in formulas. Only commands that typeset mathematics are allowed, not "
                "commands that read files or define macros; did you mean {}?",
                written, "\\" + *near);
        return Message(
            "the command {} is not allowed in formulas. Only commands that typeset mathematics are allowed, not "
            "commands that read files or define macros",
            written);
    }

    Message dangling(const std::string& label) const {
        std::vector<std::string> labels;
        for (std::size_t at = markdown_.text.find("{#"); at != std::string::npos;
             at = markdown_.text.find("{#", at + 1)) {
            const std::size_t end = markdown_.text.find_first_of("} \n", at);
            labels.push_back(markdown_.text.substr(at + 2, end == std::string::npos ? end : end - at - 2));
        }
        if (std::find(labels.begin(), labels.end(), label) != labels.end())
            return Message(
                "the cross-reference @{} has no target: the label {#{}} does not belong to an element that is shown; "
                "show the element, or remove the reference",
                label, label);
        if (const auto near = nearest_word(label, labels))
            return Message("the cross-reference @{} has no target: {#{}} is missing; did you mean \"{}\"?", label,
                           label, *near);
        return Message(
            "the cross-reference @{} has no target: add the label {#{}} to a figure, table, formula or heading", label,
            label);
    }

    static Message unknown_class(const std::string& code, const std::string& name, const std::string& text) {
        if (code == "division-class") {
            static const std::vector<std::string> kKnown = {
                "table",  "text",          "cells",  "note",    "warning",    "exercise", "columns",
                "column", "block-diagram", "choice", "drawing", "references", "measures", "pagebreak"};
            if (name.empty()) return Message("a ::: block needs a class; the classes are {}", listed(kKnown));
            const auto near = nearest_word(name, kKnown);
            return near ? Message("unknown block class \"{}\"; did you mean \"{}\"? The classes are {}", name, *near,
                                  listed(kKnown))
                        : Message("unknown block class \"{}\"; the classes are {}", name, listed(kKnown));
        }
        if (code == "code-class")
            return Message("the slot `{}`{.{}} has an unknown class; write a value as `{}`{.value}", text, name, text);
        if (code == "block-class") return Message("unknown language \"{}\" of a code block; omit the language", name);
        if (code == "span-class")
            return Message("unknown class \"{}\" of bracketed text; write the text without the class", name);
        return Message("the document filter reports an unknown problem: {} {}", code, name);
    }

    const MarkdownText& markdown_;
    const RunRecord& record_;
};

/// A line of Pandoc's own, such as "[WARNING] Could not convert TeX math ...": something would be missing.
void add_pandoc_warning(const std::string& line, const Place& where, Complaints& complaints) {
    const std::string sign = "[WARNING] ";
    complaints.add(where, Message("Pandoc reports: {}", line.starts_with(sign) ? line.substr(sign.size()) : line));
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

/// Whether the line is a message about a chunk.
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
