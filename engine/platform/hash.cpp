#include "platform/hash.h"

#include <fmt/format.h>
#include <sodium/crypto_auth_hmacsha256.h>
#include <sodium/utils.h>
#include <xxhash.h>

#include <array>
#include <new>
#include <set>

#include "platform/file_blocks.h"

namespace dynlab::inline platform {
namespace {

Digest digest_from(const XXH128_hash_t& hash) {
    return {hash.high64, hash.low64};
}

XXH3_state_t* new_digest_state() {
    XXH3_state_t* state = XXH3_createState();
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state);
    return state;
}

void free_digest_state(XXH3_state_t* state) {
    XXH3_freeState(state);
}

}  // namespace

Sha256::Sha256() {
    crypto_hash_sha256_init(&state_);
}

Sha256& Sha256::add(std::string_view bytes) {
    crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    return *this;
}

Sha256& Sha256::add_file(const std::filesystem::path& file) {
    for_each_block(file, [this](std::string_view block) { add(block); });
    return *this;
}

std::string Sha256::hex() const {
    crypto_hash_sha256_state last = state_;
    std::array<unsigned char, crypto_hash_sha256_BYTES> bytes;
    crypto_hash_sha256_final(&last, bytes.data());
    std::array<char, 2 * bytes.size() + 1> digits;
    return sodium_bin2hex(digits.data(), digits.size(), bytes.data(), bytes.size());
}

std::string hmac_sha256(std::string_view key, std::initializer_list<std::string_view> parts) {
    const auto bytes = [](std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); };
    crypto_auth_hmacsha256_state state;
    crypto_auth_hmacsha256_init(&state, bytes(key), key.size());
    for (const std::string_view part : parts) crypto_auth_hmacsha256_update(&state, bytes(part), part.size());
    std::array<unsigned char, crypto_auth_hmacsha256_BYTES> code;
    crypto_auth_hmacsha256_final(&state, code.data());
    std::array<char, 2 * code.size() + 1> digits;
    return sodium_bin2hex(digits.data(), digits.size(), code.data(), code.size());
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
    return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string sha256_of(std::string_view bytes) {
    return Sha256().add(bytes).hex();
}
std::string sha256_of_file(const std::filesystem::path& file) {
    return Sha256().add_file(file).hex();
}

std::string Digest::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

DigestStream::DigestStream() : state_(new_digest_state(), free_digest_state) {}
DigestStream::~DigestStream() = default;

DigestStream& DigestStream::add(const void* bytes, std::size_t size) {
    XXH3_128bits_update(state_.get(), bytes, size);
    return *this;
}

DigestStream& DigestStream::add_part(std::string_view bytes) {
    const std::uint64_t size = bytes.size();
    return add(&size, sizeof size).add(bytes.data(), bytes.size());
}

DigestStream& DigestStream::add_file(const std::filesystem::path& file) {
    for_each_block(file, [this](std::string_view block) { add(block.data(), block.size()); });
    return *this;
}

Digest DigestStream::digest() const {
    return digest_from(XXH3_128bits_digest(state_.get()));
}

Digest digest_of(std::string_view bytes) {
    return digest_from(XXH3_128bits(bytes.data(), bytes.size()));
}
Digest digest_of_file(const std::filesystem::path& file) {
    return DigestStream().add_file(file).digest();
}

Digest digest_of_folder(const std::filesystem::path& folder) {
    std::set<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.insert(entry.path());
    DigestStream digest;
    for (const auto& file : files)
        digest.add_part(file.lexically_relative(folder).string()).add_part(digest_of_file(file).hex());
    return digest.digest();
}

}  // namespace dynlab::inline platform
