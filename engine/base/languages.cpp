#include "base/languages.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>

namespace dynlab::inline base {
namespace {

struct Language {
    std::string_view po;
    std::string own_text;  ///< of a language that was added: what `po` refers to
    std::unique_ptr<const Catalog> catalog;
    std::string error;
    bool read = false;
};

struct Languages {
    std::mutex mutex;
    std::map<std::string, Language, std::less<>> by_code;
};

Languages& all() {
    static Languages* const languages = [] {
        auto* made = new Languages;  // outlives all threads
        for (const PoFile& file : po_files())
            made->by_code[std::string(file.name.substr(0, file.name.find('.')))].po = file.text;
        return made;
    }();
    return *languages;
}

/// With the catalog read, if there is such a language.
const Language* language_of(std::string_view code) {
    Languages& languages = all();
    const std::lock_guard lock(languages.mutex);
    const auto found = languages.by_code.find(code);
    if (found == languages.by_code.end()) return nullptr;
    Language& language = found->second;
    if (!language.read) {
        language.read = true;
        try {
            language.catalog = std::make_unique<const Catalog>(language.po);
        } catch (const std::runtime_error& error) {
            language.error = error.what();
            std::cerr << "dynlab: note: " << code << ".po, " << language.error << ": messages are in English\n";
        }
    }
    return &language;
}

}  // namespace

bool is_language(std::string_view code) {
    return std::ranges::count(languages(), code) > 0;
}

std::vector<std::string> languages() {
    std::vector<std::string> codes = {"en"};
    const std::lock_guard lock(all().mutex);
    for (const auto& [code, language] : all().by_code) codes.push_back(code);
    return codes;
}

const Catalog* catalog_of(std::string_view code) {
    const Language* language = language_of(code);
    return language == nullptr ? nullptr : language->catalog.get();
}

std::string missing_catalog(std::string_view code) {
    if (code == "en") return {};
    const Language* language = language_of(code);
    if (language == nullptr) return "unknown catalog " + std::string(code) + ".po";
    return language->error.empty() ? std::string() : std::string(code) + ".po, " + language->error;
}

void add_language(const std::string& code, const std::string& po_text) {
    const std::lock_guard lock(all().mutex);
    Language& language = all().by_code[code];
    language = {};
    language.own_text = po_text;
    language.po = language.own_text;
}

}  // namespace dynlab::inline base
