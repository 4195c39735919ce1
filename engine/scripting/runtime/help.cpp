#include "scripting/runtime/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

#include "base/reader.h"
#include "documents/text_lines.h"
#include "numerics/error.h"
#include "platform/spelling.h"
#include "platform/text/small_letters.h"
#include "scripting/runtime/help_layout.h"
#include "scripting/runtime/matlab_hints.h"

namespace dynlab::inline scripting {
namespace {

using FunctionList = std::vector<const FunctionEntry*>;

constexpr std::size_t kSummaryColumn = 21, kMaxFound = 20;

/// Terms of other programs and of textbooks, and the functions that they mean.
struct Synonym {
    std::string_view term, names;
};
constexpr Synonym kSynonyms[] = {{"pole zero map", "pzmap"},
                                 {"transport delay", "delayest tfsrivc procsrivc"},
                                 {"dead time", "delayest tfsrivc procsrivc"},
                                 {"pid", "simloop feedback margin"},
                                 {"root locus", "feedback pole"},
                                 {"spike", "filloutliers"},
                                 {"crop", "iddata"},
                                 {"psd", "spa etfe"},
                                 {"ode", "idgrey greyest"},
                                 {"overfitting", "crossvalidate srivcstruc"},
                                 {"hold out", "crossvalidate compare"},
                                 {"curve fitting", "polyfit polyfit_report"},
                                 {"moving average", "idfilt armax"},
                                 {"two curves", "plot"},
                                 {"procest", "procsrivc"},
                                 {"idtf", "tf"},
                                 {"variant", "plant"}};

std::vector<std::string> help_names(const FunctionList& functions) {
    std::vector<std::string> names;
    for (const FunctionEntry* entry : functions) names.emplace_back(entry->name);
    for (const HelpPage& page : help_pages()) names.emplace_back(page.name);
    return names;
}

const FunctionEntry* entry_of(std::string_view name, const FunctionList& functions) {
    const auto found = std::ranges::find_if(functions, [&](const auto* e) { return e->name == name; });
    return found == functions.end() ? nullptr : *found;
}

std::string help_row(const std::string& name, const std::string& summary, std::size_t width) {
    return fmt::format("  {:<18} {}\n", name, filled(summary, width, kSummaryColumn));
}

/// Where a word of the text begins with `word`, both in lower case.
bool begins_a_word(const std::string& text, const std::string& word) {
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if (at == 0 || !std::isalpha(static_cast<unsigned char>(text[at - 1]))) return true;
    return false;
}

/// Whether the text contains `word` with neither a letter nor an underscore beside it.
bool contains_word(std::string_view text, std::string_view word) {
    const auto continues = [&](std::size_t i) {
        return i < text.size() && (std::isalpha(static_cast<unsigned char>(text[i])) || text[i] == '_');
    };
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (!(at > 0 && continues(at - 1)) && !continues(at + word.size())) return true;
    return false;
}

bool begin_words(const std::string& text, const std::vector<std::string>& words) {
    return std::ranges::all_of(words, [&](const auto& word) { return begins_a_word(text, word); });
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

struct Found {
    int rank;  ///< 0 in the name, 1 in the summary, 2 whole words of the page, 3 beginnings of its words
    std::string name, summary;
};

std::vector<Found> pages_about(const std::string& asked, const FunctionList& functions) {
    std::vector<Found> found;
    const std::string small = in_small_letters(asked);
    const std::vector<std::string> words = words_of(small);
    if (words.empty()) return found;
    const auto is_meant = [&](const std::string& name) {
        return std::ranges::any_of(kSynonyms, [&](const Synonym& one) {
            return contains_word(one.names, name) && begin_words(small, words_of(std::string(one.term)));
        });
    };
    const auto look = [&](const std::string& name, const std::string& summary, std::string_view page) {
        const std::string text = in_small_letters(std::string(page));
        const auto is_whole = [&](const std::string& word) { return contains_word(text, word); };
        const int rank = is_meant(name)                                  ? 0
                         : begin_words(in_small_letters(name), words)    ? 0
                         : begin_words(in_small_letters(summary), words) ? 1
                         : std::ranges::all_of(words, is_whole)          ? 2
                         : begin_words(text, words)                      ? 3
                                                                         : 4;
        if (rank < 4) found.push_back({rank, name, summary});
    };
    for (const FunctionEntry* entry : functions) {
        const auto page = find_help_page(entry->name);
        look(entry->name, entry->summary, page ? page_text(*page, entry) : std::string());
    }
    for (const HelpPage& page : help_pages())
        if (entry_of(page.name, functions) == nullptr) look(std::string(page.name), subject_of(page), page.text);
    std::ranges::stable_sort(found, {}, &Found::rank);
    return found;
}

std::string list_of(const std::vector<Found>& found, std::size_t width) {
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), kMaxFound); ++i)
        text += help_row(found[i].name, found[i].summary, width);
    if (found.size() > kMaxFound) text += fmt::format("  and {} more\n", found.size() - kMaxFound);
    return text + "\nhelp NAME shows a page.\n";
}

