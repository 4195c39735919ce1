#pragma once
#include <string>
#include <string_view>

namespace dynlab::inline platform {

std::string base64(std::string_view bytes);  ///< RFC 4648, with its padding

}  // namespace dynlab::inline platform
