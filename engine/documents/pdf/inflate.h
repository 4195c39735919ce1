#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline documents {

/// What compressed bytes hold.
struct Inflated {
    std::string bytes;
    bool whole = true;  ///< false: they are damaged or hold more than was asked for, and `bytes` is the beginning
};

/// Reads bytes in the format of zlib (RFC 1950), about `most` bytes of their content.
Inflated inflate(std::string_view compressed, std::size_t most);

}  // namespace dynlab::inline documents
