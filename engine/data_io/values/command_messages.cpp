#include "data_io/values/command_messages.h"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "data_io/values/cbor_values.h"
#include "platform/atomic_file.h"

namespace dynlab::inline data_io {

namespace fs = std::filesystem;

Message CommandMessages::all() const {
    MessageList lines{results, Join::kLines};
    for (const std::vector<Message>* more : {&complaints, &notes})
        lines.items.insert(lines.items.end(), more->begin(), more->end());
    return Message("{}", lines);
}

void write_command_messages(const fs::path& file, const CommandMessages& said) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << cbor_of(said);
}

CommandMessages read_command_messages(const fs::path& file) {
    constexpr std::uintmax_t kMaxByteCount = 1u << 20;
    std::error_code error;
    if (fs::symlink_status(file, error).type() != fs::file_type::regular) return {};
    if (fs::file_size(file, error) > kMaxByteCount || error) return {};
    ValueLimits limits;
    limits.bytes = kMaxByteCount;
    limits.memory = 40 * kMaxByteCount;
    limits.depth = 30;
    limits.only_utf8 = true;
    try {
        return from_cbor<CommandMessages>(read_file(file), limits);
    } catch (const EnvironmentError&) {  // its writer was ended, or it is another file
        return {};
    }
}

}  // namespace dynlab::inline data_io
