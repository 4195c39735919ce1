// Oracle: what was given to be remembered, and the promise that trouble with the disk only forgets.
#include "platform/content_cache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_content_cache {

namespace fs = std::filesystem;

class content_cache : public testing::Test {
  protected:
    void SetUp() override {
        setenv("XDG_CACHE_HOME", home_.path().c_str(), 1);
        unsetenv("DYNLAB_NO_CACHE");
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

    fs::path root() const { return home_.path() / "dynlab/test"; }
    fs::path file_of(const std::string& key) const { return root() / key / "content"; }
    const std::string bytes_ = std::string("any\0bytes\xff", 10);
    TemporaryFolder home_;
};

TEST_F(content_cache, gives_back_the_bytes_of_an_equal_key) {
    ContentCache memory("test");
    const std::string key = memory.key({"a", "b"});
    EXPECT_FALSE(memory.recall(key));
    memory.remember(key, bytes_);
    memory.remember(memory.key({"empty"}), "");
    EXPECT_EQ(memory.recall(key), bytes_);
    ContentCache later("test");
    EXPECT_EQ(later.recall(later.key({"a", "b"})), bytes_);
    EXPECT_EQ(later.recall(later.key({"empty"})), "");
    EXPECT_EQ(memory.remembered(), 2u);
    EXPECT_EQ(later.recalled(), 2u);
}

TEST_F(content_cache, every_part_and_where_it_ends_makes_the_key) {
    const ContentCache memory("test");
    const std::string key = memory.key({"ab", "c"});
    EXPECT_EQ(key, memory.key({"ab", "c"}));
    EXPECT_NE(key, memory.key({"a", "bc"}));
    EXPECT_NE(key, memory.key({"ab", "d"}));
    EXPECT_NE(key, memory.key({"ab", "c", ""}));
    EXPECT_NE(key, memory.key({"c", "ab"}));
}

TEST_F(content_cache, spoilt_entries_are_not_recalled_and_can_be_made_again) {
    ContentCache memory("test");
    const std::string key = memory.key({"a"});
    memory.remember(key, bytes_);
    const std::string whole = read_file(file_of(key));
    std::string flipped = whole;
    flipped.back() ^= 1;
    for (const std::string& spoilt : {whole.substr(0, whole.size() - 1), whole + "x", flipped, std::string()}) {
        write_file_atomically(file_of(key), spoilt);
        EXPECT_FALSE(memory.recall(key));
        memory.remember(key, bytes_);
        EXPECT_EQ(memory.recall(key), bytes_);
    }
    fs::remove(file_of(key));
    EXPECT_FALSE(memory.recall(key));
    memory.remember(key, bytes_);
    EXPECT_EQ(memory.recall(key), bytes_);
}

TEST_F(content_cache, trouble_with_the_disk_only_forgets) {
    ContentCache memory("test");
    const std::string key = memory.key({"a"});
    memory.remember(key, bytes_);
    fs::remove_all(home_.path() / "dynlab");
    EXPECT_FALSE(memory.recall(key));
    memory.remember(key, bytes_);
    EXPECT_EQ(memory.recall(key), bytes_);
    fs::remove_all(root());
    std::ofstream(root()) << "no folder";  // nothing can be written below it
    EXPECT_FALSE(memory.recall(key));
    EXPECT_NO_THROW(memory.remember(key, bytes_));
    EXPECT_FALSE(memory.recall(key));
}

TEST_F(content_cache, is_bounded) {
    constexpr std::size_t kEach = 1000;
    ContentCache memory("test", 20 * kEach);
    for (int i = 0; i < 60; ++i) {
        const std::string key = memory.key({std::to_string(i)});
        memory.remember(key, std::string(kEach, 'c'));
        fs::last_write_time(root() / key, fs::file_time_type::clock::now() - std::chrono::hours(60 - i));
    }
    const auto left = std::distance(fs::directory_iterator(root()), fs::directory_iterator());
    EXPECT_GE(left, 15);
    EXPECT_LE(left, 22);
    EXPECT_TRUE(memory.recall(memory.key({"59"})));
    EXPECT_FALSE(memory.recall(memory.key({"0"})));
}

}  // namespace test_content_cache
}  // namespace dynlab
