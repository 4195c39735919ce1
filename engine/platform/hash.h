#pragma once
#include <sodium/crypto_hash_sha256.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace dynlab::inline platform {

/// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits: an identifier for files that other programs also compute
/// (sha256sum). No one can construct another file with the same hash.
class Sha256 {
  public:
    Sha256();
    Sha256& add(std::string_view bytes);
    Sha256& add_file(const std::filesystem::path& file);  ///< throws EnvironmentError
    std::string hex() const;

  private:
    crypto_hash_sha256_state state_;
};

std::string sha256_of(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& file);  ///< throws EnvironmentError

/// HMAC-SHA256 (RFC 2104) of the parts, one after the other, as 64 lower-case hexadecimal digits: shows those who share
/// the key that a message is of one of them.
std::string hmac_sha256(std::string_view key, std::initializer_list<std::string_view> parts);
/// Compares in constant time, so that an attacker cannot find a secret byte by byte.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// 128 bits that distinguish contents, as 32 lower-case hexadecimal digits.
struct Digest {
    std::uint64_t high = 0, low = 0;
    std::string hex() const;
    bool operator==(const Digest&) const = default;
};

/// XXH3 (128 bits), as fast as memory is read: for the keys of this program's own caches. Contents that differ by
/// accident have different digests; an attacker can construct two contents with the same digest.
class DigestStream {
  public:
    DigestStream();
    ~DigestStream();
    DigestStream(const DigestStream&) = delete;
    DigestStream& operator=(const DigestStream&) = delete;

    DigestStream& add(const void* bytes, std::size_t size);
    /// The number of bytes and then the bytes, so that the boundaries of the parts are unambiguous.
    DigestStream& add_part(std::string_view bytes);
    DigestStream& add_file(const std::filesystem::path& file);  ///< throws EnvironmentError
    Digest digest() const;

  private:
    std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> state_;
};

Digest digest_of(std::string_view bytes);
Digest digest_of_file(const std::filesystem::path& file);  ///< throws EnvironmentError
/// Names and contents of all files in it and below. Throws EnvironmentError and std::filesystem::filesystem_error.
Digest digest_of_folder(const std::filesystem::path& folder);

}  // namespace dynlab::inline platform
