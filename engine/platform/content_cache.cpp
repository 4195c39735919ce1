#include "platform/content_cache.h"

#include <algorithm>
#include <exception>
#include <fstream>

#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_identity.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

constexpr char kContent[] = "content";  // of an entry: the hash of the bytes, then the bytes
constexpr std::size_t kHashDigits = 64;

/// Without waiting for the disk: what a power failure leaves of it does not match its hash.
void write_unsynced(const fs::path& file, std::string_view hash, std::string_view bytes) {
    std::ofstream out(file, std::ios::binary);
    out << hash << bytes;
    out.close();
    if (!out) throw EnvironmentError("cannot write " + file.string());
}

}  // namespace

ContentCache::ContentCache(const std::string& name, std::uint64_t limit_bytes)
    : cache_(name, limit_bytes), program_(program_identity()) {}

std::string ContentCache::key(std::initializer_list<std::string_view> parts) const {
    Sha256 hash;
    const auto add = [&hash](std::string_view part) { hash.add(std::to_string(part.size()) + ":").add(part); };
    add(program_);
    for (const std::string_view part : parts) add(part);
    return hash.hex();
}

std::optional<std::string> ContentCache::recall(const std::string& key) {
    try {
        const auto folder = cache_.find(key);
        if (!folder) return {};
        const std::string content = fs::exists(*folder / kContent) ? read_file(*folder / kContent) : std::string();
        const std::string_view bytes = std::string_view(content).substr(std::min(kHashDigits, content.size()));
        if (content.substr(0, kHashDigits) == sha256_of(bytes)) {
            ++recalled_;
            return std::string(bytes);
        }
        cache_.forget(key);
    } catch (const std::exception&) {  // deleted meanwhile, or not to be read: then it is made anew
    }
    return {};
}

void ContentCache::remember(const std::string& key, std::string_view bytes) {
    ++remembered_;
    try {
        keep(key, bytes);
    } catch (const std::exception&) {  // a full disk, say: the next run does without
    }
}

void ContentCache::keep(const std::string& key, std::string_view bytes) const {
    const fs::path folder = cache_.prepare();
    try {
        write_unsynced(folder / kContent, sha256_of(bytes), bytes);
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(folder, ignored);
        throw;
    }
    cache_.commit(folder, key);
}

}  // namespace dynlab::inline platform
