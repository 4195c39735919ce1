// The catalogs of translations fit the sources. Oracles: gettext's own tools, and the arguments that each English id
// has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "base/languages.h"
#include "documents/text_lines.h"
#include "platform/child_process.h"
#include "platform/program_lookup.h"

namespace dynlab::test {
namespace test_translations {

namespace fs = std::filesystem;

const fs::path kRoot = DYNLAB_SOURCE_DIR;

/// The {} of a format, or the numbers of its {1}, {2}; one entry for each.
std::multiset<std::string> slots_of(const std::string& format) {
    std::multiset<std::string> slots;
    for (std::size_t at = format.find('{'); at != format.npos; at = format.find('{', at + 1)) {
        const std::size_t end = format.find('}', at);
        const std::string inside = end == format.npos ? "?" : format.substr(at + 1, end - at - 1);
        if (inside.size() <= 1 &&
            std::all_of(inside.begin(), inside.end(), [](unsigned char c) { return c >= '1' && c <= '9'; }))
            slots.insert(inside);
    }
    return slots;
}

TEST(translations, catalogs_are_complete_up_to_date_and_well_formed) {
    if (!find_program("msgmerge")) GTEST_SKIP() << "gettext is not installed";
    ChildOptions options;
    options.command = {"bash", (kRoot / "scripts/translations").string(), "--check"};
    const ChildResult result = run_child(options, "bash");
    EXPECT_EQ(result.exit_code, 0) << result.output << result.error_output;
}

struct Entry {
    std::string id;
    std::vector<std::string> forms;
};

/// The entries of a PO file, read here a second time: quoted texts behind a keyword belong together.
std::vector<Entry> entries_of(std::string_view po) {
    std::vector<Entry> entries;
    std::string* text = nullptr;
    static std::string ignored;
    for (const std::string& line : lines_of(po)) {
        if (line.starts_with("msgid ")) {
            entries.emplace_back();
            text = &entries.back().id;
        } else if (line.starts_with("msgstr")) {
            text = &entries.back().forms.emplace_back();
        } else if (line.starts_with("msg")) {
            text = &ignored;
        }
        const std::size_t begin = line.find('"');
        if (text != nullptr && !line.starts_with('#') && begin != line.npos)
            text->append(line, begin + 1, line.rfind('"') - begin - 1);
    }
    return entries;
}

TEST(translations, take_the_arguments_of_their_messages) {
    for (const PoFile& file : po_files()) {
        const std::vector<Entry> entries = entries_of(file.text);
        EXPECT_GT(entries.size(), 3000u) << file.name;
        for (const Entry& entry : entries)
            for (const std::string& form : entry.forms) {
                const std::size_t expected = std::ranges::count(slots_of(entry.id), std::string());
                const std::multiset<std::string> given = slots_of(form);
                const std::set<std::string> numbers(given.begin(), given.end());
                const bool in_order = given.count("") == expected;
                const bool by_number = !given.contains("") && given.size() == expected && numbers.size() == expected;
                EXPECT_TRUE(entry.id.empty() || in_order || by_number) << file.name << ": " << entry.id << "\n" << form;
            }
    }
}

}  // namespace test_translations
}  // namespace dynlab::test
