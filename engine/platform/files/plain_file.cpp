#include "platform/files/plain_file.h"

#include "platform/files/replacement_file.h"

namespace dynlab::inline platform {

void write_plain_file(const std::filesystem::path& file, std::string_view content) {
    ReplacementFile replacement = ReplacementFile::of_owner(file);
    replacement.append(content);
    replacement.commit();
}

}  // namespace dynlab::inline platform
