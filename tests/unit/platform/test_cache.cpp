#include "platform/cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_cache {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class cache : public testing::Test {
  protected:
    void SetUp() override {
        setenv("XDG_CACHE_HOME", home_.path().c_str(), 1);
        unsetenv("DYNLAB_NO_CACHE");
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

    static fs::path add(const Cache& store, const std::string& key, std::size_t bytes) {
        const fs::path folder = store.prepare();
        write_file_atomically(folder / "content", std::string(bytes, 'c'));
        return store.commit(folder, key);
    }
    static void set_age(const fs::path& entry, std::chrono::hours age) {
        fs::last_write_time(entry, fs::file_time_type::clock::now() - age);
    }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(home_.path() / "dynlab/test"), fs::directory_iterator()));
    }

    TemporaryFolder home_;
};

TEST_F(cache, finds_what_was_committed_and_nothing_else) {
    const Cache store("test");
    EXPECT_EQ(store.root(), home_.path() / "dynlab/test");
    EXPECT_FALSE(store.find("key"));
    const fs::path unfinished = store.prepare();
    EXPECT_FALSE(store.find("key"));
    EXPECT_EQ(store.commit(unfinished, "key"), store.root() / "key");
    EXPECT_EQ(Cache("test").find("key"), store.root() / "key");
    EXPECT_FALSE(Cache("other").find("key"));
}

TEST_F(cache, first_of_two_writers_wins) {
    const Cache store("test");
    const fs::path mine = store.prepare(), theirs = store.prepare();
    write_file_atomically(mine / "content", "mine");
    write_file_atomically(theirs / "content", "theirs");
    store.commit(theirs, "key");
    const fs::path kept = store.commit(mine, "key");
    EXPECT_EQ(read_file(kept / "content"), "theirs");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(cache, drops_the_least_recently_used_beyond_the_limit) {
    const Cache store("test", 2500);
    set_age(add(store, "a", 1000), 3h);
    set_age(add(store, "b", 1000), 2h);
    ASSERT_TRUE(store.find("a"));  // used now, so b is the oldest
    add(store, "c", 1000);
    EXPECT_TRUE(store.find("a"));
    EXPECT_FALSE(store.find("b"));
    EXPECT_TRUE(store.find("c"));
    EXPECT_EQ(entries(), 2u);
}

TEST_F(cache, keeps_what_was_used_just_now_even_beyond_the_limit) {
    const Cache store("test", 100);
    add(store, "a", 1000);
    add(store, "b", 1000);
    EXPECT_TRUE(store.find("a") && store.find("b"));
}

TEST_F(cache, sweeps_what_a_dead_process_left_unfinished) {
    const Cache store("test");
    const fs::path dead = store.prepare(), alive = store.prepare();
    set_age(dead, 2h);
    add(store, "a", 10);
    EXPECT_FALSE(fs::exists(dead));
    EXPECT_TRUE(fs::exists(alive));
}

TEST_F(cache, may_be_deleted_at_any_time) {
    const Cache store("test");
    add(store, "a", 10);
    fs::remove_all(home_.path() / "dynlab");
    EXPECT_FALSE(store.find("a"));
    add(store, "a", 10);
    EXPECT_TRUE(store.find("a"));
}

TEST_F(cache, survives_many_writers_at_once) {
    constexpr int kWriters = 6, kKeys = 40;
    for (int writer = 0; writer < kWriters; ++writer) {
        if (fork() != 0) continue;
        bool whole = true;
        try {
            const Cache store("test", 20000);
            for (int key = 0; key < kKeys; ++key) {
                const fs::path entry = add(store, std::to_string(key), 1000);
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
    setenv("DYNLAB_NO_CACHE", "1", 1);
    const Cache off("test");
    add(off, "a", 10);
    EXPECT_TRUE(off.find("a"));
    EXPECT_FALSE(fs::exists(home_.path() / "dynlab"));
    unsetenv("DYNLAB_NO_CACHE");
    write_file_atomically(home_.path() / "plain", "x");
    setenv("XDG_CACHE_HOME", (home_.path() / "plain").c_str(), 1);
    EXPECT_EQ(Cache("other").root().parent_path(), off.root().parent_path());
}

TEST_F(cache, keys_are_plain_names) {
    const Cache store("test");
    for (const char* key : {"", "..", "a/b", ".hidden"}) EXPECT_THROW(store.find(key), std::invalid_argument) << key;
}

}  // namespace test_cache
}  // namespace dynlab
