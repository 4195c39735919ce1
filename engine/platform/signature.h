#pragma once
#include <array>
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// Ed25519 (RFC 8032): who has the secret signs, everybody with the public key can verify. Keys and signatures are
/// lower-case hexadecimal digits.
class SigningKey {
  public:
    /// The key pair of a seed of 32 bytes (section 5.1.5). Throws std::invalid_argument for another size.
    static SigningKey of_seed(std::string_view seed);
    /// The key pair that belongs to a secret text and a purpose. A key reveals nothing about the keys of other
    /// purposes.
    static SigningKey derived(std::string_view secret, std::string_view purpose);

    const std::string& public_key() const { return public_key_; }  ///< 64 digits
    std::string sign(std::string_view message) const;              ///< 128 digits

  private:
    SigningKey() = default;
    std::array<unsigned char, 64> secret_{};
    std::string public_key_;
};

/// Whether the key's owner signed exactly this message. False for digits that are no signature or no key.
bool is_signature(std::string_view signature, std::string_view message, std::string_view public_key);

}  // namespace dynlab::inline platform