/// What is written here for a function of MATLAB or another program, and the pages of what it calls.
std::string matlab_answer(const std::string& name, const std::string& hint, const FunctionList& functions,
                          std::size_t width) {
    std::string text = filled(fmt::format("{} is a name of another program: {}.", name, hint), width) + '\n';
    static const RE2 kCall("([a-z][a-z_0-9.]*)[({]", RE2::Latin1);
    std::string called;
    std::vector<std::string> shown;
    for (re2::StringPiece rest = hint; RE2::FindAndConsume(&rest, kCall, &called);) {
        const FunctionEntry* entry = entry_of(called, functions);
        if (entry == nullptr || std::ranges::find(shown, entry->name) != shown.end()) continue;
        text += (shown.empty() ? "\n" : "") + help_row(entry->name, entry->summary, width);
        shown.emplace_back(entry->name);
    }
    return text + "\nhelp matlab lists the equivalents of MATLAB.\n";
}

struct ObjectWords {
    std::string_view word, page;
};
constexpr std::array kObjects = {ObjectWords{"iddata", "iddata"}, ObjectWords{"data", "iddata"},
                                 ObjectWords{"fig", "plot"},      ObjectWords{"figure", "plot"},
                                 ObjectWords{"vector", "vector"}, ObjectWords{"v", "vector"},
                                 ObjectWords{"matrix", "matrix"}, ObjectWords{"A", "matrix"}};

/// What the page of an object says where it names the method, `name` being "iddata.split" or "fig:add".
std::optional<std::string> method_answer(const std::string& name, std::size_t width) {
    const auto dot = name.find_last_of(".:");
    if (dot == std::string::npos) return std::nullopt;
    const std::string object = name.substr(0, dot), method = name.substr(dot + 1);
    const auto known = std::ranges::find(kObjects, object, &ObjectWords::word);
    if (known == kObjects.end() || method.empty()) return std::nullopt;
    const auto page = find_help_page(known->page);
    const auto at = page ? page->text.find(":" + method) : std::string_view::npos;
    if (at == std::string_view::npos) return std::nullopt;
    // The item of the list of methods that begins with the call.
    const auto begin = page->text.rfind("\n- ", at) + 3;
    std::string words(
        page->text.substr(begin, std::min(page->text.find("\n\n", at), page->text.find("\n- ", at)) - begin));
    std::ranges::replace(words, '\n', ' ');
    return laid_out(fmt::format("{}\n\nhelp {} shows the complete page.\n", words, known->page), width);
}

