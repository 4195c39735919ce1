#include "platform/keys/secure_random.h"

#include <sodium.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace dynlab::inline platform {

void prepare_sodium() {
    static const bool ready = sodium_init() >= 0;
    if (!ready) throw std::runtime_error("libsodium cannot be used on this machine");
}

std::string secure_bytes(std::size_t count) {
    prepare_sodium();
    std::string bytes(count, '\0');
    randombytes_buf(bytes.data(), count);
    return bytes;
}

std::string secure_hex(std::size_t count) {
    const std::string bytes = secure_bytes(count);
    std::string digits(2 * count + 1, '\0');
    sodium_bin2hex(digits.data(), digits.size(), reinterpret_cast<const unsigned char*>(bytes.data()), count);
    digits.pop_back();
    return digits;
}

std::size_t secure_below(std::size_t below) {
    if (below == 0 || below > std::numeric_limits<std::uint32_t>::max())
        throw std::invalid_argument("a random number is drawn from 1 to 4294967295 possible ones");
    prepare_sodium();
    return randombytes_uniform(static_cast<std::uint32_t>(below));  // without the bias of a remainder
}

}  // namespace dynlab::inline platform
