#include "platform/signature.h"

#include <sodium.h>

#include <stdexcept>

#include "platform/keys/secure_random.h"

namespace dynlab::inline platform {
namespace {

const unsigned char* bytes_of(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}

std::string hex_of(const unsigned char* bytes, std::size_t size) {
    std::string digits(2 * size + 1, '\0');
    sodium_bin2hex(digits.data(), digits.size(), bytes, size);
    digits.pop_back();
    return digits;
}

/// False unless the text is exactly kSize bytes in lower-case hexadecimal digits: one signature has one text.
template <std::size_t kSize>
bool read_hex(std::string_view digits, std::array<unsigned char, kSize>& bytes) {
    std::size_t size = 0;
    return digits.size() == 2 * kSize &&
           sodium_hex2bin(bytes.data(), kSize, digits.data(), digits.size(), nullptr, &size, nullptr) == 0 &&
           size == kSize && hex_of(bytes.data(), kSize) == digits;
}

}  // namespace

SigningKey SigningKey::of_seed(std::string_view seed) {
    prepare_sodium();
    if (seed.size() != crypto_sign_SEEDBYTES) throw std::invalid_argument("the seed of a signing key has 32 bytes");
    SigningKey key;
    static_assert(std::tuple_size_v<decltype(key.secret_)> == crypto_sign_SECRETKEYBYTES);
    std::array<unsigned char, crypto_sign_PUBLICKEYBYTES> public_key;
    crypto_sign_seed_keypair(public_key.data(), key.secret_.data(), bytes_of(seed));
    key.public_key_ = hex_of(public_key.data(), public_key.size());
    return key;
}

SigningKey SigningKey::derived(std::string_view secret, std::string_view purpose) {
    prepare_sodium();
    std::string seed(crypto_sign_SEEDBYTES, '\0');
    const std::string message = std::to_string(purpose.size()) + ":" + std::string(purpose) + std::string(secret);
    crypto_generichash(reinterpret_cast<unsigned char*>(seed.data()), seed.size(), bytes_of(message), message.size(),
                       nullptr, 0);
    return of_seed(seed);
}

std::string SigningKey::sign(std::string_view message) const {
    std::array<unsigned char, crypto_sign_BYTES> signature;
    crypto_sign_detached(signature.data(), nullptr, bytes_of(message), message.size(), secret_.data());
    return hex_of(signature.data(), signature.size());
}

bool is_signature(std::string_view signature, std::string_view message, std::string_view public_key) {
    prepare_sodium();
    std::array<unsigned char, crypto_sign_BYTES> signature_bytes;
    std::array<unsigned char, crypto_sign_PUBLICKEYBYTES> key_bytes;
    return read_hex(signature, signature_bytes) && read_hex(public_key, key_bytes) &&
           crypto_sign_verify_detached(signature_bytes.data(), bytes_of(message), message.size(), key_bytes.data()) ==
               0;
}

}  // namespace dynlab::inline platform
