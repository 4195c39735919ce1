#include "platform/content_hash.h"

#include <gtest/gtest.h>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"

namespace dynlab {
namespace test_content_hash {

// Oracle: the examples NIST publishes with FIPS 180-4 (one block, two blocks, the empty message, a million a's).
TEST(content_hash, gives_the_digests_published_with_the_standard) {
    EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(hash_of(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// Oracle: definition; the digest is of the bytes, however they are portioned.
TEST(content_hash, does_not_depend_on_portions) {
    std::string text;
    for (int i = 0; i < 500; ++i) text += static_cast<char>(i * 7);
    for (const std::size_t portion : {1u, 3u, 55u, 63u, 64u, 65u, 130u}) {
        ContentHash hash;
        for (std::size_t at = 0; at < text.size(); at += portion) hash.add(std::string_view(text).substr(at, portion));
        EXPECT_EQ(hash.hex(), hash_of(text)) << portion;
    }
}

TEST(content_hash, of_a_file_is_that_of_its_bytes) {
    const TemporaryFolder folder;
    const std::string text(300000, 'x');
    write_file_atomically(folder.path() / "x", text);
    EXPECT_EQ(hash_of_file(folder.path() / "x"), hash_of(text));
    EXPECT_THROW(hash_of_file(folder.path() / "none"), EnvironmentError);
    EXPECT_THROW(hash_of_file(folder.path()), EnvironmentError);
}

}  // namespace test_content_hash
}  // namespace dynlab
