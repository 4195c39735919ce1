#include "platform/cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "platform/atomic_file.h"
#include "platform/process_group.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace dynlab {
namespace test_cache {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class cache : public testing::Test {
  protected:
    static fs::path add(const Cache& store, const std::string& key, std::size_t bytes) {
        const fs::path folder = store.prepare();
        write_file_atomically(folder / "content", std::string(bytes, 'c'));
        return store.commit(folder, key);
    }
    static void set_age(const fs::path& entry, std::chrono::hours age) {
        fs::last_write_time(entry, fs::file_time_type::clock::now() - age);
    }
    std::size_t entries(const char* kind = "test") const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(home_.path() / "dynlab" / kind), fs::directory_iterator()));
    }

    const std::string bytes_ = std::string("any\0bytes\xff", 10);
    TemporaryFolder home_;
    test::EnvironmentVariable cache_home_{"XDG_CACHE_HOME", home_.path()}, no_cache_{"DYNLAB_NO_CACHE", {}};
};

TEST_F(cache, finds_what_was_committed_and_nothing_else) {
    const Cache store;
    EXPECT_EQ(store.root(), home_.path() / "dynlab");
    EXPECT_FALSE(store.find("test/key"));
    const fs::path unfinished = store.prepare();
    EXPECT_FALSE(store.find("test/key"));
    EXPECT_EQ(store.commit(unfinished, "test/key"), store.root() / "test/key");
    EXPECT_EQ(Cache().find("test/key"), store.root() / "test/key");
    EXPECT_FALSE(Cache().find("other/key"));
}

// oracle: processes that were killed between prepare and commit, and one that is still at work
TEST_F(cache, unfinished_entries_of_killed_processes_are_removed_by_the_next_one) {
    const auto unfinished = [&] {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(home_.path() / "dynlab"))
            count += entry.path().filename().string().starts_with(".new-");
        return count;
    };
    Pipe ready;
    const auto start = [&] {
        const pid_t process = ::fork();
        if (process == 0) {
            write_file_atomically(Cache().prepare() / "content", "half");
            write_all(ready.write_end.get(), "x", 1);
            for (;;) ::pause();
        }
        char said = 0;
        EXPECT_EQ(::read(ready.read_end.get(), &said, 1), 1);
        return process;
    };
    const auto kill_it = [](pid_t process) {
        ::kill(process, SIGKILL);
        ::waitpid(process, nullptr, 0);
    };
    const auto look_in_another_process = [] {
        const pid_t process = ::fork();
        if (process == 0) {
            const Cache store;
            ::_exit(0);
        }
        ::waitpid(process, nullptr, 0);
    };
    const pid_t killed = start(), alive = start();
    EXPECT_EQ(unfinished(), 2u);
    kill_it(killed);
    look_in_another_process();
    EXPECT_EQ(unfinished(), 1u);
    kill_it(alive);
    look_in_another_process();
    EXPECT_EQ(unfinished(), 0u);
}

