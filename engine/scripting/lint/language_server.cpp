#include "scripting/lint/language_server.h"

#include <algorithm>
#include <stdexcept>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/script_header.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/lint/function_forms.h"
#include "scripting/lint/lint.h"
#include "scripting/runtime/errors.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline scripting {
namespace {

using nlohmann::json;

constexpr int kParseError = -32700, kInvalidRequest = -32600, kMethodNotFound = -32601, kInvalidParams = -32602;
constexpr int kWholeText = 1;                      // of textDocumentSync
constexpr int kError = 1, kWarning = 2;            // of a diagnostic's severity
constexpr int kFunction = 3, kVariable = 6;        // of a completion's kind
constexpr unsigned char kBeyondBasicPlane = 0xF0;  // first byte of characters that are two units of UTF-16

bool begins_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

/// Units of UTF-16, in which the protocol counts, before a column of characters (from 1).
int units_before(const std::string& line, int column) {
    int units = 0, characters = 0;
    for (const char c : line) {
        if (!begins_character(c)) continue;
        if (++characters == column) break;
        units += static_cast<unsigned char>(c) >= kBeyondBasicPlane ? 2 : 1;
    }
    return units;
}

/// The byte of a line at which so many units of UTF-16 have passed.
std::size_t byte_at(const std::string& line, int units) {
    std::size_t byte = 0;
    while (byte < line.size() && units > 0) {
        units -= static_cast<unsigned char>(line[byte]) >= kBeyondBasicPlane ? 2 : 1;
        do ++byte;
        while (byte < line.size() && !begins_character(line[byte]));
    }
    return byte;
}

json error_answer(const json& id, int code, const std::string& message) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}};
}

/// Every name that a script may use, with the summary of functions.
json all_completions() {
    json items = json::array();
    for (const auto& [name, members] : library_names())
        if (find_function(name) == nullptr) items.push_back({{"label", name}, {"kind", kVariable}});
    for (const FunctionEntry& entry : catalog_of_functions())
        items.push_back({{"label", entry.name},
                         {"kind", kFunction},
                         {"detail", signature_text(entry)},
                         {"documentation", entry.summary}});
    return items;
}

json capabilities() {
    return {{"capabilities",
             {{"textDocumentSync", kWholeText}, {"hoverProvider", true}, {"completionProvider", json::object()}}},
            {"serverInfo", {{"name", "dynlab"}}}};
}

}  // namespace

std::vector<json> LanguageServer::answers_to(const std::string& text) {
    const json message = json::parse(text, nullptr, false);
    if (message.is_discarded()) return {error_answer(nullptr, kParseError, "the text is not JSON")};
    if (!message.is_object() || !message.contains("method") || !message["method"].is_string()) {
        if (message.is_object() && message.contains("result")) return {};  // to a request: there are none of ours
        return {error_answer(nullptr, kInvalidRequest, "a message needs a method")};
    }
    const std::string method = message["method"];
    const json parameters = message.value("params", json::object());
    std::vector<json> answers;
    try {
        if (message.contains("id")) {
            answers.push_back({{"jsonrpc", "2.0"}, {"id", message["id"]}, {"result", result_of(method, parameters)}});
        } else if (method == "exit") {
            ended_ = true;
        } else if (method == "textDocument/didOpen" || method == "textDocument/didChange") {
            const json& document = parameters.at("textDocument");
            const std::string uri = document.at("uri");
            texts_[uri] = method == "textDocument/didOpen" ? document.at("text")
                                                           : parameters.at("contentChanges").back().at("text");
            answers.push_back(diagnostics_of(uri));
        } else if (method == "textDocument/didClose") {
            texts_.erase(parameters.at("textDocument").at("uri").get<std::string>());
        }
    } catch (const json::exception&) {
        answers = {
            error_answer(message.value("id", json()), kInvalidParams, "the parameters of " + method + " are others")};
    } catch (const std::invalid_argument& unknown) {
        answers = {error_answer(message.value("id", json()), kMethodNotFound, unknown.what())};
    }
    return answers;
}

json LanguageServer::result_of(const std::string& method, const json& parameters) {
    if (method == "initialize") return capabilities();
    if (method == "shutdown") {
        shut_down_ = true;
        return nullptr;
    }
    if (method == "textDocument/completion") return all_completions();
    if (method == "textDocument/hover") {
        const FunctionEntry* const function = find_function(word_at(parameters));
        if (function == nullptr) return nullptr;
        return {{"contents",
                 {{"kind", "markdown"}, {"value", "`" + signature_text(*function) + "`\n\n" + function->summary}}}};
    }
    throw std::invalid_argument("there is no " + method + " here");
}

json LanguageServer::diagnostics_of(const std::string& uri) const {
    const std::string& text = texts_.at(uri);
    const Reader reader{catalog_of(language_of_script(text)), &option_name};
    json all = json::array();
    for (const LintIssue& found : lint_script(text, uri)) {
        const std::string line = line_of(text, found.line);
        const int begin = units_before(line, found.column);
        const std::size_t byte = byte_at(line, begin);
        std::size_t end = byte;
        while (end < line.size() && is_name_character(line[end])) ++end;
        const int length = std::max(1, static_cast<int>(end - byte));
        const auto place = [&](int character) { return json{{"line", found.line - 1}, {"character", character}}; };
        all.push_back({{"range", {{"start", place(begin)}, {"end", place(begin + length)}}},
                       {"severity", found.kind == "unused-answer" ? kWarning : kError},
                       {"source", "dynlab"},
                       {"code", found.kind},
                       {"message", message_text(found.message, reader)}});
    }
    return {{"jsonrpc", "2.0"},
            {"method", "textDocument/publishDiagnostics"},
            {"params", {{"uri", uri}, {"diagnostics", all}}}};
}

std::string LanguageServer::word_at(const json& parameters) const {
    const auto text = texts_.find(parameters.at("textDocument").at("uri").get<std::string>());
    if (text == texts_.end()) return {};
    const json& position = parameters.at("position");
    const std::string line = line_of(text->second, position.at("line").get<int>() + 1);
    std::size_t begin = byte_at(line, position.at("character").get<int>()), end = begin;
    const auto belongs = [&](std::size_t i) { return is_name_character(line[i]) || line[i] == '.'; };
    while (begin > 0 && belongs(begin - 1)) --begin;
    while (end < line.size() && is_name_character(line[end])) ++end;
    return line.substr(begin, end - begin);
}

}  // namespace dynlab::inline scripting
