#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dynlab::inline platform {

/// A secret that the processes of one piece of work share, on whatever machines they run. What is sealed with it is
/// noise to everybody else, who can neither read it nor make another such (XChaCha20-Poly1305, libsodium).
class SessionKey {
  public:
    static SessionKey fresh();
    /// As save() wrote it. Throws EnvironmentError where there is none, where it belongs to somebody else, or where
    /// others may read it.
    static SessionKey in_file(const std::filesystem::path& file);
    /// Readable by its owner only, from the first byte on.
    void save(const std::filesystem::path& file) const;

    /// `place` says what the bytes are ("result 4f.."): sealed for one place, they do not open at another.
    std::string seal(std::string_view bytes, std::string_view place) const;
    std::optional<std::string> open(std::string_view sealed, std::string_view place) const;  ///< nothing for others'
    /// Equal for equal bytes, 32 hexadecimal digits that tell nothing of them without the key (BLAKE2b).
    std::string name_of(std::string_view bytes) const;

  private:
    explicit SessionKey(std::string bytes) : bytes_(std::move(bytes)) {}
    std::string bytes_;
};

}  // namespace dynlab::inline platform