/// The first part of the guide to Lua whose code holds the word.
std::optional<std::string> lua_answer(const std::string& word, std::size_t width) {
    static constexpr std::array kWords = {
        "and",        "break",        "do",           "else",    "elseif", "end",    "false",  "for",
        "if",         "in",           "ipairs",       "local",   "math",   "nil",    "not",    "or",
        "pairs",      "pcall",        "print",        "repeat",  "return", "string", "table",  "then",
        "tostring",   "true",         "until",        "while",   "error",  "select", "unpack", "string.format",
        "table.sort", "table.concat", "string.upper", "function"};
    if (std::ranges::find(kWords, word) == kWords.end()) return std::nullopt;
    const auto page = find_help_page("lua");
    if (!page) return std::nullopt;
    const std::string guide(page->text);
    for (auto begin = guide.find("\n## "); begin != std::string::npos;) {
        const auto end = guide.find("\n## ", begin + 1);
        const std::string part = guide.substr(begin + 1, end == std::string::npos ? end : end - begin - 1);
        const auto code = part.find("```lua");
        if (code != std::string::npos && contains_word(std::string_view(part).substr(code), word))
            return laid_out(fmt::format("`{}` is part of Lua.\n\n{}\nhelp lua shows the complete page.\n", word, part),
                            width);
        begin = end;
    }
    return laid_out(fmt::format("`{}` is part of Lua; help lua shows the basics.\n", word), width);
}

std::string text_of(const MessageId<>& description) {
    return message_text(Message(description));
}

/// "number from 0 to 1"
std::string with_bounds(const char* kind, const OptionFacts& facts) {
    const bool minimum = std::isfinite(facts.minimum), maximum = std::isfinite(facts.maximum);
    std::string text = kind;
    if (minimum && maximum) return text + fmt::format(" from {} to {}", facts.minimum, facts.maximum);
    if (minimum) text += fmt::format(", at least {}", facts.minimum);
    if (maximum) text += fmt::format(", at most {}", facts.maximum);
    return text;
}

/// The values that the option takes, in one phrase.
std::string kind_of(const OptionEntry& option) {
    switch (option.kind) {
        case ValueKind::kNumber:
            return with_bounds("number", option.facts);
        case ValueKind::kCount:
            return with_bounds("whole number", option.facts);
        case ValueKind::kFlag:
            return "true or false";
        case ValueKind::kText:
            return "text";
        case ValueKind::kVector:
            return "vector";
        case ValueKind::kTable:
            return "table";
        case ValueKind::kChoice: {
            std::vector<std::string> texts;
            for (const char* choice : option.facts.choices) texts.push_back(fmt::format("`\"{}\"`", choice));
            return fmt::format("{}", fmt::join(texts, ", "));
        }
        default:
            return "";
    }
}

/// "- `Tol` (number, default 1e-6): relative change of the parameters at which the search stops."
std::string item_of(const OptionEntry& option) {
    std::vector<std::string> facts;
    if (const std::string kind = kind_of(option); !kind.empty()) facts.push_back(kind);
    if (*option.facts.unit != '\0') facts.push_back(option.facts.unit);
    if (const std::string initial = initial_text(option); !initial.empty())
        facts.push_back(fmt::format("default `{}`", initial));
    return fmt::format("- `{}`{}: {}.\n", option.name,
                       facts.empty() ? "" : fmt::format(" ({})", fmt::join(facts, ", ")), text_of(option.description));
}

std::string items_of(const FunctionEntry& function) {
    std::string items;
    for (const ArgumentEntry& argument : function.arguments)
        items += fmt::format("- `{}`: {}.\n", argument.name, text_of(argument.description));
    for (const OptionTable& table : function.options)
        for (const OptionEntry& option : table) items += item_of(option);
    return items;
}

/// The page with the parts that the function's row declares, in the order of a reference page: summary, Syntax,
/// Description (the text below the title), Input Arguments (at the beginning of the page's own part of this name).
std::string with_row(const std::string& page, const FunctionEntry& function) {
    const std::size_t title = page.find('\n') + 1, end = std::min(page.find("\n## "), page.size());
    std::string text = page.substr(0, title) + fmt::format("\n{}.\n\n## Syntax\n\n", function.summary);
    const std::string forms = replaced(signature_text(function), "; ", "`\n\n`");
    text += fmt::format("`{}`\n\n## Description\n{}", forms, page.substr(title, end - title));
    static constexpr std::string_view kHeading = "\n## Input Arguments\n\n";
    const std::string items = items_of(function);
    std::string rest = page.substr(end);
    if (rest.starts_with(kHeading))
        rest.erase(0, kHeading.size());
    else if (!items.empty())
        rest.erase(0, 1);
    else
        return text + rest;
    return text + std::string(kHeading) + items + (items.empty() || rest.starts_with("- ") ? "" : "\n") + rest;
}

