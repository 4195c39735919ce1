#include "documents/work_file.h"

#include <fstream>
#include <sstream>

#include "platform/error.h"
#include "platform/system_call.h"

namespace dynlab::inline documents {

void write_work_file(const std::filesystem::path& file, std::string_view content) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) throw EnvironmentError("cannot write the working file {}: {}", file.string(), system_reason(errno));
}

std::string read_work_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    if (stream) content << stream.rdbuf();
    return content.str();
}

}  // namespace dynlab::inline documents
