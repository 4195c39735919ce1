#include "platform/keys/session_key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_session_key {

TEST(session_key, opens_what_was_sealed_with_it_for_the_same_place_only) {
    const SessionKey key = SessionKey::fresh(), other = SessionKey::fresh();
    const std::string text = std::string("hidden\0record", 13), sealed = key.seal(text, "job 1");
    EXPECT_EQ(key.open(sealed, "job 1"), text);
    EXPECT_EQ(key.open(sealed, "job 2"), std::nullopt);
    EXPECT_EQ(other.open(sealed, "job 1"), std::nullopt);
    EXPECT_EQ(sealed.find("hidden"), std::string::npos);
    EXPECT_NE(sealed, key.seal(text, "job 1"));
    for (std::size_t i = 0; i < sealed.size(); ++i) {
        std::string forged = sealed;
        forged[i] = static_cast<char>(forged[i] ^ 1);
        EXPECT_EQ(key.open(forged, "job 1"), std::nullopt) << i;
        EXPECT_EQ(key.open(sealed.substr(0, i), "job 1"), std::nullopt) << i;
    }
}

TEST(session_key, names_equal_bytes_alike_under_one_key) {
    const SessionKey key = SessionKey::fresh();
    EXPECT_EQ(key.name_of("a"), key.name_of("a"));
    EXPECT_NE(key.name_of("a"), key.name_of("b"));
    EXPECT_NE(key.name_of("a"), SessionKey::fresh().name_of("a"));
    EXPECT_EQ(key.name_of("").size(), 32u);
}

TEST(session_key, lies_in_a_file_that_its_owner_alone_may_read) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "key";
    const SessionKey key = SessionKey::fresh();
    const mode_t before = ::umask(0);
    key.save(file);
    ::umask(before);
    struct stat status {};
    ASSERT_EQ(::stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u);
    EXPECT_EQ(SessionKey::in_file(file).open(key.seal("x", "p"), "p"), "x");
    ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
    EXPECT_THROW(SessionKey::in_file(file), EnvironmentError);
    write_file_atomically(folder.path() / "short", "no key");
    ASSERT_EQ(::chmod((folder.path() / "short").c_str(), 0600), 0);
    EXPECT_THROW(SessionKey::in_file(folder.path() / "short"), EnvironmentError);
    std::filesystem::create_symlink(file, folder.path() / "link");
    EXPECT_THROW(SessionKey::in_file(folder.path() / "link"), EnvironmentError);
    EXPECT_THROW(SessionKey::in_file(folder.path() / "none"), EnvironmentError);
}

}  // namespace test_session_key
}  // namespace dynlab
