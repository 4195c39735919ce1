// What is kept of a document's page. Oracle: the page that the test made up, and the files that it changes.
#include "app/live/page_cache.h"

#include <gtest/gtest.h>

#include <fstream>

#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace test_page_cache {
using namespace dynlab;
namespace fs = std::filesystem;

class page_cache : public testing::Test {
  protected:
    page_cache() {
        ::setenv("DYNLAB_HOME", DYNLAB_SOURCE_DIR, 1);
        memory.emplace();
        write("report.md", "---\ntitle: A report\n---\n\n::: {.cells}\n:::\n");
        write("d.csv", "a\n1\n2\n");
        set_script("-- %% id=one\nprint(1)\n");
        request.template_file = folder.path() / "report.md";
        request.output = "preview.html";
        files = {folder.path() / "d.csv"};
        page.name = "analysis.lua", page.html["p1"] = "<p>one</p>", page.complaints = {Message("no such figure")};
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder.path() / name) << text; }
    void set_script(const std::string& source) {
        request.script = parse_percent_script(source, folder.path() / "analysis.lua");
    }
    bool knows() const { return memory->load_entry(request).has_value(); }
    std::ptrdiff_t entries() const {
        return std::distance(fs::directory_iterator(Cache().root() / "pages"), fs::directory_iterator());
    }

    TemporaryFolder folder;
    test::EnvironmentVariable cache_home{"XDG_CACHE_HOME", folder.path() / "cache"};
    std::optional<PageMemory> memory;
    ReportRequest request;
    std::vector<fs::path> files;
    PageContent page;
};

TEST_F(page_cache, gives_back_the_page_wherever_it_is_opened_from) {
    EXPECT_FALSE(knows());
    memory->save_entry(request, files, page);
    request.output = "/elsewhere/preview.html";
    request.template_file = folder.path() / "." / "report.md";
    const auto known = memory->load_entry(request);
    ASSERT_TRUE(known);
    EXPECT_EQ(known->name, page.name);
    EXPECT_EQ(known->html, page.html);
    EXPECT_EQ(known->complaints, page.complaints);
}

TEST_F(page_cache, knows_nothing_of_other_scripts_templates_seeds_and_data) {
    memory->save_entry(request, files, page);
    ASSERT_TRUE(knows());
    request.seed = 2;
    EXPECT_FALSE(knows());
    request.seed = 1;
    write("report.md", "---\ntitle: Another report\n---\n\n::: {.cells}\n:::\n");
    EXPECT_FALSE(knows());
    write("report.md", "---\ntitle: A report\n---\n\n::: {.cells}\n:::\n");
    EXPECT_TRUE(knows());
    write("d.csv", "a\n1\n3\n");
    EXPECT_FALSE(knows());
    write("d.csv", "a\n1\n2\n");
    set_script("-- %% id=one\nprint(2)\n");
    EXPECT_FALSE(knows());
}

TEST_F(page_cache, keeps_one_page_of_a_document) {
    memory->save_entry(request, files, page);
    set_script("-- %% id=one\nprint(2)\n");
    memory->save_entry(request, files, page);
    EXPECT_TRUE(knows());
    EXPECT_EQ(entries(), 1);
    set_script("-- %% id=one\nprint(1)\n");
    EXPECT_FALSE(knows());
}

/// What `cat` says of such files: a folder that may not be read, a symbolic link to itself, nothing there.
TEST_F(page_cache, does_without_where_files_cannot_be_read) {
    memory->save_entry(request, files, page);
    fs::remove(folder.path() / "d.csv");
    fs::create_symlink("d.csv", folder.path() / "d.csv");
    EXPECT_NO_THROW(EXPECT_FALSE(knows()));
    EXPECT_NO_THROW(memory->save_entry(request, files, page));
    fs::remove(folder.path() / "d.csv");
    write("d.csv", "a\n1\n2\n");
    memory->save_entry(request, files, page);
    ASSERT_TRUE(knows());
    fs::rename(folder.path() / "report.md", folder.path() / "away.md");
    EXPECT_NO_THROW(EXPECT_FALSE(knows()));
    EXPECT_NO_THROW(memory->save_entry(request, files, page));
    fs::rename(folder.path() / "away.md", folder.path() / "report.md");
    EXPECT_TRUE(knows());
}

}  // namespace test_page_cache
