// The language of messages (errors, warnings, issues, words of pages) and of the help of commands: the words of the
// glossary, no dialect, short sentences. Oracle: the lists here and in support/prose.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/languages.h"
#include "support/prose.h"

namespace dynlab::test {
namespace test_message_prose {

namespace fs = std::filesystem;

const fs::path kRoot = DYNLAB_SOURCE_DIR;

/// Further phrases that messages and the help of commands do without.
constexpr std::array kRefusedInMessages = {
    "is no",     "are no",   "there is no", "there are no", "no such",         "such a",  "whose",    "those that",
    "is said",   "as it is", "is told",     "so many",      "at work",         "alike",   "beside",   "wanted",
    "asked for", "begins",   "began",       "lies",         "worked solution", "is none", "of before"};

/// Refused phrases with another meaning, and a part of the text in which they may be used.
struct Exception {
    std::string_view phrase, text;
};
constexpr Exception kExceptions[] = {
    {"record", "record longer"},  // the verb: to make a longer recording
    {"record", "record a longer experiment"},
    {"record", "record data in open loop"},
    {"record", "record.json"},  // the name of a file
    {"record", "record.csv"},
    {"guess", "write guess("},  // the name of a function
    {"is no", "is no longer"},
};

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool is_exception(const std::string& phrase, const std::string& text) {
    return std::ranges::any_of(
        kExceptions, [&](const Exception& one) { return one.phrase == phrase && text.find(one.text) != text.npos; });
}

/// The text with \n, \" and similar escapes replaced by the characters that they represent.
std::string unescaped(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size())
            ++i, plain += text[i] == 'n' || text[i] == 't' ? ' ' : text[i];
        else
            plain += text[i];
    }
    return plain;
}

/// The English ids of the catalog, the plurals' too.
std::vector<std::string> message_ids() {
    std::vector<std::string> ids;
    for (const PoFile& file : po_files()) {
        bool id = false;
        for (const std::string& line : lines_of(file.text)) {
            if (line.starts_with("msg")) id = line.starts_with("msgid");
            if (id && line.starts_with("msgid")) ids.emplace_back();
            const std::size_t begin = line.find('"');
            if (id && begin != line.npos)
                ids.back() += unescaped(std::string_view(line).substr(begin + 1, line.rfind('"') - begin - 1));
        }
    }
    return ids;
}

/// The texts in quotes of a source. Adjacent ones are one text.
std::vector<std::string> texts_in(const std::string& source) {
    std::vector<std::string> texts;
    bool goes_on = false;  // nothing but white space since the last closing quote
    for (std::size_t i = 0; i < source.size(); ++i) {
        const char c = source[i];
        if (source.compare(i, 2, "//") == 0) {
            i = std::min(source.find('\n', i), source.size());
        } else if (c == '\'' && i + 2 < source.size() && source[i + 2] == '\'') {
            i += 2, goes_on = false;
        } else if (c == '"') {
            const std::size_t begin = i + 1;
            while (++i < source.size() && source[i] != '"') i += source[i] == '\\';
            if (!goes_on) texts.emplace_back();
            texts.back() += unescaped(std::string_view(source).substr(begin, i - begin));
            goes_on = true;
        } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
            goes_on = false;
        }
    }
    return texts;
}

/// File and text of what the sources of commands say.
std::vector<std::pair<std::string, std::string>> texts_of_commands() {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const auto& file : fs::recursive_directory_iterator(kRoot / "engine/cli")) {
        if (file.path().extension() != ".cpp" && file.path().extension() != ".h") continue;
        std::ifstream stream(file.path());
        for (const std::string& text : texts_in(std::string(std::istreambuf_iterator<char>(stream), {})))
            if (text.find(' ') != text.npos) texts.emplace_back(file.path().filename().string(), text);
    }
    return texts;
}

/// The refused phrases of a text, but for the exceptions.
std::string refused_in(const std::string& text) {
    const std::string words = spaced(sentences_of(text)), small = lower(text);
    std::string found;
    const auto look = [&](const std::string& phrase) {
        if (words.find(" " + phrase + " ") != words.npos && !is_exception(phrase, small)) found += phrase + ", ";
    };
    for (const std::string phrase : kRefusedPhrases) look(phrase);
    for (const std::string phrase : kRefusedInMessages) look(phrase);
    return found;
}

TEST(message_prose, messages_use_the_words_of_the_glossary) {
    const std::vector<std::string> ids = message_ids();
    EXPECT_GT(ids.size(), 4000u);
    for (const std::string& id : ids) EXPECT_EQ(refused_in(id), "") << id;
}

TEST(message_prose, commands_use_the_words_of_the_glossary) {
    const auto texts = texts_of_commands();
    EXPECT_GT(texts.size(), 400u);
    for (const auto& [file, text] : texts) EXPECT_EQ(refused_in(text), "") << file << ": " << text;
}

// Every phrase of the lists can be found.
TEST(message_prose, refused_phrases_are_found) {
    for (const std::string phrase : kRefusedPhrases) EXPECT_NE(refused_in("It " + phrase + " x."), "") << phrase;
    for (const std::string phrase : kRefusedInMessages) EXPECT_NE(refused_in("It " + phrase + " x."), "") << phrase;
    EXPECT_EQ(refused_in("If the data are short, record longer."), "");
}

TEST(message_prose, messages_have_short_sentences) {
    constexpr double kShareOfLongMessages = 0.25;  // percent; lower it when the share has fallen, never raise it
    std::size_t count = 0, too_long = 0;
    for (const std::string& id : message_ids()) {
        ++count;
        too_long += std::ranges::any_of(
            sentences_of(id), [](const std::vector<std::string>& words) { return words.size() > kMaxSentenceLength; });
    }
    EXPECT_LE(100.0 * static_cast<double>(too_long), kShareOfLongMessages * static_cast<double>(count))
        << too_long << " of " << count << " messages have a sentence of more than " << kMaxSentenceLength << " words";
}

}  // namespace test_message_prose
}  // namespace dynlab::test
