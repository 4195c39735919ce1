#include "scripting/runtime/matlab_hints.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "platform/utf8.h"

namespace dynlab::inline scripting {
namespace {

Message comment_form() {
    return Message("a comment starts with -- in Lua");
}
Message for_loop_form() {
    return Message("write a loop in the form: for k = 1, N do ... end");
}
Message condition_form() {
    return Message("write a condition in the form: if a > b then ... end");
}
Message named_function_form() {
    return Message("write a function in the form: function name(x) ... return y end");
}
Message inline_function_form() {
    return Message("write a function in the form: function(x) return x^2 end");
}

/// A character that word processors and printed pages use instead of a character that Lua knows.
struct ForeignCharacter {
    char32_t character;
    const char* instead;  ///< empty for one that is to be taken out
};

constexpr std::array kForeign = {
    ForeignCharacter{U'\u201c', "\""},  ForeignCharacter{U'\u201d', "\""},      ForeignCharacter{U'\u201e', "\""},
    ForeignCharacter{U'\u00ab', "\""},  ForeignCharacter{U'\u00bb', "\""},      ForeignCharacter{U'\u2018', "'"},
    ForeignCharacter{U'\u2019', "'"},   ForeignCharacter{U'\u00b4', "'"},       ForeignCharacter{U'\u2010', "-"},
    ForeignCharacter{U'\u2011', "-"},   ForeignCharacter{U'\u2012', "-"},       ForeignCharacter{U'\u2013', "-"},
    ForeignCharacter{U'\u2014', "-"},   ForeignCharacter{U'\u2212', "-"},       ForeignCharacter{U'\u00d7', "*"},
    ForeignCharacter{U'\u00b7', "*"},   ForeignCharacter{U'\u22c5', "*"},       ForeignCharacter{U'\u00f7', "/"},
    ForeignCharacter{U'\u2044', "/"},   ForeignCharacter{U'\u2264', "<="},      ForeignCharacter{U'\u2265', ">="},
    ForeignCharacter{U'\u2260', "~="},  ForeignCharacter{U'\u02c6', "^"},       ForeignCharacter{U'\u00b2', "^2"},
    ForeignCharacter{U'\u00b3', "^3"},  ForeignCharacter{U'\u221a', "sqrt(x)"}, ForeignCharacter{U'\u03c0', "math.pi"},
    ForeignCharacter{U'\u2026', "..."}, ForeignCharacter{U'\u00a0', " "},       ForeignCharacter{U'\u2009', " "},
    ForeignCharacter{U'\u202f', " "},   ForeignCharacter{U'\u200b', ""},        ForeignCharacter{U'\ufeff', ""}};

/// The line without its strings and Lua comment, so that their contents are not taken for code.
std::string code_only(const std::string& line) {
    std::string code;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line.compare(i, 2, "--") == 0) break;
        if (line[i] == '"') {
            const auto end = line.find('"', i + 1);
            if (end == std::string::npos) break;
            code += "\"\"";
            i = end;
        } else {
            code += line[i];
        }
    }
    return code;
}

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != std::string::npos;
}

bool name_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string first_word(const std::string& code) {
    const auto start = code.find_first_not_of(" \t");
    if (start == std::string::npos) return {};
    auto end = start;
    while (end < code.size() && name_character(code[end])) ++end;
    return code.substr(start, end - start);
}

/// x' with the quote right behind a name, a bracket or another quote: MATLAB's transpose.
bool has_transpose(const std::string& code) {
    for (std::size_t i = 1; i < code.size(); ++i)
        if (code[i] == '\'' && (name_character(code[i - 1]) || code[i - 1] == ')' || code[i - 1] == ']'))
            return std::count(code.begin() + static_cast<std::ptrdiff_t>(i), code.end(), '\'') % 2 == 1;
    return false;
}

/// a:b or a:s:b between two values, outside a method call.
bool has_colon_range(const std::string& code) {
    for (std::size_t i = 1; i + 1 < code.size(); ++i) {
        if (code[i] != ':' || code[i + 1] == ':' || code[i - 1] == ':') continue;
        auto next = code.find_first_not_of(' ', i + 1);
        if (next == std::string::npos) continue;
        auto end = next;
        while (end < code.size() && name_character(code[end])) ++end;
        const bool method = end > next && !std::isdigit(static_cast<unsigned char>(code[next])) && end < code.size() &&
                            (code[end] == '(' || code[end] == '{' || code[end] == '"');
        if (!method) return true;
    }
    return false;
}

/// An opening bracket where a value starts: [1 2 3].
bool has_bracket_list(const std::string& code) {
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i] != '[') continue;
        const auto before = code.find_last_not_of(" \t", i == 0 ? std::string::npos : i - 1);
        if (i == 0 || before == std::string::npos ||
            std::string_view("=(,{+-*/^").find(code[before]) != std::string_view::npos)
            return true;
    }
    return false;
}

