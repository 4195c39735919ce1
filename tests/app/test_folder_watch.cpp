// Changes of files as editors make them. Oracle: the files that were changed.
#include "app/live/folder_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <fstream>

#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace test_folder_watch {
using namespace dynlab;
using testing::ElementsAre;
using testing::IsEmpty;
namespace fs = std::filesystem;

class folder_watch : public testing::Test {
  protected:
    folder_watch() { watch.add(folder.path()); }
    void write(const std::string& name) const { std::ofstream(folder.path() / name) << "x"; }
    std::set<fs::path> changes() {
        pollfd waiting{watch.descriptor(), POLLIN, 0};
        ::poll(&waiting, 1, 1000);
        return watch.changes();
    }
    TemporaryFolder folder;
    FolderWatch watch;
};

TEST_F(folder_watch, sees_what_is_written_replaced_removed_and_comes_back) {
    write("a.lua");
    EXPECT_THAT(changes(), ElementsAre(folder.path() / "a.lua"));
    write("a.lua.swp");
    fs::rename(folder.path() / "a.lua.swp", folder.path() / "a.lua");
    EXPECT_THAT(changes(), ElementsAre(folder.path() / "a.lua", folder.path() / "a.lua.swp"));
    fs::remove(folder.path() / "a.lua");
    EXPECT_THAT(changes(), ElementsAre(folder.path() / "a.lua"));
    write("a.lua");
    EXPECT_THAT(changes(), ElementsAre(folder.path() / "a.lua"));
}

TEST_F(folder_watch, is_quiet_where_nothing_changes) {
    std::ifstream(folder.path() / "b.lua");
    pollfd waiting{watch.descriptor(), POLLIN, 0};
    EXPECT_EQ(::poll(&waiting, 1, 50), 0);
    EXPECT_THAT(watch.changes(), IsEmpty());
}

TEST_F(folder_watch, a_folder_that_is_not_there_is_reported) {
    EXPECT_THROW(watch.add(folder.path() / "nowhere"), EnvironmentError);
}

TEST_F(folder_watch, a_file_is_waited_for_where_its_folder_is_not_there_yet) {
    const fs::path file = folder.path() / "data" / "new" / "rec.csv";
    watch.add_around(file);
    fs::create_directories(file.parent_path());
    const auto seen = changes();
    EXPECT_TRUE(std::ranges::any_of(seen, [&](const fs::path& one) { return concerns(one, file); }));
    watch.add_around(file);
    std::ofstream(file) << "x";
    EXPECT_THAT(changes(), ElementsAre(file));
    EXPECT_TRUE(concerns(file, file));
    EXPECT_FALSE(concerns(folder.path() / "dat", file));
    EXPECT_FALSE(concerns(file, folder.path() / "data"));
}

}  // namespace test_folder_watch
