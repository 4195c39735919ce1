#include "scripting/lint/lint.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "documents/error.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "scripting/answers/answer_value.h"
#include "scripting/conversions/option_words.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/lint/function_forms.h"
#include "scripting/lint/script_walk.h"
#include "scripting/runtime/errors.h"
#include "scripting/runtime/shown_expressions.h"
#include "scripting/source/lua_reader.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

constexpr const char* kNamesOfLibrary = R"(
for name, value in pairs(dynlab) do
  print(name)
  if type(value) == "table" and name ~= "dynlab" and name ~= "_G" then
    for member in pairs(value) do print(name .. " " .. member) end
  end
end)";

/// Collects what is found in one script.
class Linter {
  public:
    Linter(const std::string& source, const std::filesystem::path& file, const std::vector<std::string>& more_names)
        : source_(source), file_(file), more_names_(more_names) {
        for (std::size_t end = source.find('\n'); end != std::string::npos; end = source.find('\n', end + 1))
            line_begins_.push_back(end + 1);
    }

    std::vector<LintIssue> findings() {
        read_header();
        if (is_lua()) look_at_names();
        std::ranges::stable_sort(found_, [](const LintIssue& one, const LintIssue& other) {
            return std::pair(one.line, one.column) < std::pair(other.line, other.column);
        });
        return std::move(found_);
    }