bool ends_with(const std::string& code, std::string_view tail) {
    const auto last = code.find_last_not_of(" \t\r");
    return last != std::string::npos && last + 1 >= tail.size() &&
           code.compare(last + 1 - tail.size(), tail.size(), tail) == 0;
}

/// A single = inside an if or while condition.
bool has_assignment_condition(const std::string& code) {
    const std::string word = first_word(code);
    if (word != "if" && word != "elseif" && word != "while") return false;
    for (std::size_t i = 1; i + 1 < code.size(); ++i)
        if (code[i] == '=' && code[i + 1] != '=' &&
            std::string_view("=~<>!").find(code[i - 1]) == std::string_view::npos)
            return true;
    return false;
}

Message element_hint(const std::string& code) {
    static const RE2 kWholeLine(R"(\w[\[(]\s*(:\s*,|[\w.]+\s*,\s*:\s*[\])]))", RE2::Latin1);
    if (RE2::PartialMatch(code, kWholeLine)) return Message("row i of a matrix is A:row(i), and column j is A:col(j)");
    static const RE2 kTakenOut(R"(=\s*\[\s*\]\s*;?\s*$)", RE2::Latin1);
    if (RE2::PartialMatch(code, kTakenOut) && contains(code, ")"))
        return Message(
            "the length of a vector is fixed; v:select(mask) or v:select({1, 3}) returns the selected elements");
    if (contains(code, "[end") || contains(code, "(end"))
        return Message("the last element is x[#x]; vector{x, y} appends y to x");
    static const RE2 kTwoPlaces(R"(\w\[\s*[\w.:]+\s*,)", RE2::Latin1);
    if (RE2::PartialMatch(code, kTwoPlaces)) return Message("the element in row 1 and column 2 is A[{1, 2}]");
    if (contains(code, "?")) return Message("Lua has no '?' operator; write if ... then ... else ... end");
    static const RE2 kElementSet(R"((?:^|;)\s*(?:local\s+)?([A-Za-z_]\w*)\(([\w\s,:#]+)\)\s*=[^=])", RE2::Latin1);
    std::string name, place;
    if (RE2::PartialMatch(code, kElementSet, &name, &place))
        return contains(place, ",") ? Message("write an element of a matrix as {}[{{}}]", name, place)
                                    : Message("write an element as {}[{}]", name, place);
    static const RE2 kImaginary(R"((^|[^\w.])\d+(\.\d*)?[ij]\b)", RE2::Latin1);
    if (RE2::PartialMatch(code, kImaginary))
        return Message(
            "dynlab has no complex arithmetic; complex numbers returned by functions have the fields re, im, abs and "
            "arg");
    return {};
}

Message operator_hint(const std::string& code) {
    if (contains(code, ".*"))
        return Message("write x*y for vectors and A:times(B) for matrices, instead of x.*y and A.*B");
    if (contains(code, "./")) return Message("for vectors, write x/y instead of x./y");
    if (contains(code, ".^")) return Message("for vectors, write x^2 instead of x.^2");
    if (contains(code, "**")) return Message("write a power as x^2");
    if (contains(code, "!=") || contains(code, "<>")) return Message("write 'not equal' as ~= in Lua");
    if (contains(code, "!")) return Message("write a negation in the form: not x");
    if (contains(code, ":=")) return Message("to assign a value, write x = 3");
    if (contains(code, "&&")) return Message("write 'and' instead of '&&'");
    if (contains(code, "||")) return Message("write 'or' instead of '||'");
    static const RE2 kChange(R"(\w\s*(?://|\.\.|[-+*/%^])=[^=])", RE2::Latin1);
    if (RE2::PartialMatch(code + " ", kChange)) return Message("write x = x + 1 instead of x += 1");
    static const RE2 kPlus(R"([A-Za-z_)\]]\s*\.([-+]))", RE2::Latin1);
    std::string sign;
    if (RE2::PartialMatch(code, kPlus, &sign)) return Message("write v {} 1 instead of v .{} 1", sign, sign);
    if (contains(code, "++")) return Message("write x = x + 1 instead of x++");
    return {};
}

