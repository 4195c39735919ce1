#include "platform/hash.h"

#include <gtest/gtest.h>

#include <set>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_hash {

// Oracle: the examples NIST publishes with FIPS 180-4 (one block, two blocks, the empty message, a million a's).
TEST(hash, sha256_gives_the_digests_published_with_the_standard) {
    EXPECT_EQ(sha256_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// Oracle: another program, printf abc | xxhsum -H2 (Debian's package xxhash).
TEST(hash, digests_are_those_of_the_reference_program) {
    EXPECT_EQ(digest_of("").hex(), "99aa06d3014798d86001c324468d497f");
    EXPECT_EQ(digest_of("abc").hex(), "06b05ab6733a618578af5f94892f3950");
    EXPECT_EQ(digest_of(std::string(1000000, 'a')).hex(), "a545df8e384a9579b1fd6fae5285c4eb");
}

// Oracle: definition; both are of the bytes, however they are portioned.
TEST(hash, does_not_depend_on_portions) {
    std::string text;
    for (int i = 0; i < 500; ++i) text += static_cast<char>(i * 7);
    for (const std::size_t portion : {1u, 3u, 55u, 63u, 64u, 65u, 130u}) {
        Sha256 hash;
        DigestStream digest;
        for (std::size_t at = 0; at < text.size(); at += portion) {
            const std::string_view part = std::string_view(text).substr(at, portion);
            hash.add(part);
            digest.add(part.data(), part.size());
        }
        EXPECT_EQ(hash.hex(), sha256_of(text)) << portion;
        EXPECT_EQ(digest.digest(), digest_of(text)) << portion;
    }
}

// Oracle: definition; a digest of parts depends on the end of each part, also of an empty one.
TEST(hash, parts_are_distinguished) {
    const auto of_parts = [](std::initializer_list<std::string_view> parts) {
        DigestStream stream;
        for (const std::string_view part : parts) stream.add_part(part);
        return stream.digest().hex();
    };
    EXPECT_EQ(of_parts({"ab", "c"}), of_parts({"ab", "c"}));
    const std::set<std::string> all = {of_parts({"ab", "c"}), of_parts({"a", "bc"}),     of_parts({"abc"}),
                                       of_parts({"c", "ab"}), of_parts({"ab", "c", ""}), of_parts({})};
    EXPECT_EQ(all.size(), 6u);
}

TEST(hash, of_a_file_is_that_of_its_bytes) {
    const TemporaryFolder folder;
    const std::string text(300000, 'x');
    write_file_atomically(folder.path() / "x", text);
    EXPECT_EQ(sha256_of_file(folder.path() / "x"), sha256_of(text));
    EXPECT_EQ(digest_of_file(folder.path() / "x"), digest_of(text));
    for (const auto& file : {folder.path() / "none", folder.path()}) {
        EXPECT_THROW(sha256_of_file(file), EnvironmentError);
        EXPECT_THROW(digest_of_file(file), EnvironmentError);
    }
}

}  // namespace test_hash
}  // namespace dynlab
