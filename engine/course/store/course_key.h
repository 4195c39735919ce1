#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline course {

/// The file beside a course's store that its students get: with it they verify receipts.
inline constexpr char kPublicKeyFile[] = "course.pub";

/// The public key as a file: the course's name, and the key behind "ed25519: ".
std::string public_key_text(const std::string& course, const std::string& public_key);

/// A course's name and public key, as a key file contains them.
struct PublicKey {
    std::string course, digits;
};

/// Throws EnvironmentError for a file that cannot be read or holds no key.
PublicKey read_public_key(const std::filesystem::path& file);

}  // namespace dynlab::inline course
