#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

namespace dynlab::inline app {

/// HMAC-SHA256 (RFC 2104) of the parts, one after the other, as 64 lower-case hexadecimal digits: shows those who share
/// the key that a message is of one of them.
std::string hmac_sha256_of(std::string_view key, std::initializer_list<std::string_view> parts);

}  // namespace dynlab::inline app
