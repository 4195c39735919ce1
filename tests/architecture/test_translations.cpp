// Catalogs of translations. Oracle: gettext's format, read here once more; each {} of a message stands for an argument.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace test_translations {

namespace fs = std::filesystem;

struct Entry {
    std::vector<std::string> ids, texts;  ///< of a plural both ids and all forms
};

/// Without escapes, which no slot has.
std::string text_in(const std::string& line) {
    const std::size_t begin = line.find('"'), end = line.rfind('"');
    return begin == line.npos || end <= begin ? "" : line.substr(begin + 1, end - begin - 1);
}

std::vector<Entry> entries_in(const fs::path& file) {
    std::vector<Entry> entries;
    std::string* last = nullptr;
    bool begun = false;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line.empty()) begun = false;
        if (line.empty() || line.starts_with('#')) continue;
        if (!begun) entries.emplace_back();
        begun = true;
        Entry& entry = entries.back();
        if (line.starts_with("msgctxt"))
            last = nullptr;
        else if (line.starts_with("msgid"))
            last = &entry.ids.emplace_back(text_in(line));
        else if (line.starts_with("msgstr"))
            last = &entry.texts.emplace_back(text_in(line));
        else if (last != nullptr)
            *last += text_in(line);
    }
    return entries;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++found;
    return found;
}

/// {} for each, or {1}, {2}, ... for all.
bool has_slots(const std::string& text, std::size_t slots) {
    if (count(text, "{}") == slots) return true;
    bool numbered = count(text, "{}") == 0;
    for (std::size_t i = 1; i <= slots; ++i) numbered = numbered && count(text, "{" + std::to_string(i) + "}") == 1;
    return numbered;
}

/// Returns the number of entries.
std::size_t expect_whole(const fs::path& file) {
    const std::vector<Entry> entries = entries_in(file);
    for (const Entry& entry : entries) {
        EXPECT_FALSE(entry.ids.empty() || entry.texts.empty()) << file;
        if (entry.ids.empty() || entry.ids.front().empty()) continue;  // the header
        const std::size_t slots = count(entry.ids.front(), "{}");
        for (const std::string& text : entry.texts) {
            EXPECT_NE(text, "") << file << ": not translated: " << entry.ids.front();
            EXPECT_TRUE(has_slots(text, slots)) << file << ": " << entry.ids.front() << "\n" << text;
        }
    }
    return entries.size();
}

TEST(translations, have_a_text_with_as_many_slots_for_each_message) {
    const fs::path root = DYNLAB_SOURCE_DIR;
    std::map<std::string, std::size_t> sizes;
    for (const auto& entry : fs::directory_iterator(root / "engine/po"))
        if (entry.path().extension() == ".po") sizes[entry.path().filename()] = expect_whole(entry.path());
    EXPECT_GT(sizes["fr.po"], 2000u);
    for (const auto& lesson : fs::directory_iterator(root / "lessons"))
        for (const auto& entry : fs::directory_iterator(lesson.path()))
            if (entry.path().extension() == ".po") expect_whole(entry.path());
}

}  // namespace test_translations
