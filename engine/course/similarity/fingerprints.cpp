#include "course/similarity/fingerprints.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>

#include "scripting/interpreter/catalog.h"
#include "scripting/source/lua_tokens.h"

namespace dynlab::inline course {
namespace {

constexpr std::size_t kTokensOfRun = 10;  // tokens of a fingerprint
constexpr std::size_t kRunsOfOne = 4;     // successive runs of which one is kept

/// Names that a script does not choose.
const std::set<std::string_view>& names_of_the_library() {
    static const std::set<std::string_view> names = [] {
        std::set<std::string_view> all = {
            "math", "string", "table", "ipairs", "pairs",  "print", "tostring", "tonumber", "pcall", "error",  "select",
            "type", "unpack", "sqrt",  "format", "insert", "max",   "min",      "report",   "value", "figure", "text"};
        for (const FunctionEntry& entry : catalog_of_functions()) all.insert(entry.name);
        return all;
    }();
    return names;
}

struct PlainToken {
    std::string_view word;
    int line;
};

std::string_view plain_word(const LuaToken& token) {
    switch (token.kind) {
        case LuaToken::Kind::kName:
            return names_of_the_library().contains(token.text) ? token.text : "name";
        case LuaToken::Kind::kNumber:
            return "0";
        case LuaToken::Kind::kString:
        case LuaToken::Kind::kUnfinished:
            return "\"\"";
        default:
            return token.text;
    }
}

std::vector<PlainToken> plain_tokens(const std::string& script) {
    std::vector<PlainToken> plain;
    std::size_t read = 0;
    int line = 1;
    for (const LuaToken& token : lua_tokens(script)) {
        line += static_cast<int>(std::count(script.begin() + static_cast<std::ptrdiff_t>(read),
                                            script.begin() + static_cast<std::ptrdiff_t>(token.begin), '\n'));
        read = token.begin;
        if (!token.is("local") && !token.is(";")) plain.push_back({plain_word(token), line});
    }
    return plain;
}

/// Of each run of tokens; FNV-1a over the words.
std::vector<std::uint64_t> hashes_of_runs(const std::vector<PlainToken>& tokens) {
    std::vector<std::uint64_t> hashes;
    for (std::size_t k = 0; k + kTokensOfRun <= tokens.size(); ++k) {
        std::uint64_t hash = 14695981039346656037ull;
        for (std::size_t i = k; i < k + kTokensOfRun; ++i) {
            for (const char c : tokens[i].word) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
            hash = (hash ^ 0xFFu) * 1099511628211ull;
        }
        hashes.push_back(hash);
    }
    return hashes;
}

}  // namespace

std::vector<Fingerprint> fingerprints(const std::string& script) {
    const std::vector<PlainToken> tokens = plain_tokens(script);
    const std::vector<std::uint64_t> hashes = hashes_of_runs(tokens);
    std::vector<Fingerprint> kept;
    std::size_t last = hashes.size();
    for (std::size_t k = 0; k < hashes.size(); ++k) {
        const std::size_t end = std::min(k + kRunsOfOne, hashes.size());
        if (k > 0 && end - k < kRunsOfOne) break;
        // The last of equal ones, so that a repetition is kept once a window.
        std::size_t least = k;
        for (std::size_t i = k; i < end; ++i)
            if (hashes[i] <= hashes[least]) least = i;
        if (least == last) continue;
        last = least;
        kept.push_back({hashes[least], tokens[least].line, tokens[least + kTokensOfRun - 1].line});
    }
    return kept;
}

}  // namespace dynlab::inline course
