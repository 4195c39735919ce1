#include "workflow/site/search_index.h"

#include <nlohmann/json.hpp>

#include <set>

#include "platform/text/small_letters.h"

namespace dynlab::inline workflow {
namespace {

bool is_punctuation_of_unicode(const std::string& text, std::size_t at, std::size_t& length) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const bool no_break_space = byte(at) == 0xC2 && byte(at + 1) == 0xA0;
    const bool general = byte(at) == 0xE2 && (byte(at + 1) == 0x80 || (byte(at + 1) == 0x81 && byte(at + 2) <= 0xAF));
    length = no_break_space ? 2 : 3;
    return no_break_space || general;
}

}  // namespace

std::vector<std::string> words_in_text(const std::string& text) {
    std::set<std::string> words;
    std::string word;
    const auto end_word = [&] {
        if (!word.empty()) words.insert(in_small_letters(word));
        word.clear();
    };
    for (std::size_t at = 0; at < text.size();) {
        std::size_t length = 1;
        const auto letter = static_cast<unsigned char>(text[at]);
        if (letter >= 0x80 ? is_punctuation_of_unicode(text, at, length) : !std::isalnum(letter)) {
            end_word();
            at += length;
        } else {
            word += text[at++];
        }
    }
    end_word();
    return {words.begin(), words.end()};
}

std::string search_index(const std::vector<SitePage>& pages) {
    nlohmann::json index = nlohmann::json::array();
    for (const SitePage& page : pages) {
        nlohmann::json headings = nlohmann::json::array();
        for (const auto& [id, text] : headings_in(page.body)) headings.push_back({text, id});
        std::string words = " ";
        for (const std::string& word : words_in_text(page.title + " " + page.about + " " + text_in_html(page.body)))
            words += word + " ";
        index.push_back({{"file", page.file},
                         {"title", page.title},
                         {"kind", page.kind},
                         {"language", page.language},
                         {"translated", !page.translation.empty()},
                         {"about", page.about},
                         {"headings", headings},
                         {"words", words}});
    }
    using Json = nlohmann::json;
    return "window.dynlabPages = " + index.dump(-1, ' ', false, Json::error_handler_t::replace) + ";\n";
}

}  // namespace dynlab::inline workflow
