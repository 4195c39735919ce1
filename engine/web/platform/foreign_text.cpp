#include "platform/text/foreign_text.h"

#include <emscripten.h>

#include "platform/utf8.h"

// Other character sets by the browser's TextDecoder. Names in archives are read by the programs that get them.

EM_JS(char*, dynlab_windows_1252, (const char* bytes, int size),
      { return stringToNewUTF8(new TextDecoder("windows-1252").decode(HEAPU8.subarray(bytes, bytes + size))); });
EM_JS(char*, dynlab_composed, (const char* text), { return stringToNewUTF8(UTF8ToString(text).normalize("NFC")); });

namespace dynlab::inline platform {
namespace {

std::string taken(char* text) {
    std::string copy = text;
    std::free(text);
    return copy;
}

}  // namespace

std::string utf8_of_windows_1252(std::string_view bytes) {
    return taken(dynlab_windows_1252(bytes.data(), static_cast<int>(bytes.size())));
}

std::string composed(std::string_view utf8) {
    return taken(dynlab_composed(std::string(utf8).c_str()));
}

}  // namespace dynlab::inline platform
