#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"

namespace dynlab::inline course {

struct Unpacked {
    std::vector<Message> left_out;  ///< what did not come out and why: "\"../x\" leads outside of the archive"
    std::optional<Message> error;   ///< a sentence; then the archive is not unpacked whole
};

/// An archive (zip, tar, with or without compression) to be unpacked for grading.
struct UnpackJob {
    static constexpr char kWork[] = "unpack";
    using Result = Unpacked;

    std::filesystem::path archive, to;  ///< `to`: an empty folder
    std::uint64_t bytes = 0;            ///< at most
    int files = 0;                      ///< at most
    bool keep_times = false;            ///< files keep theirs
};

/// Unpacks the archive in this process, which must be in a sandbox and is confined here. Only files and folders are
/// unpacked, below `to` and without their permissions. Names are converted to UTF-8 (see platform/text/foreign_text.h).
Unpacked unpack_archive(const UnpackJob& job);

}  // namespace dynlab::inline course