TEST_F(cache, first_of_two_writers_wins) {
    const Cache store;
    const fs::path mine = store.prepare(), theirs = store.prepare();
    write_file_atomically(mine / "content", "mine");
    write_file_atomically(theirs / "content", "theirs");
    store.commit(theirs, "test/key");
    const fs::path kept = store.commit(mine, "test/key");
    EXPECT_EQ(read_file(kept / "content"), "theirs");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(cache, drops_the_least_recently_used_beyond_the_limit) {
    const Cache store(2500);
    set_age(add(store, "test/a", 1000), 3h);
    set_age(add(store, "test/b", 1000), 2h);
    ASSERT_TRUE(store.find("test/a"));  // used now, so b is the oldest
    add(store, "test/c", 1000);
    EXPECT_TRUE(store.find("test/a"));
    EXPECT_FALSE(store.find("test/b"));
    EXPECT_TRUE(store.find("test/c"));
    EXPECT_EQ(entries(), 2u);
}

TEST_F(cache, keeps_what_was_used_just_now_even_beyond_the_limit) {
    const Cache store(100);
    add(store, "test/a", 1000);
    add(store, "test/b", 1000);
    EXPECT_TRUE(store.find("test/a") && store.find("test/b"));
}

TEST_F(cache, sweeps_what_a_dead_process_left_unfinished) {
    const Cache store;
    const fs::path dead = store.prepare(), alive = store.prepare();
    set_age(dead, 2h);
    add(store, "test/a", 10);
    EXPECT_FALSE(fs::exists(dead));
    EXPECT_TRUE(fs::exists(alive));
}

TEST_F(cache, may_be_deleted_at_any_time) {
    const Cache store;
    add(store, "test/a", 10);
    fs::remove_all(home_.path() / "dynlab");
    EXPECT_FALSE(store.find("test/a"));
    add(store, "test/a", 10);
    EXPECT_TRUE(store.find("test/a"));
}

TEST_F(cache, survives_many_writers_at_once) {
    constexpr int kWriters = 6, kKeys = 40;
    for (int writer = 0; writer < kWriters; ++writer) {
        if (fork() != 0) continue;
        bool whole = true;
        try {
            const Cache store(20000);
            for (int key = 0; key < kKeys; ++key) {
                const fs::path entry = add(store, "test/" + std::to_string(key), 1000);
                whole = whole && read_file(entry / "content").size() == 1000;
            }
        } catch (const std::exception&) {
            whole = false;
        }
        _exit(whole ? 0 : 1);
    }
    for (int writer = 0; writer < kWriters; ++writer) {
        int status = -1;
        wait(&status);
        EXPECT_EQ(status, 0);
    }
    EXPECT_EQ(entries(), static_cast<std::size_t>(kKeys));
}

TEST_F(cache, is_private_when_switched_off_or_impossible) {
    no_cache_.set("1");
    const Cache off;
    add(off, "test/a", 10);
    EXPECT_TRUE(off.find("test/a"));
    EXPECT_FALSE(fs::exists(home_.path() / "dynlab"));
    no_cache_.set({});
    write_file_atomically(home_.path() / "plain", "x");
    cache_home_.set(home_.path() / "plain");
    EXPECT_EQ(Cache().root(), off.root());
}

TEST_F(cache, lasts_only_where_later_runs_find_it) {
    EXPECT_TRUE(Cache().lasting());
    no_cache_.set("1");
    EXPECT_FALSE(Cache().lasting());
    no_cache_.set({});
    cache_home_.set("/proc/none");
    EXPECT_FALSE(Cache().lasting());
}

TEST_F(cache, names_are_a_kind_and_a_plain_name) {
    const Cache store;
    for (const char* name :
         {"", "..", "key", "a/", "/b", "a/b/c", "a/..", "../b", "a/.hidden", ".hidden/b", "a//b", "/a/b"}) {
        EXPECT_THROW(store.find(name), std::invalid_argument) << name;
        EXPECT_THROW(store.load_entry(name), std::invalid_argument) << name;
        EXPECT_THROW(store.save_entry(name, ""), std::invalid_argument) << name;
        EXPECT_THROW(store.erase_entry(name), std::invalid_argument) << name;
    }
}

// ---- names

TEST_F(cache, every_part_and_where_it_ends_makes_the_name) {
    const auto name = [](std::initializer_list<std::string_view> parts, const char* kind = "test") {
        EntryName entry(kind);
        for (const std::string_view part : parts) entry.add(part);
        return entry.text();
    };
    EXPECT_EQ(name({"ab", "c"}), name({"ab", "c"}));
    EXPECT_NE(name({"ab", "c"}), name({"a", "bc"}));
    EXPECT_NE(name({"ab", "c"}), name({"ab", "d"}));
    EXPECT_NE(name({"ab", "c"}), name({"ab", "c", ""}));
    EXPECT_NE(name({"ab", "c"}), name({"c", "ab"}));
    EXPECT_NE(name({"ab", "c"}), name({"ab", "c"}, "other"));
}

TEST_F(cache, what_makes_the_entries_is_part_of_their_names) {
    EXPECT_EQ(EntryName("test", "TeX 3.14").add("a").text(), EntryName("test", "TeX 3.14").add("a").text());
    EXPECT_NE(EntryName("test", "TeX 3.14").add("a").text(), EntryName("test", "TeX 3.15").add("a").text());
    EXPECT_NE(EntryName("test", "TeX 3.14").add("a").text(), EntryName("test").add("a").text());
}

// ---- bytes

TEST_F(cache, gives_back_the_bytes_of_a_name) {
    const Cache store;
    EXPECT_FALSE(store.load_entry("test/a"));
    store.save_entry("test/a", bytes_);
    store.save_entry("test/empty", "");
    EXPECT_EQ(store.load_entry("test/a"), bytes_);
    EXPECT_EQ(Cache().load_entry("test/a"), bytes_);
    EXPECT_EQ(Cache().load_entry("test/empty"), "");
    store.save_entry("test/a", "later");
    EXPECT_EQ(Cache().load_entry("test/a"), "later");
    store.erase_entry("test/a");
    EXPECT_FALSE(store.load_entry("test/a"));
    EXPECT_EQ(entries(), 1u);
}

TEST_F(cache, corrupt_bytes_are_no_hit_and_can_be_stored_again) {
    const Cache store;
    store.save_entry("test/a", bytes_);
    const fs::path file = store.root() / "test/a";
    const std::string whole = read_file(file);
    std::string flipped = whole;
    flipped.back() ^= 1;
    for (const std::string& corrupt : {whole.substr(0, whole.size() - 1), whole + "x", flipped, std::string()}) {
        write_file_atomically(file, corrupt);
        EXPECT_FALSE(store.load_entry("test/a"));
        EXPECT_FALSE(fs::exists(file));
        store.save_entry("test/a", bytes_);
        EXPECT_EQ(store.load_entry("test/a"), bytes_);
    }
    fs::remove(file);
    fs::create_directories(file / "folder");  // as an earlier program may have left it
    EXPECT_FALSE(store.load_entry("test/a"));
    store.save_entry("test/a", bytes_);
    EXPECT_EQ(store.load_entry("test/a"), bytes_);
}

TEST_F(cache, a_disk_error_only_loses_the_entry) {
    const Cache store;
    store.save_entry("test/a", bytes_);
    fs::remove_all(store.root());
    EXPECT_FALSE(store.load_entry("test/a"));
    store.save_entry("test/a", bytes_);
    EXPECT_EQ(store.load_entry("test/a"), bytes_);
    fs::remove_all(store.root() / "test");
    std::ofstream(store.root() / "test") << "no folder";  // nothing can be written below it
    EXPECT_FALSE(store.load_entry("test/a"));
    EXPECT_NO_THROW(store.save_entry("test/a", bytes_));
    EXPECT_FALSE(store.load_entry("test/a"));
    fs::remove_all(store.root());
    std::ofstream(store.root()) << "no folder";
    EXPECT_FALSE(store.load_entry("test/a"));
    EXPECT_NO_THROW(store.save_entry("test/a", bytes_));
    EXPECT_FALSE(store.load_entry("test/a"));
}

TEST_F(cache, bytes_of_all_kinds_share_the_limit) {
    constexpr std::size_t kEach = 1000;
    const Cache store(20 * kEach);
    for (int i = 0; i < 60; ++i) {
        const std::string name = (i % 2 == 0 ? "even/" : "odd/") + std::to_string(i);
        store.save_entry(name, std::string(kEach, 'c'));
        set_age(store.root() / name, std::chrono::hours(60 - i));
    }
    const auto left = entries("even") + entries("odd");
    EXPECT_GE(left, 15u);
    EXPECT_LE(left, 22u);
    EXPECT_TRUE(store.load_entry("odd/59"));
    EXPECT_FALSE(store.load_entry("even/0"));
}

// Oracle: the count of entries. Each of many short runs writes far less than a sixteenth of the limit.
TEST_F(cache, the_limit_holds_over_many_runs_that_write_little) {
    for (int i = 0; i < 100; ++i) {
        const Cache store(20000);
        const std::string name = "test/" + std::to_string(i);
        store.save_entry(name, std::string(400, 'c'));
        set_age(store.root() / name, std::chrono::hours(100 - i));
    }
    EXPECT_GE(entries(), 35u);
    EXPECT_LE(entries(), 20000u / 432u + 1 + 20000u / 16 / 432u + 1);
}

}  // namespace test_cache
}  // namespace dynlab
