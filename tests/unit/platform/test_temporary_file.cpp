#include "platform/files/temporary_file.h"

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>
#include <string>
#include <utility>

#include "platform/atomic_file.h"
#include "platform/files/replacement_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_temporary_file {

namespace fs = std::filesystem;

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    return names;
}

/// A process that is killed while it writes FOLDER/NAME.
void leave_half_a_file(const fs::path& folder, const std::string& name) {
    const pid_t child = ::fork();
    if (child == 0) {
        ReplacementFile half(folder / name);
        half.append("half");
        ::raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

// oracle: the files that a process which was killed wrote, and nothing else
TEST(temporary_file, the_next_process_that_writes_to_a_folder_removes_leftovers) {
    const TemporaryFolder folder;
    leave_half_a_file(folder.path(), "analysis.lua");
    ASSERT_EQ(names_in(folder.path()).size(), 1u);
    EXPECT_EQ(names_in(folder.path()).begin()->find(".analysis.lua.dynlab-" + machine_in_names() + "-"), 0u);
    write_file_atomically(folder.path() / "other", "whole");
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"other"}));
    leave_half_a_file(folder.path(), "analysis.lua");  // this process does not look again, ...
    write_file_atomically(folder.path() / "other", "whole");
    EXPECT_EQ(names_in(folder.path()).size(), 2u);
    EXPECT_EQ(remove_leftover_files(folder.path()).size(), 1u);  // ... unless it is asked to
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"other"}));
}

// oracle: a file in use is committed, whatever other processes remove meanwhile
TEST(temporary_file, files_in_use_stay) {
    const TemporaryFolder folder;
    ReplacementFile in_use(folder.path() / "file");
    in_use.append("whole");
    const pid_t child = ::fork();
    if (child == 0) ::_exit(static_cast<int>(remove_leftover_files(folder.path()).size()));
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    in_use.commit();
    EXPECT_EQ(read_file(folder.path() / "file"), "whole");
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"file"}));
}

// oracle: names that this machine's processes do not give to temporary files, folders and links
TEST(temporary_file, other_files_stay) {
    const TemporaryFolder folder, elsewhere;
    write_file_atomically(elsewhere.path() / "target", "x");
    const std::string mark = ".dynlab-" + machine_in_names();
    std::set<std::string> names = {".config.2024-1",
                                   ".analysis.lua.4711-0",
                                   "analysis.lua" + mark + "-4711-0",
                                   ".analysis.lua" + mark + "-4711",
                                   ".analysis.lua" + mark + "-4711-x",
                                   ".analysis.lua" + mark + "x-4711-0",
                                   ".analysis.lua.dynlab-x" + machine_in_names() + "-4711-0"};
    for (const std::string& name : names) write_file_atomically(folder.path() / name, "x");
    for (const std::string name : {".folder", ".link"}) names.insert(name + mark + "-4711-0");
    fs::create_directory(folder.path() / (".folder" + mark + "-4711-0"));
    fs::create_symlink(elsewhere.path() / "target", folder.path() / (".link" + mark + "-4711-0"));
    EXPECT_TRUE(remove_leftover_files(folder.path()).empty());
    EXPECT_EQ(names_in(folder.path()), names);
    EXPECT_TRUE(remove_leftover_files(folder.path() / "none").empty());
}

// oracle: a file system that renames within itself
TEST(temporary_file, lies_in_the_named_folder_until_it_is_committed) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "new");
    {
        ReplacementFile file(folder.path() / "file", folder.path() / "new");
        EXPECT_EQ(names_in(folder.path() / "new").size(), 1u);
        file.append("whole");
        file.commit();
    }
    write_files_atomically({{folder.path() / "second", "whole"}}, folder.path() / "new");
    EXPECT_TRUE(names_in(folder.path() / "new").empty());
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"file", "new", "second"}));
}

// oracle: a process that cleans up and one that makes a file, at the same time: whoever comes first, the file is
// written
TEST(temporary_file, making_and_cleaning_up_at_once_loses_nothing) {
    const TemporaryFolder folder;
    const pid_t parent = ::getpid(), cleaner = ::fork();
    if (cleaner == 0) {
        while (::getppid() == parent) remove_leftover_files(folder.path());
        ::_exit(0);
    }
    bool whole = true;
    for (int i = 0; whole && i < 2000; ++i) {
        ReplacementFile file(folder.path() / "file");
        file.append(std::to_string(i));
        file.commit();
        whole = read_file(folder.path() / "file") == std::to_string(i);
    }
    EXPECT_TRUE(whole);
    ::kill(cleaner, SIGKILL);
    ASSERT_EQ(::waitpid(cleaner, nullptr, 0), cleaner);
}

}  // namespace test_temporary_file
}  // namespace dynlab
