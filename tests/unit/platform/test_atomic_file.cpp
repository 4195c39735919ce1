#include "platform/atomic_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "support/other_file_system.h"

namespace dynlab {
namespace test_atomic_file {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const EnvironmentError& error) {
        return error.what();
    }
    return "no error";
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Files may not grow beyond `bytes` while this lives: what a full disk does, without one.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before_);
        signal_before_ = signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        signal(SIGXFSZ, signal_before_);
    }

  private:
    rlimit before_;
    sighandler_t signal_before_;
};

TEST(atomic_file, holds_what_was_written) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a b.bin";
    const std::string content("line\n\0binary\xff", 13);
    write_file_atomically(file, content);
    EXPECT_EQ(read_file(file), content);
    write_file_atomically(file, "");
    EXPECT_EQ(read_file(file), "");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(atomic_file, keeps_the_old_file_when_the_disk_is_full) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "report.pdf";
    write_file_atomically(file, "old");
    std::string message;
    {
        const FileSizeLimit limit(1000);
        message = message_of([&] { write_file_atomically(file, std::string(5000, 'n')); });
    }
    EXPECT_EQ(message, "cannot write report.pdf: file too large (in " + folder.path().string() + ")");
    EXPECT_EQ(read_file(file), "old");
    EXPECT_EQ(files_in(folder.path()), 1u);
}

/// A device of our own, as a fault in the code could replace the real one when the tests run as root. Others cannot
/// make devices, but cannot replace the real one either. Empty where neither is possible.
fs::path memory_device(const fs::path& folder, const char* name, unsigned minor) {
    const fs::path own = folder / name;
    if (mknod(own.c_str(), S_IFCHR | 0666, makedev(1, minor)) == 0) return own;
    return geteuid() == 0 ? fs::path() : fs::path("/dev") / name;
}

TEST(atomic_file, says_that_the_disk_is_full) {  // oracle: device 1:7 (full) refuses every byte with ENOSPC
    const TemporaryFolder folder;
    const fs::path full = memory_device(folder.path(), "full", 7);
    if (full.empty()) GTEST_SKIP() << "devices can neither be made nor used safely here";
    EXPECT_EQ(message_of([&] { write_file_atomically(full, "x"); }),
              "cannot write full: no space left on device (in " + full.parent_path().string() + ")");
}

TEST(atomic_file, writes_into_devices_and_leaves_them_in_place) {
    const TemporaryFolder folder;
    const fs::path null = memory_device(folder.path(), "null", 3);
    if (null.empty()) GTEST_SKIP() << "devices can neither be made nor used safely here";
    write_file_atomically(null, "x");
    EXPECT_TRUE(fs::is_character_file(null));
    write_file_atomically(folder.path() / "finished", "x");
    place_file_atomically(folder.path() / "finished", null);
    EXPECT_TRUE(fs::is_character_file(null));
}

TEST(atomic_file, names_the_reason_when_the_folder_cannot_be_written) {
    const TemporaryFolder folder;
    write_file_atomically(folder.path() / "plain", "x");
    EXPECT_THAT(message_of([&] { write_file_atomically(folder.path() / "plain/report.pdf", "x"); }),
                HasSubstr("cannot write report.pdf: not a directory (in " + (folder.path() / "plain").string() + ")"));
    EXPECT_THAT(message_of([&] { write_file_atomically(folder.path() / "none/report.pdf", "x"); }),
                HasSubstr("no such file or directory"));
    EXPECT_THAT(message_of([&] { write_file_atomically(folder.path(), "x"); }), HasSubstr("is a directory"));
    EXPECT_THAT(message_of([] { write_file_atomically("/proc/report.pdf", "x"); }),
                HasSubstr("cannot write report.pdf: "));
}

TEST(atomic_file, keeps_permissions_and_symbolic_links) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "real", link = folder.path() / "link";
    write_file_atomically(file, "old");
    fs::permissions(file, fs::perms(0640));
    fs::create_symlink("real", link);
    write_file_atomically(link, "new");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(read_file(file), "new");
    EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
}

TEST(atomic_file, new_files_follow_the_umask) {
    const TemporaryFolder folder;
    const mode_t before = umask(027);
    write_file_atomically(folder.path() / "x", "x");
    umask(before);
    EXPECT_EQ(fs::status(folder.path() / "x").permissions(), fs::perms(0640));
}

TEST(atomic_file, places_a_finished_file) {
    const TemporaryFolder folder;
    const fs::path from = folder.path() / "from", to = folder.path() / "to";
    write_file_atomically(from, "content");
    write_file_atomically(to, "old");
    place_file_atomically(from, to);
    EXPECT_EQ(read_file(to), "content");
    EXPECT_FALSE(fs::exists(from));
}

