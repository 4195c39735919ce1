#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// SHA-256 (FIPS 180-4), as 64 lower-case hexadecimal digits.
class ContentHash {
  public:
    ContentHash();
    ContentHash& add(std::string_view bytes);
    ContentHash& add_file(const std::filesystem::path& file);  ///< throws EnvironmentError
    std::string hex() const;

  private:
    std::uint32_t state_[8];
    unsigned char buffer_[64];
    std::uint64_t length_ = 0;
};

std::string hash_of(std::string_view bytes);
std::string hash_of_file(const std::filesystem::path& file);

}  // namespace dynlab::inline platform
