#include "platform/signature.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dynlab {
namespace test_signature {

std::string bytes_of(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes += static_cast<char>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16));
    return bytes;
}

struct Example {
    const char *seed, *public_key, *message, *signature;
};

// Oracle: RFC 8032, section 7.1, tests 1 to 3.
constexpr Example kExamples[] = {
    {"9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60",
     "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a", "",
     "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f0595bbe24"
     "655141438e7a100b"},
    {"4ccd089b28ff96da9db6c346ec114e0f5b8a319f35aba624da8cf6ed4fb8a6fb",
     "3d4017c3e843895a92b70aa74d1b7ebc9c982ccf2ec4968cc0cd55f12af4660c", "72",
     "92a009a9f0d4cab8720e820b5f642540a2b27b5416503f8fb3762223ebdb69da085ac1e43e15996e458f3613d0f11d8c387b2eaeb4302aee"
     "b00d291612bb0c00"},
    {"c5aa8df43f9f837bedb7442f31dcb7b166d38535076f094b85ce3a2e0b4458f7",
     "fc51cd8e6218a1a38da47ed00230f0580816ed13ba3303ac5deb911548908025", "af82",
     "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290ae67f760984dc6594a7c15e9716ed28d"
     "c027beceea1ec40a"}};

TEST(signature, signs_as_the_standard_says) {
    for (const auto& [seed, public_key, message, signature] : kExamples) {
        const SigningKey key = SigningKey::of_seed(bytes_of(seed));
        EXPECT_EQ(key.public_key(), public_key);
        EXPECT_EQ(key.sign(bytes_of(message)), signature);
        EXPECT_TRUE(is_signature(signature, bytes_of(message), public_key));
    }
    EXPECT_THROW(SigningKey::of_seed("short"), std::invalid_argument);
}

// Oracle: definition; any change is another message, another signature or another key.
TEST(signature, every_change_is_noticed) {
    const Example& e = kExamples[2];
    const std::string message = bytes_of(e.message), signature = e.signature, public_key = e.public_key;
    EXPECT_FALSE(is_signature(signature, message + "x", public_key));
    EXPECT_FALSE(is_signature(signature, message.substr(1), public_key));
    EXPECT_FALSE(is_signature(signature, message, kExamples[0].public_key));
    for (std::size_t i = 0; i < signature.size(); ++i) {
        std::string altered = signature;
        altered[i] = altered[i] == '0' ? '1' : '0';
        EXPECT_FALSE(is_signature(altered, message, public_key)) << i;
    }
    std::string upper = signature;
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    for (const std::string& no_signature :
         {upper, signature + "00", signature.substr(2), std::string(), "x" + signature})
        EXPECT_FALSE(is_signature(no_signature, message, public_key)) << no_signature;
    for (const std::string& no_key : {std::string(), public_key + "00", std::string(64, '0'), std::string(64, 'x')})
        EXPECT_FALSE(is_signature(signature, message, no_key)) << no_key;
}

// Oracle: definition; the same secret and purpose give the same key, any other another one.
TEST(signature, keys_are_derived_from_a_secret_for_a_purpose) {
    const SigningKey key = SigningKey::derived("secret", "receipts");
    EXPECT_EQ(SigningKey::derived("secret", "receipts").public_key(), key.public_key());
    EXPECT_NE(SigningKey::derived("secret2", "receipts").public_key(), key.public_key());
    EXPECT_NE(SigningKey::derived("secret", "other").public_key(), key.public_key());
    EXPECT_NE(SigningKey::derived("tssecret", "receip").public_key(), key.public_key());
    EXPECT_TRUE(is_signature(key.sign("a"), "a", key.public_key()));
}

}  // namespace test_signature
}  // namespace dynlab
