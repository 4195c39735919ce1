// Oracle: what is there afterwards, in a process that ends without the destructors of its objects.
#include "platform/files/ends_with_program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "platform/atomic_file.h"
#include "platform/files/replacement_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_ends_with_program {

namespace fs = std::filesystem;

/// In a copy of this process, which ends at once.
void in_a_copy(const std::function<void()>& work) {
    const pid_t copy = ::fork();
    if (copy == 0) {
        work();
        end_what_ends_with_program();
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(copy, &status, 0), copy);
    EXPECT_EQ(status, 0);
}

bool holds_nothing(const fs::path& folder) {
    return fs::directory_iterator(folder) == fs::directory_iterator();
}

TEST(ends_with_program, folders_and_files_are_removed) {
    const TemporaryFolder work;
    const fs::path outside = work.path() / "outside", inside = work.path() / "inside";
    fs::create_directories(outside);
    write_file_atomically(outside / "kept.txt", "kept");
    fs::create_directories(inside);
    in_a_copy([&] {
        ::setenv("TMPDIR", inside.c_str(), 1);
        std::optional<TemporaryFolder> folder(std::in_place), gone(std::in_place);
        gone.reset();
        fs::create_directories(folder->path() / "a/b/c");
        for (int i = 0; i < 300; ++i) std::ofstream(folder->path() / "a" / ("file" + std::to_string(i))) << i;
        fs::create_directory_symlink(outside, folder->path() / "link");
        write_file_atomically(inside / "half.txt", "half");
        static std::optional<ReplacementFile> half(std::in_place, inside / "other.txt");
        half->append("half");
        EXPECT_FALSE(holds_nothing(folder->path()));
        end_what_ends_with_program();
        ::_exit(fs::exists(folder->path()) ? 1 : 0);
    });
    EXPECT_EQ(read_file(outside / "kept.txt"), "kept");
    EXPECT_EQ(read_file(inside / "half.txt"), "half");
    fs::remove(inside / "half.txt");
    EXPECT_TRUE(holds_nothing(inside));
}

TEST(ends_with_program, what_belongs_to_another_process_stays) {
    const TemporaryFolder folder;
    in_a_copy([] {});
    EXPECT_TRUE(fs::exists(folder.path()));
}

TEST(ends_with_program, groups_are_killed) {
    const pid_t other = ::fork();
    if (other == 0) {
        ::setpgid(0, 0);
        ::pause();
        ::_exit(0);
    }
    ::setpgid(other, other);
    in_a_copy([other] {
        static const EndsWithProgram group = EndsWithProgram::of_group(other);
        end_what_ends_with_program();
    });
    int status = 0;
    ASSERT_EQ(::waitpid(other, &status, 0), other);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

// Files whose names begin as one path and end as another: what a path is called while it is written over the other.
TEST(ends_with_program, a_path_that_another_thread_writes_is_not_mistaken) {
    constexpr std::size_t kLetters = 200;
    const TemporaryFolder work;
    const std::string first(kLetters, 'a'), second(kLetters, 'b');
    for (std::size_t i = 1; i < kLetters; ++i)
        for (const auto& [begin, end] : {std::pair(first, second), std::pair(second, first)})
            std::ofstream(work.path() / (begin.substr(i) + end.substr(kLetters - i))) << i;
    in_a_copy([&] {
        std::atomic<bool> done = false;
        std::thread writes([&] {
            while (!done)
                for (const std::string& name : {first, second}) EndsWithProgram(work.path() / name);
        });
        for (int i = 0; i < 300'000; ++i) end_what_ends_with_program();
        done = true;
        writes.join();
    });
    EXPECT_EQ(std::distance(fs::directory_iterator(work.path()), fs::directory_iterator()), 2 * (kLetters - 1));
}

TEST(ends_with_program, more_than_it_can_hold_are_left_behind) {
    const TemporaryFolder work;
    in_a_copy([&work] {
        static std::vector<EndsWithProgram> many;
        for (int i = 0; i < 1000; ++i) {
            const fs::path file = work.path() / std::to_string(i);
            std::ofstream(file) << i;
            many.emplace_back(file);
        }
    });
    EXPECT_FALSE(fs::exists(work.path() / "0"));
    EXPECT_TRUE(fs::exists(work.path() / "999"));
}

}  // namespace test_ends_with_program
}  // namespace dynlab