  private:
    void add(std::size_t offset, const char* kind, Message message) {
        const auto behind = std::ranges::upper_bound(line_begins_, offset);
        const std::size_t begin = *std::prev(behind);
        const auto characters = std::count_if(source_.begin() + static_cast<std::ptrdiff_t>(begin),
                                              source_.begin() + static_cast<std::ptrdiff_t>(offset),
                                              [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
        found_.push_back({static_cast<int>(behind - line_begins_.begin()), static_cast<int>(characters) + 1, kind,
                          std::move(message)});
    }

    /// Where the words of a line begin.
    std::size_t offset_of_line(int line) const {
        std::size_t begin = 0;
        for (int i = 1; i < line && begin < source_.size(); ++i) {
            const std::size_t end = source_.find('\n', begin);
            begin = end == std::string::npos ? source_.size() : end + 1;
        }
        return std::min(source_.find_first_not_of(" \t", begin), source_.size());
    }

    void read_header() {
        try {
            header_ = parse_percent_script(source_, file_).header;
        } catch (const DocumentError& error) {
            add(offset_of_line(std::max(error.place().line, 1)), "header", error.sentence());
        }
    }

    bool is_lua() {
        const std::string read = with_shown_expressions(source_, shown_calls());
        LuaReader reader;
        if (const auto misread = misread_line_of(read)) {
            add(offset_of_line(misread->line), "syntax", misread->sentence);
            return false;
        }
        const auto error = reader.error_of(read);
        if (!error) return true;
        const PlacedMessage reported = syntax_error(*error, source_);
        const std::size_t end = source_.find_last_not_of(" \t\r\n") + 1;  // a missing token is reported there
        const std::size_t place = std::min(offset_of_line(std::max(reported.line, 1)), end),
                          stop = stopping_place(reader);
        const bool same_line = stop >= place && source_.find('\n', place) >= stop;
        add(same_line ? stop : place, "syntax", reported.message);
        return false;
    }

    /// Where Lua stops reading: the first token with which the text before it is wrong, and not only unfinished.
    std::size_t stopping_place(LuaReader& reader) const {
        const std::vector<LuaToken> tokens = lua_tokens(source_);
        const auto stops_at = [&](std::size_t last) {
            const auto error = reader.error_of(source_.substr(0, tokens[last].end()));
            return error && (error->find("near <eof>") == std::string::npos ||
                             error->find("unfinished string") != std::string::npos);
        };
        std::size_t good = 0, bad = tokens.size();
        while (good < bad) {
            const std::size_t middle = (good + bad) / 2;
            if (stops_at(middle))
                bad = middle;
            else
                good = middle + 1;
        }
        return bad < tokens.size() ? tokens[bad].begin : source_.size();
    }

    void look_at_names() {
        const WalkedScript walked = walk_script(source_);
        std::vector<std::string> names = more_names_;
        std::set<std::string> own(names.begin(), names.end());
        for (const auto& [name, members] : library_names()) names.push_back(name);
        for (const GlobalUse& use : walked.globals)
            if (use.written && own.insert(use.name).second) names.push_back(use.name);
        names.insert(names.end(), walked.locals.begin(), walked.locals.end());
        for (const GlobalUse& use : walked.globals) look_at_name(use, own, names);
        for (const WrittenCall& call : walked.calls)
            if (!own.contains(call.function)) look_at_options(call);
        look_at_answers(walked.calls);
    }

    void look_at_name(const GlobalUse& use, const std::set<std::string>& own, const std::vector<std::string>& names) {
        const auto known = library_names().find(use.name);
        if (known == library_names().end()) {
            if (!own.contains(use.name) && !present_name(use.name).empty())
                add(use.begin, "earlier-name", renamed(use.name));
            else if (!own.contains(use.name))
                add(use.begin, "unknown-name", unknown_name(use.name, line_at(use.begin), names));
            return;
        }
        if (use.written) return add(use.begin, "library-name", replaced_name(use.name));
        const std::vector<std::string>& members = known->second;
        const bool table = !members.empty() && !own.contains(use.name);
        if (!table || use.member.empty() || std::ranges::find(members, use.member) != members.end()) return;
        const bool by_itself = find_function(use.member) != nullptr;
        add(use.member_begin, "unknown-name", unknown_member(use.name, use.member, by_itself, members));
    }

    std::string line_at(std::size_t offset) const {
        return line_of(source_, 1 + static_cast<int>(std::count(
                                        source_.begin(), source_.begin() + static_cast<std::ptrdiff_t>(offset), '\n')));
    }

    void look_at_options(const WrittenCall& call) {
        const std::string function = call.function.starts_with("dynlab.") ? call.function.substr(7) : call.function;
        if (call.arguments.empty() || call.arguments.back().kind != WrittenArgument::Kind::kTable) return;
        const FunctionEntry* const entry = find_function(function);
        if (entry == nullptr || entry->options.empty()) return;
        const std::optional<std::size_t> place = place_of_options(*entry);
        if (!place || call.arguments.size() <= *place) return;
        for (const WrittenKey& key : call.arguments.back().keys)
            if (find_option(entry->options, key.name) == nullptr)
                add(key.begin, "unknown-option",
                    Message("{}: {}", function, unknown_option(key.name, option_names(entry->options))));
    }

    void look_at_answers(const std::vector<WrittenCall>& calls) {
        if (header_.answers.empty()) return;
        std::vector<std::string> declared;
        for (const ExpectedAnswer& answer : header_.answers) declared.push_back(answer.name);
        const std::set<std::string> known(declared.begin(), declared.end());
        std::set<std::string> given;
        bool computed = false;  // a name that only a run knows
        for (const WrittenCall& call : calls) {
            if (call.function != "answer" || call.arguments.empty()) continue;
            const WrittenArgument& name = call.arguments.front();
            computed = computed || name.kind != WrittenArgument::Kind::kText;
            if (name.kind != WrittenArgument::Kind::kText) continue;
            given.insert(name.text);
            if (!known.contains(name.text)) add(name.begin, "unknown-answer", undeclared_answer(name.text, declared));
        }
        if (computed) return;
        const std::map<std::string, std::size_t> places = declarations();
        for (const std::string& name : declared)
            if (!given.contains(name))
                add(places.contains(name) ? places.at(name) : 0, "unused-answer",
                    Message("the script never submits the answer \"{}\"; write answer(\"{}\", ...)", name, name));
    }

    /// Where the header names each answer: there may be thousands, so its lines are read once.
    std::map<std::string, std::size_t> declarations() const {
        std::map<std::string, std::size_t> places;
        bool answers = false;
        for (const std::size_t begin : line_begins_) {
            const std::string_view line = std::string_view(source_).substr(begin);
            answers = answers || line.starts_with("-- answers:");
            if (!answers || !line.starts_with("--")) continue;
            const std::size_t name = line.find_first_not_of(" \t", 2), end = line.find_first_of(":\n", 2);
            if (name < end && end != std::string_view::npos)
                places.try_emplace(trimmed(line.substr(name, end - name)), begin + name);
        }
        return places;
    }

    const std::string& source_;
    const std::filesystem::path& file_;
    const std::vector<std::string>& more_names_;
    ScriptHeader header_;
    std::vector<std::size_t> line_begins_ = {0};
    std::vector<LintIssue> found_;
};

LibraryNames read_library_names() {
    GnuplotRenderer renderer;
    Runtime runtime({}, renderer);
    LibraryNames names;
    for (const auto& [cell, pieces] : runtime.run_code(kNamesOfLibrary, "names").outputs)
        for (const CellOutput& piece : pieces)
            for (const std::string& line : lines_of(piece.printed)) {
                const std::size_t space = line.find(' ');
                std::vector<std::string>& members = names[line.substr(0, space)];
                if (space != std::string::npos) members.push_back(line.substr(space + 1));
            }
    return names;
}

}  // namespace

const LibraryNames& library_names() {
    static const LibraryNames names = read_library_names();
    return names;
}

std::vector<LintIssue> lint_script(const std::string& source, const std::filesystem::path& file,
                                   const std::vector<std::string>& more_names) {
    return Linter(source, file, more_names).findings();
}

}  // namespace dynlab::inline scripting
