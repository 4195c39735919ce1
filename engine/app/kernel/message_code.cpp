#include "app/kernel/message_code.h"

#include <sodium/crypto_auth_hmacsha256.h>
#include <sodium/utils.h>

#include <array>

namespace dynlab::inline app {
namespace {

const unsigned char* as_bytes(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

}  // namespace

std::string hmac_sha256_of(std::string_view key, std::initializer_list<std::string_view> parts) {
    crypto_auth_hmacsha256_state state;
    crypto_auth_hmacsha256_init(&state, as_bytes(key), key.size());
    for (const std::string_view part : parts) crypto_auth_hmacsha256_update(&state, as_bytes(part), part.size());
    std::array<unsigned char, crypto_auth_hmacsha256_BYTES> bytes;
    crypto_auth_hmacsha256_final(&state, bytes.data());
    std::array<char, 2 * bytes.size() + 1> digits;
    return sodium_bin2hex(digits.data(), digits.size(), bytes.data(), bytes.size());
}

}  // namespace dynlab::inline app
