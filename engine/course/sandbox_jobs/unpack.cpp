#include "course/sandbox_jobs/unpack.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "platform/confinement.h"
#include "platform/error.h"
#include "platform/system_call.h"
#include "platform/text/foreign_text.h"
#include "platform/utf8_locale.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

using Archive = std::unique_ptr<archive, int (*)(archive*)>;

constexpr std::size_t kReadBlock = 64u << 10;
constexpr int kMaxArchiveDepth = 20;

/// Why an entry of this name must not be in a folder, as a clause; nothing where it may.
std::optional<Message> objection_to(const fs::path& path) {
    constexpr std::size_t kMaxNameLength = 255;  // of a file system
    const std::string& text = path.native();
    const Message outside = Message("\"{}\" points outside the archive", text);
    const bool on_a_drive = text.size() > 1 && std::isalpha(static_cast<unsigned char>(text[0])) && text[1] == ':';
    if (path.is_absolute() || on_a_drive) return outside;
    int depth = 0;
    for (const fs::path& part : path) {
        if (part == "..") return outside;
        if (++depth > kMaxArchiveDepth)
            return Message("\"{}\" is nested deeper than {} folders", text, kMaxArchiveDepth);
        if (part.native().size() > kMaxNameLength)
            return Message("\"{}\" contains a name longer than {} bytes", text, kMaxNameLength);
        for (const unsigned char c : part.native())
            if (c < 0x20 || c == 0x7F) return Message("\"{}\" has a name with control characters", text);
    }
    return {};
}

class Unpacker {
  public:
    explicit Unpacker(const UnpackJob& job)
        : to_(job.to),
          max_bytes_(job.bytes),
          bytes_left_(job.bytes),
          max_files_(job.files),
          files_left_(job.files),
          keep_times_(job.keep_times),
          archive_(archive_read_new(), archive_read_free) {
        archive_read_support_filter_gzip(archive_.get());
        archive_read_support_filter_xz(archive_.get());
        archive_read_support_filter_bzip2(archive_.get());
        archive_read_support_format_zip(archive_.get());
        archive_read_support_format_tar(archive_.get());
        if (archive_read_open_filename(archive_.get(), job.archive.c_str(), kReadBlock) != ARCHIVE_OK) fail();
    }

    Unpacked unpack() {
        archive_entry* entry = nullptr;
        int status = ARCHIVE_OK;
        while ((status = archive_read_next_header(archive_.get(), &entry)) == ARCHIVE_OK || status == ARCHIVE_WARN)
            take(entry);
        if (status != ARCHIVE_EOF) fail();
        return {std::move(left_out_), {}};
    }

  private:
    [[noreturn]] void fail() const {
        const char* const reason = archive_error_string(archive_.get());
        if (reason != nullptr) throw EnvironmentError("reading the archive failed ({})", reason);
        throw EnvironmentError("the archive is damaged");
    }

    void take(archive_entry* entry) {
        if (--files_left_ < 0) throw EnvironmentError("the archive contains more than {} files", max_files_);
        const char* const name = archive_entry_pathname(entry);
        if (name == nullptr || *name == '\0')
            return leave_out(entry, Message("the name of a file in the archive cannot be read"));
        std::string text = utf8_of_name(name);
        std::replace(text.begin(), text.end(), '\\', '/');
        const fs::path path(text);
        const auto type = archive_entry_filetype(entry);
        const bool ordinary = (type == AE_IFREG || type == AE_IFDIR) && archive_entry_hardlink(entry) == nullptr;
        const std::optional<Message> objection =
            ordinary ? objection_to(path) : Message("\"{}\" is a link or not a regular file", text);
        if (objection) return leave_out(entry, *objection);
        if (type == AE_IFDIR) {
            fs::create_directories(to_ / path);
            return;
        }
        fs::create_directories((to_ / path).parent_path());
        write(to_ / path);
        if (keep_times_ && archive_entry_mtime_is_set(entry)) {
            const auto time = std::chrono::system_clock::from_time_t(archive_entry_mtime(entry));
            fs::last_write_time(to_ / path, std::chrono::file_clock::from_sys(time));
        }
    }

    /// What is passed over has to be unpacked as well.
    void leave_out(archive_entry* entry, const Message& clause) {
        left_out_.push_back(clause);
        if (archive_entry_size_is_set(entry)) use(static_cast<std::uint64_t>(archive_entry_size(entry)));
    }

    void use(std::uint64_t bytes) {
        if (bytes > bytes_left_) throw EnvironmentError("the archive exceeds {} MB when unpacked", max_bytes_ >> 20);
        bytes_left_ -= bytes;
    }

    void write(const fs::path& file) {
        std::ofstream out(file, std::ios::binary | std::ios::trunc);
        char block[kReadBlock];
        la_ssize_t count = 0;
        while ((count = archive_read_data(archive_.get(), block, sizeof block)) > 0) {
            use(static_cast<std::uint64_t>(count));
            out.write(block, count);
        }
        if (count < 0) fail();
        out.close();  // the last bytes may not find room either
        if (!out)
            throw EnvironmentError("the file \"{}\" cannot be written ({})", file.filename().string(),
                                   system_reason(errno));
    }

    fs::path to_;
    std::uint64_t max_bytes_, bytes_left_;
    int max_files_, files_left_;
    bool keep_times_;
    Utf8Locale names_;  // libarchive gives names in the character set of the locale
    Archive archive_;
    std::vector<Message> left_out_;
};

}  // namespace

Unpacked unpack_archive(const UnpackJob& job) {
    ProcessLimits limits;
    limits.file_bytes = job.bytes;
    confine_process(limits);
    try {
        return Unpacker(job).unpack();
    } catch (const std::runtime_error& error) {
        return {{}, message_of(error)};
    }
}

}  // namespace dynlab::inline course
