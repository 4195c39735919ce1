#include "course/answers/formulas.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "platform/child_process.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kMaxFormulas = 20'000, kMaxFormulaLength = 2'000;

/// A piece of a text: a formula without its dollar signs, or what is between formulas.
struct TextPiece {
    std::string_view text;
    bool formula = false, displayed = false;
};

bool is_blank_at(std::string_view text, std::size_t at) {
    return at >= text.size() || std::isspace(static_cast<unsigned char>(text[at])) != 0;
}

/// Where the formula ends whose first character is at `begin`, by the rules of Markdown; npos where there is none.
std::size_t end_of_formula(std::string_view text, std::size_t begin, std::string_view sign) {
    if (sign.size() == 1 && is_blank_at(text, begin)) return text.npos;
    for (std::size_t at = begin; at < std::min(text.size(), begin + kMaxFormulaLength); ++at) {
        if (text[at] == '\\') {
            ++at;
        } else if (text.substr(at).starts_with("\n\n")) {
            break;
        } else if (text.substr(at).starts_with(sign)) {
            const bool amount = at + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[at + 1])) != 0;
            if (at == begin || (sign.size() == 1 && (is_blank_at(text, at - 1) || amount))) break;
            return at;
        }
    }
    return text.npos;
}

std::vector<TextPiece> text_pieces(std::string_view text) {
    std::vector<TextPiece> pieces;
    std::size_t from = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '\\') {
            ++at;
            continue;
        }
        if (text[at] == '`') {  // code
            const std::size_t signs = std::min(text.find_first_not_of('`', at), text.size()) - at;
            const std::size_t end = text.find(text.substr(at, signs), at + signs);
            at = end == text.npos ? at + signs - 1 : end + signs - 1;
            continue;
        }
        if (text[at] != '$') continue;
        const std::string_view sign = text.substr(at).starts_with("$$") ? "$$" : "$";
        const std::size_t begin = at + sign.size(), end = end_of_formula(text, begin, sign);
        if (end == text.npos) {
            at = begin - 1;
            continue;
        }
        pieces.push_back({text.substr(from, at - from)});
        pieces.push_back({text.substr(begin, end - begin), true, sign.size() == 2});
        from = end + sign.size();
        at = from - 1;
    }
    pieces.push_back({text.substr(from)});
    return pieces;
}

/// Pandoc's document with a paragraph for each formula.
std::string document_of(const std::vector<std::pair<std::string, bool>>& formulas) {
    using nlohmann::json;
    json blocks = json::array();
    for (const auto& [formula, displayed] : formulas) {
        const json kind = {{"t", displayed ? "DisplayMath" : "InlineMath"}};
        const json mathematics = {{"t", "Math"}, {"c", json::array({kind, formula})}};
        blocks.push_back({{"t", "Para"}, {"c", json::array({mathematics})}});
    }
    const json document = {{"pandoc-api-version", {1, 22}}, {"meta", json::object()}, {"blocks", blocks}};
    return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::string escaped_html(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
            result += c;
    }
    return result;
}

TypesetFormulas::TypesetFormulas(const std::vector<std::string>& texts, Isolation isolation) {
    std::vector<std::pair<std::string, bool>> formulas;
    for (const std::string& text : texts)
        for (const TextPiece& piece : text_pieces(text))
            if (piece.formula && formulas.size() < kMaxFormulas)
                formulas.emplace_back(std::string(piece.text), piece.displayed);
    std::ranges::sort(formulas);
    formulas.erase(std::unique(formulas.begin(), formulas.end()), formulas.end());
    if (formulas.empty()) return;
    Sandbox::Limits limits;
    limits.time = {std::chrono::seconds(60)};
    const ChildResult made = Sandbox(isolation).run(
        {"pandoc", "+RTS", "-M1g", "-RTS", "-f", "json", "-t", "html5", "--mathml"}, {}, document_of(formulas), limits);
    if (made.exit_code != 0) return;
    constexpr std::string_view kBegin = "<p>", kEnd = "</p>";
    std::size_t at = 0;
    for (const auto& formula : formulas) {
        const std::size_t begin = made.output.find(kBegin, at), end = made.output.find(kEnd, begin);
        if (begin == std::string::npos || end == std::string::npos) return;
        const std::string html = made.output.substr(begin + kBegin.size(), end - begin - kBegin.size());
        if (html.starts_with("<math")) known_[formula] = html;
        at = end;
    }
}

std::string TypesetFormulas::html(const std::string& text) const {
    std::string result;
    for (const TextPiece& piece : text_pieces(text)) {
        if (!piece.formula) {
            result += escaped_html(piece.text);
            continue;
        }
        const std::string sign = piece.displayed ? "$$" : "$";
        const auto typeset = known_.find({std::string(piece.text), piece.displayed});
        result += typeset != known_.end() ? typeset->second : sign + escaped_html(piece.text) + sign;
    }
    return result;
}

}  // namespace dynlab::inline course
