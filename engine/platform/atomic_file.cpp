#include "platform/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <deque>

#include "platform/file_blocks.h"
#include "platform/files/replacement_file.h"
#include "platform/system_call.h"
#include "platform/written_files.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

void sync_content(const fs::path& file) {
    const FileDescriptor fd = open_to_read(file);
    if (retry_interrupted([&] { return ::fsync(fd.get()); }) != 0) fail_to_write(file, errno);
}

void refuse_unfinished(const fs::path& from) {
    std::error_code error;
    if (!fs::is_regular_file(from, error)) fail_to_read(from, error ? error.value() : EINVAL);
}

}  // namespace

void write_file_atomically(const fs::path& file, std::string_view content) {
    ReplacementFile replacement(file);
    replacement.append(content);
    replacement.commit();
}

void place_file_atomically(const fs::path& from, const fs::path& to) {
    refuse_unfinished(from);
    const fs::path target = destination_of(to);
    const auto present = present_status(target);
    if (!present || S_ISREG(present->st_mode)) {
        sync_content(from);
        note_replacement(target, from);
        if (::rename(from.c_str(), target.c_str()) == 0) return;
        if (errno != EXDEV) fail_to_write(to, errno);
    }
    replace_by_copy(from, target);
    std::error_code ignored;  // the destination is complete; a left-over source does no harm
    fs::remove(from, ignored);
}

void write_files_atomically(const std::vector<NewFile>& files, const fs::path& made_in) {
    constexpr std::size_t kOpenAtOnce = 64;
    for (std::size_t from = 0; from < files.size(); from += kOpenAtOnce) {
        std::deque<ReplacementFile> replacements;
        for (std::size_t i = from; i < std::min(files.size(), from + kOpenAtOnce); ++i) {
            replacements.emplace_back(files[i].file, made_in).append(files[i].content);
            replacements.back().begin_to_sync();
        }
        // The file system writes down what is new in all of them when it does so for the first.
        for (ReplacementFile& replacement : replacements) replacement.commit();
    }
}

std::string read_file(const fs::path& file) {
    std::string content;
    std::error_code ignored;
    const std::uintmax_t size = fs::file_size(file, ignored);
    if (!ignored) content.reserve(size);
    for_each_block(file, [&](std::string_view block) { content.append(block); });
    return content;
}

std::string read_text(const std::filesystem::path& file) {
    std::string text = read_file(file);
    text.erase(0, text.size() - without_byte_order_mark(text).size());
    return text;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace dynlab::inline platform
