#include "documents/html/script_catalogs.h"

#include <re2/re2.h>

#include <nlohmann/json.hpp>
#include <span>

#include "base/catalog.h"
#include "base/languages.h"
#include "documents/text_lines.h"

namespace dynlab::inline documents {
namespace {

using nlohmann::json;

/// words.js takes the form of a larger count from its last two digits.
constexpr int kCounts = 200;

struct ScriptMessage {
    std::string context, id;
    bool plural = false;
};

/// The text of a string literal, whose escapes are those of JSON.
std::string literal_text(const std::string& literal) {
    return json::parse(literal).get<std::string>();
}

std::vector<ScriptMessage> messages_in(std::string_view javascript) {
    static const RE2 kMark(R"re(\btr(In|Plural)?\(("(?:[^"\\\n]|\\["\\nu])*")(?:, ("(?:[^"\\\n]|\\["\\nu])*"))?\))re");
    std::vector<ScriptMessage> messages;
    re2::StringPiece rest(javascript.data(), javascript.size());
    for (std::string kind, first, second; RE2::FindAndConsume(&rest, kMark, &kind, &first, &second);) {
        if (kind == "In")
            messages.push_back({literal_text(first), literal_text(second)});
        else
            messages.push_back({"", literal_text(first), kind == "Plural"});
    }
    return messages;
}

json catalog_json(const Catalog& catalog, const std::vector<ScriptMessage>& messages) {
    std::string forms;
    for (int n = 0; n < kCounts; ++n) forms += std::to_string(catalog.rule().form(n));
    json texts = json::object();
    for (const auto& [context, id, plural] : messages) {
        const std::span<const std::string> translation = catalog.forms(id, context);
        if (translation.empty()) continue;
        const std::string key = context.empty() ? id : context + '\4' + id;
        texts[key] = plural ? json(std::vector(translation.begin(), translation.end())) : json(translation.front());
    }
    return {{"decimalSign", catalog.decimal_sign()}, {"forms", forms}, {"texts", texts}};
}

}  // namespace

std::string script_catalogs(std::string_view javascript, const std::vector<std::string>& languages) {
    const std::vector<ScriptMessage> messages = messages_in(javascript);
    json catalogs = json::object();
    for (const std::string& language : languages)
        if (const Catalog* const catalog = catalog_of(language)) catalogs[language] = catalog_json(*catalog, messages);
    const std::string text = catalogs.dump(-1, ' ', false, json::error_handler_t::replace);
    return "const dynlabCatalogs = " + replaced(text, "<", "\\u003c") + ";\n";  // no "</script>" in a page
}

}  // namespace dynlab::inline documents