/// The text of a guide or subject, whose third line ("guide: the first hour") becomes a sentence ("The first hour.").
std::string with_subject(const HelpPage& page) {
    std::string text(page.text);
    const auto begin = text.find("\n\n") + 2, end = text.find('\n', begin);
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    if (!line.starts_with("guide: ") && !line.starts_with("subject: ")) return text;
    std::string sentence = subject_of(page) + ".";
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    return text.replace(begin, end - begin, sentence);
}

[[noreturn]] void refuse_topic(const std::string& name, const FunctionList& functions) {
    const auto near = nearest_word(name, help_names(functions));
    if (near) throw InvalidArgument("no help for '{}'; did you mean '{}'?", name, *near);
    throw InvalidArgument("no help for '{}'; help() lists all topics", name);
}

}  // namespace

std::optional<HelpPage> find_help_page(std::string_view name) {
    for (const HelpPage& page : help_pages())
        if (page.name == name) return page;
    return std::nullopt;
}

std::string page_text(const HelpPage& page, const FunctionEntry* function) {
    return function == nullptr ? with_subject(page) : with_row(std::string(page.text), *function);
}

std::string subject_of(const HelpPage& page) {
    const std::vector<std::string> lines = lines_of(page.text);
    const std::string& line = lines.size() > 2 ? lines[2] : lines[0];
    const auto colon = line.find(": ");
    return colon == std::string::npos ? line : line.substr(colon + 2);
}

std::string help_overview(const FunctionList& functions, std::size_t width) {
    std::vector<std::string_view> areas;
    for (const FunctionEntry* entry : functions)
        if (std::ranges::find(areas, entry->area) == areas.end()) areas.emplace_back(entry->area);
    std::string text;
    for (std::string_view area : areas) {
        text += fmt::format("{}\n", area);
        for (const FunctionEntry* entry : functions)
            if (entry->area == area) text += help_row(entry->name, entry->summary, width);
        text += '\n';
    }
    text += "guides\n";
    for (const HelpPage& page : help_pages())
        if (entry_of(page.name, functions) == nullptr)
            text += help_row(std::string(page.name), subject_of(page), width);
    return text +
           "\nhelp(\"lsim\") shows a function, help(\"lua\") Lua in ten minutes, help(\"matlab\") the equivalents\n"
           "of MATLAB; help(\"delay\") lists the pages that contain a word\n";
}

std::string help_text(const std::string& name, const FunctionList& functions, std::size_t width) {
    if (const std::string present(present_name(name)); !present.empty())
        return filled(message_text(renamed(name)), width) + ".\n\n" + help_text(present, functions, width);
    if (const auto page = find_help_page(name)) return laid_out(page_text(*page, entry_of(name, functions)), width);
    if (const FunctionEntry* entry = entry_of(name, functions))
        return fmt::format("{}\n  {}\n", signature_text(*entry), entry->summary);
    if (const auto method = method_answer(name, width)) return *method;
    if (const Message* const hint = matlab_name_hint(name))
        return matlab_answer(name, message_text(*hint), functions, width);
    if (const auto words = lua_answer(name, width)) return *words;
    if (const std::string small = in_small_letters(name); small != name && find_help_page(small))
        return help_text(small, functions, width);
    const std::vector<Found> found = pages_about(name, functions);
    if (name.empty() || found.empty()) refuse_topic(name, functions);
    return fmt::format("No page is called '{}'. These pages contain it:\n\n", name) + list_of(found, width);
}

std::string help_search(const std::string& word, const FunctionList& functions, std::size_t width) {
    const std::vector<Found> found = pages_about(word, functions);
    if (word.empty() || found.empty()) refuse_topic(word, functions);
    return list_of(found, width);
}

}  // namespace dynlab::inline scripting
