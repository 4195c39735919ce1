#include "platform/files/temporary_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

// oracle: flock(2): a lock belongs to one open file
TEST(temporary_file, the_lock_of_another_is_not_waited_for) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "file";
    const FileDescriptor made(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644)),
        other(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    ASSERT_EQ(::flock(other.get(), LOCK_SH), 0);
    EXPECT_FALSE(lock_as_in_use(made.get(), file));
    ASSERT_EQ(::flock(other.get(), LOCK_UN), 0);
    EXPECT_TRUE(lock_as_in_use(made.get(), file));
}

/// Locks each new file in a folder as soon as it hears of it, if it can, and keeps the newest locked.
[[noreturn]] void lock_new_files(const fs::path& folder, int news) {
    FileDescriptor locked;
    for (;;) {
        alignas(inotify_event) char block[1 << 14];
        const ssize_t bytes = ::read(news, block, sizeof block);
        if (bytes <= 0) ::_exit(1);
        for (ssize_t at = 0; at < bytes;) {
            const auto* const event = reinterpret_cast<const inotify_event*>(block + at);
            FileDescriptor opened(event->len == 0 ? -1 : ::open((folder / event->name).c_str(), O_RDONLY | O_CLOEXEC));
            if (opened && ::flock(opened.get(), LOCK_EX | LOCK_NB) == 0) locked = std::move(opened);
            at += static_cast<ssize_t>(sizeof *event + event->len);
        }
    }
}

// oracle: the files that are there and whose lock is not to be had, though some were locked before their maker could
TEST(temporary_file, a_process_that_locks_new_files_first_blocks_nothing) {
    const TemporaryFolder folder;
    const FileDescriptor news(::inotify_init1(IN_CLOEXEC));
    ASSERT_GE(::inotify_add_watch(news.get(), folder.path().c_str(), IN_CREATE), 0);
    const pid_t parent = ::getpid(), other = ::fork();
    if (other == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(0);
        lock_new_files(folder.path(), news.get());
    }
    for (int i = 0; i < 5000; ++i) {
        const TemporaryFile made = make_temporary_file(folder.path(), "file", 0644);
        const FileDescriptor again(::open(made.path.c_str(), O_RDONLY | O_CLOEXEC));
        ASSERT_TRUE(made.file && again);
        EXPECT_EQ(::flock(again.get(), LOCK_EX | LOCK_NB), -1);
        fs::remove(made.path);
    }
    EXPECT_TRUE(names_in(folder.path()).empty());
    ::kill(other, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(other, &status, 0), other);
    EXPECT_TRUE(WIFSIGNALED(status));  // it had not ended before
}

// oracle: names of 64 letters, as Linux gives at most, of two nodes of a cluster
TEST(temporary_file, no_two_machines_have_the_same_name_in_names) {
    const std::string common = "compute-node-of-the-department-of-automatic-control-rack-7-unit";
    EXPECT_EQ(machine_in_names("desk-7"), "desk-7");
    EXPECT_EQ(machine_in_names(std::string(24, 'a')), std::string(24, 'a'));
    const std::vector<std::string> machines = {common + "1", common + "2", common, common.substr(0, 24),
                                               "a.b",        "a-b",        "a_b",  std::string(25, 'a')};
    std::set<std::string> names;
    for (const std::string& machine : machines) {
        const std::string name = machine_in_names(machine);
        EXPECT_LE(name.size(), 24u);
        EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_"),
                  std::string::npos)
            << name;
        EXPECT_EQ(name, machine_in_names(machine));
        names.insert(name);
    }
    EXPECT_EQ(names.size(), machines.size());
}

// oracle: one process cleans up while another makes a file; the file is written in either order
TEST(temporary_file, making_and_cleaning_up_at_once_loses_nothing) {
    const TemporaryFolder folder;
    const pid_t parent = ::getpid(), cleaner = ::fork();
    if (cleaner == 0) {
        while (::getppid() == parent) remove_leftover_files(folder.path());
        ::_exit(0);
    }
    bool whole = true;
    for (int i = 0; whole && i < 500; ++i) {
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