TEST(atomic_file, places_a_file_across_file_systems) {
    const test::OtherFileSystem other;
    if (!other.is_there()) GTEST_SKIP() << "no second file system";
    const TemporaryFolder folder;
    const fs::path shared_memory = other.path() / "from", to = folder.path() / "to";
    write_file_atomically(shared_memory, std::string(600000, 'c'));
    write_file_atomically(to, "old");
    {
        const FileSizeLimit limit(1000);
        EXPECT_THROW(place_file_atomically(shared_memory, to), EnvironmentError);
    }
    EXPECT_EQ(read_file(to), "old");
    place_file_atomically(shared_memory, to);
    EXPECT_EQ(read_file(to), std::string(600000, 'c'));
    EXPECT_FALSE(fs::exists(shared_memory));
    EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(atomic_file, makes_files_on_one_file_system_for_another) {
    const test::OtherFileSystem other;
    if (!other.is_there()) GTEST_SKIP() << "no second file system";
    const TemporaryFolder folder;
    const std::string large(600000, 'c');
    const auto write = [&] {
        write_files_atomically({{folder.path() / "first", "1"}, {folder.path() / "large", large}}, other.path());
    };
    write();
    EXPECT_EQ(read_file(folder.path() / "first"), "1");
    EXPECT_EQ(read_file(folder.path() / "large"), large);
    write_file_atomically(folder.path() / "large", "old");
    fs::permissions(folder.path() / "large", fs::perms::owner_read | fs::perms::owner_write);
    {
        const FileSizeLimit limit(1000);
        EXPECT_THROW(write(), EnvironmentError);
    }
    EXPECT_EQ(read_file(folder.path() / "large"), "old");
    write();
    EXPECT_EQ(read_file(folder.path() / "large"), large);
    EXPECT_EQ(fs::status(folder.path() / "large").permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(files_in(folder.path()), 2u);
    EXPECT_EQ(files_in(other.path()), 0u);
}

TEST(atomic_file, placing_needs_a_source_and_leaves_the_destination) {
    const TemporaryFolder folder;
    write_file_atomically(folder.path() / "to", "old");
    EXPECT_THAT(message_of([&] { place_file_atomically(folder.path() / "none", folder.path() / "to"); }),
                HasSubstr("none"));
    EXPECT_EQ(read_file(folder.path() / "to"), "old");
}

TEST(atomic_file, reading_names_the_reason) {
    const TemporaryFolder folder;
    EXPECT_EQ(message_of([&] { read_file(folder.path() / "none"); }),
              "cannot read " + (folder.path() / "none").string() + ": no such file or directory");
    EXPECT_EQ(message_of([&] { read_file(folder.path()); }),
              "cannot read " + folder.path().string() + ": is a directory");
}

// oracle: what was written
TEST(atomic_file, writes_several_in_their_order) {
    const TemporaryFolder folder;
    const fs::path kept = folder.path() / "000";
    write_file_atomically(kept, "old");
    std::vector<NewFile> files;
    for (int i = 0; i < 150; ++i)
        files.push_back({folder.path() / fmt::format("{:03}", i), std::string(static_cast<std::size_t>(100 * i), 'x')});
    write_files_atomically(files);
    for (const NewFile& file : files) EXPECT_EQ(read_file(file.file), file.content);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 150);
    // One file cannot be written: the files before it may be new, the others stay as they were.
    files[140].file = folder.path() / "no such folder" / "file";
    for (NewFile& file : files) file.content = "new";
    EXPECT_THROW(write_files_atomically(files), EnvironmentError);
    bool old = false;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (i == 140) continue;
        const std::string content = read_file(files[i].file);
        old = old || content != "new";
        EXPECT_EQ(content, old ? std::string(100 * i, 'x') : "new") << i;
    }
    EXPECT_TRUE(old);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 150);
}

// oracle: Unicode, 23.8: U+FEFF at the start of a text is no part of it, anywhere else it is
TEST(atomic_file, only_a_mark_at_the_start_is_left_out) {
    const TemporaryFolder folder;
    const std::string mark = "\xEF\xBB\xBF";
    for (const auto& [bytes, text] :
         {std::pair(mark + "line\n", std::string("line\n")), std::pair(mark + mark + "x", mark + "x"),
          std::pair("x" + mark, "x" + mark), std::pair(mark, std::string()),
          std::pair(std::string("\xEF\xBB"), std::string("\xEF\xBB")), std::pair(std::string(), std::string())}) {
        write_file_atomically(folder.path() / "text", bytes);
        EXPECT_EQ(read_text(folder.path() / "text"), text);
        EXPECT_EQ(without_byte_order_mark(bytes), text);
    }
}

}  // namespace test_atomic_file
}  // namespace dynlab