/// Statements and expressions of Python that have another form in Lua.
Message python_hint(const std::string& code) {
    static const RE2 kImport(R"(\s*(?:from\s+[\w.]+\s+import\b|import\s+\w).*)", RE2::Latin1),
        kNone(R"(\bis\s+(?:not\s+)?(?:None|True|False|nil|\w+\s*(?:then\b|:)))", RE2::Latin1),
        kFormat(R"(["']\s*\.\s*format\s*\()", RE2::Latin1),
        kKeys(R"(\{\s*(?:""|'[^']*'|[A-Za-z_]\w*)\s*:\s*[^:\s])", RE2::Latin1),
        kLoopInside(R"([(\[=,]\s*[^=]*\w\s+for\s+\w+\s+in\s)", RE2::Latin1),
        kChoice(R"([\w)\]]\s+if\s.*\selse\s)", RE2::Latin1);
    const std::string word = first_word(code);
    if (RE2::FullMatch(code, kImport)) return *matlab_name_hint("import");
    static const RE2 kStatement(R"(\s*[a-z]+\s+[\w"'].*)", RE2::Latin1);  // not with = 3
    if (RE2::FullMatch(code, kStatement)) {
        if (word == "class") return Message("Lua has no classes; put values and functions in a table: {gain = 2}");
        if (word == "with") return Message("scripts cannot open files; load(name) reads a data file");
        if (word == "raise") return *matlab_name_hint("raise");
        if (word == "assert") return Message("write assert(condition, \"message\")");
    }
    if (RE2::PartialMatch(code, kNone)) return Message("write x == nil or x ~= nil");
    if (RE2::PartialMatch(code, kFormat)) return Message("write string.format(\"%.3f\", x)");
    if (RE2::PartialMatch(code, kKeys)) return Message("write a table with names as {}", "{a = 1, b = 2}");
    if (RE2::PartialMatch(code, kLoopInside))
        return Message("write a loop: for i = 1, N do ... end; a function of a vector, such as v^2, needs no loop");
    if (word != "if" && word != "elseif" && RE2::PartialMatch(code, kChoice))
        return Message("write if ... then ... else ... end");
    return {};
}

Message block_hint(const std::string& code) {
    const std::string word = first_word(code);
    if ((word == "for" || word == "while") && !contains(code, " do"))
        return word == "for" ? for_loop_form() : Message("write a loop in the form: while condition do ... end");
    if ((word == "if" || word == "elseif") && !contains(code, "then")) return condition_form();
    if (word == "function" && contains(code, "=")) return named_function_form();
    if (word == "switch" || word == "case" || word == "otherwise")
        return Message("Lua has no switch: write if ... elseif ... else ... end");
    if (word == "elif" || word == "elsif") return Message("write elseif ... then");
    if (word == "def") return named_function_form();
    if (word == "const" || word == "let" || word == "var") return Message("to declare a variable, write local x = 3");
    if (word == "try" || word == "catch" || word == "except")
        return Message("write local ok, message = pcall(f) instead of try");
    if (word == "end" && contains(code, "end;"))
        return Message("one 'end' is superfluous, or the start of a block is missing");
    return {};
}

/// Commands of words alone: hold on, close all, clear x y; step G; ?lsim.
Message command_hint(const std::string& code, const std::string& near) {
    static const RE2 kAsked(R"(\s*\?\s*(\w+)\s*)", RE2::Latin1),
        kTwoWords(R"(\s*([A-Za-z_]\w*)[ \t]+(\w+(?:[./-]\w+)*)[\s;]*)", RE2::Latin1);
    std::string first, second;
    if (RE2::FullMatch(code, kAsked, &first)) return Message("to get help, write help(\"{}\")", first);
    const bool words_only = std::ranges::all_of(
        code, [](char c) { return name_character(c) || std::string_view(" \t\r;").find(c) != std::string_view::npos; });
    const Message* const hint = words_only ? matlab_name_hint(first_word(code)) : nullptr;
    if (hint != nullptr) return *hint;
    static const RE2 kFirstOfSeveral(R"(\s*([A-Za-z_]\w*)\s*;.*)", RE2::Latin1);
    if (near == ";" && RE2::FullMatch(code, kFirstOfSeveral, &first)) {
        const Message* const known = matlab_name_hint(first);
        if (known != nullptr) return *known;
        return first == "figure" ? Message("every plotting function creates its figure: remove figure")
                                 : Message("write a call as {}()", first);
    }
    if (block_hint(code).empty() && RE2::FullMatch(code, kTwoWords, &first, &second) &&
        second.substr(0, second.find_first_of("./-")) == near && first != "local" && first != "return" &&
        first != "goto" && first != "function")
        return first == "help" || first == "load" || first == "run" || first == "require"
                   ? Message("write a call as {}(\"{}\")", first, second)
                   : Message("write a call as {}({})", first, second);
    return {};
}

}  // namespace

Message lone_word_hint(const std::string& line) {
    const std::string code = code_only(line), word = first_word(code);
    const auto last = code.find_last_not_of(" \t\r;:");
    if (last == std::string::npos || last + 1 != code.find(word) + word.size()) return {};
    return word == "try" || word == "catch" || word == "except"
               ? Message("'{}' is not a keyword of Lua; {}", word, block_hint(code))
               : Message();
}

Message colon_block_hint(const std::string& line) {
    const std::string code = code_only(line), word = first_word(code);
    static const RE2 kLoopInOneLine(R"(\s*for\s+\w+(?:\s*,\s*\w+)*\s+in\s.*\)\s*:.*)", RE2::Latin1),
        kDo(R"(\bdo\b)", RE2::Latin1);
    if (RE2::FullMatch(code, kLoopInOneLine) && !RE2::PartialMatch(code, kDo)) return for_loop_form();
    if (!ends_with(code, ":")) return {};
    if (word == "for" || word == "while") return for_loop_form();
    return word == "if" || word == "else" || word == "elif" ? condition_form() : Message();
}

Message foreign_character_sentence(const std::string& line) {
    const std::string code = code_only(line);
    std::string_view rest = code;
    while (!rest.empty()) {
        const std::optional<char32_t> character = take_character(rest);
        if (!character) return Message("unexpected byte that is not UTF-8; save the script as UTF-8");
        if (*character < 128) continue;
        const auto known = std::ranges::find(kForeign, *character, &ForeignCharacter::character);
        const std::string_view instead = known == kForeign.end() ? std::string_view() : known->instead;
        const Message advice = known == kForeign.end()
                                   ? Message("a name may contain only the letters a to z and A to Z, digits and _")
                               : instead.empty() ? Message("remove it")
                               : instead == " "  ? Message("replace it with a space")
                                                 : Message("replace it with {}", instead);
        return Message("unexpected character {} ({}); {}", utf8_of(*character),
                       fmt::format("U+{:04X}", static_cast<unsigned>(*character)), advice);
    }
    return {};
}

Message comment_hint(const std::string& line, const std::string& name) {
    const std::string code = code_only(line);
    const auto sign = std::min(code.find_first_of("%#"), code.find("// "));
    return sign != std::string::npos && code.find(name, sign) != std::string::npos ? comment_form() : Message();
}

Message string_prefix_hint(const std::string& line, const std::string& name) {
    static const RE2 kPrefix(R"((?:^|[^\w.:])([fFrRbBuU])["'])", RE2::Latin1);
    std::string prefix;
    if (!RE2::PartialMatch(line, kPrefix, &prefix) || prefix != name) return {};
    return name == "f" || name == "F"
               ? Message("write a string with values as \"K = \" .. K, or string.format(\"K = %.3f\", K)")
               : Message("write the string without {} before it", name);
}

bool begins_foreign_comment(const std::string& line) {
    const auto first = line.find_first_not_of(" \t");
    return first != std::string::npos &&
           (line[first] == '%' || line.compare(first, 2, "# ") == 0 || line.compare(first, 2, "//") == 0);
}

Message matlab_syntax_hint(const std::string& line, const std::string& near) {
    const std::string code = code_only(line);
    if (Message hint = command_hint(code, near); !hint.empty()) return hint;
    const auto first = code.find_first_not_of(" \t");
    if (first != std::string::npos && (code[first] == '%' || code[first] == '#')) return comment_form();
    if (Message hint = python_hint(code); !hint.empty()) return hint;
    if (near == "=" && has_assignment_condition(code)) return Message("to compare, write == instead of =");
    if (Message hint = operator_hint(code); !hint.empty()) return hint;
    if (ends_with(code, "...") && near != ")")
        return Message("omit \"...\"; in Lua, a statement can continue on the next line");
    const auto list_form = [] {
        return Message("write a vector as vector{1, 2, 3} and a matrix as matrix{{1, 2}, {3, 4}}");
    };
    if (near == "[" && has_bracket_list(code)) return list_form();
    if (near == "@" && !contains(code, "@(")) return Message("write the product of two matrices as A*B");
    if (has_transpose(code)) return Message("the transpose is A:t(); a vector is already a column");
    if (Message hint = block_hint(code); !hint.empty()) return hint;
    if (Message hint = element_hint(code); !hint.empty()) return hint;
    if (has_bracket_list(code)) return list_form();
    if (contains(code, "lambda ")) return inline_function_form();
    if (has_colon_range(code))
        return Message(
            "write a range as range(first, last) or range(first, step, last), and a part of a vector v as v:range(i, "
            "j)");
    if (contains(code, "%") || contains(code, "# ")) return comment_form();
    if (contains(code, "\\")) return Message("write A\\b as solve(A, b)");
    static const RE2 kBeginsWithDigit(R"(\d+[A-Za-z_]\w*)", RE2::Latin1), kContinue(R"(\bcontinue\b)", RE2::Latin1);
    if (RE2::FullMatch(near, kBeginsWithDigit))
        return Message("a name must start with a letter or _; write a product with *, such as 2*x");
    if (RE2::PartialMatch(code, kContinue)) return *matlab_name_hint("continue");
    if (contains(code, "@(")) return inline_function_form();
    return {};
}

}  // namespace dynlab::inline scripting
