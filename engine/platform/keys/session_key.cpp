#include "platform/keys/session_key.h"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include "platform/error.h"
#include "platform/files/plain_file.h"
#include "platform/keys/secure_random.h"
#include "platform/system_call.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSessionKeyBytes = crypto_aead_xchacha20poly1305_ietf_KEYBYTES;
constexpr std::size_t kNonceBytes = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
constexpr std::size_t kTagBytes = crypto_aead_xchacha20poly1305_ietf_ABYTES;

const unsigned char* octets(std::string_view text) {
    return reinterpret_cast<const unsigned char*>(text.data());
}
unsigned char* octets(std::string& text) {
    return reinterpret_cast<unsigned char*>(text.data());
}

/// A stranger's file would make us trust what the stranger sealed; one that others can read is no secret.
void refuse_key_of_others(const fs::path& file, const FileDescriptor& opened) {
    struct stat status {};
    if (::fstat(opened.get(), &status) != 0 || !S_ISREG(status.st_mode))
        throw EnvironmentError("{} is no file of a session's key", file.string());
    if (status.st_uid != ::geteuid())
        throw EnvironmentError("the key {} belongs to another user; it is not taken", file.string());
    if ((status.st_mode & 077) != 0)
        throw EnvironmentError("others may read the key {}: it is no secret any more; remove it and begin anew",
                               file.string());
}

}  // namespace

SessionKey SessionKey::fresh() {
    return SessionKey(secure_bytes(kSessionKeyBytes));
}

SessionKey SessionKey::in_file(const fs::path& file) {
    prepare_sodium();
    const FileDescriptor opened(
        retry_interrupted([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK); }));
    if (!opened)
        throw EnvironmentError(
            "the session's key {} cannot be read: {}; this machine must see the folder that it lies in, as the same "
            "user",
            file.string(), system_reason(errno));
    refuse_key_of_others(file, opened);
    std::string bytes(kSessionKeyBytes + 1, '\0');
    const ssize_t count = retry_interrupted([&] { return ::read(opened.get(), bytes.data(), bytes.size()); });
    if (count != static_cast<ssize_t>(kSessionKeyBytes))
        throw EnvironmentError("{} is no session's key", file.string());
    bytes.resize(kSessionKeyBytes);
    return SessionKey(std::move(bytes));
}

void SessionKey::save(const fs::path& file) const {
    write_plain_file(file, bytes_);
}

std::string SessionKey::seal(std::string_view bytes, std::string_view place) const {
    std::string sealed = secure_bytes(kNonceBytes);
    sealed.resize(kNonceBytes + bytes.size() + kTagBytes);
    unsigned long long size = 0;
    crypto_aead_xchacha20poly1305_ietf_encrypt(octets(sealed) + kNonceBytes, &size, octets(bytes), bytes.size(),
                                               octets(place), place.size(), nullptr, octets(sealed), octets(bytes_));
    return sealed;
}

std::optional<std::string> SessionKey::open(std::string_view sealed, std::string_view place) const {
    if (sealed.size() < kNonceBytes + kTagBytes) return {};
    std::string bytes(sealed.size() - kNonceBytes - kTagBytes, '\0');
    unsigned long long size = 0;
    const bool ours = crypto_aead_xchacha20poly1305_ietf_decrypt(
                          octets(bytes), &size, nullptr, octets(sealed) + kNonceBytes, sealed.size() - kNonceBytes,
                          octets(place), place.size(), octets(sealed), octets(bytes_)) == 0;
    return ours ? std::optional(std::move(bytes)) : std::nullopt;
}

std::string SessionKey::name_of(std::string_view bytes) const {
    constexpr std::size_t kNameBytes = 16;
    std::string hash(kNameBytes, '\0'), digits(2 * kNameBytes + 1, '\0');
    crypto_generichash(octets(hash), hash.size(), octets(bytes), bytes.size(), octets(bytes_), bytes_.size());
    sodium_bin2hex(digits.data(), digits.size(), octets(hash), hash.size());
    digits.pop_back();
    return digits;
}

}  // namespace dynlab::inline platform
