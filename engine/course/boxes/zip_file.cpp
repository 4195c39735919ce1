#include "course/boxes/zip_file.h"

#include <archive.h>
#include <archive_entry.h>
#include <memory>

#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr long kEntryTime = 315619200;  // 1 January 1980, the first that zip knows, with a day's margin for time zones

la_ssize_t append(archive*, void* text, const void* bytes, std::size_t count) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), count);
    return static_cast<la_ssize_t>(count);
}

}  // namespace

void write_zip(const std::filesystem::path& file, const std::map<std::string, std::string>& contents) {
    std::string bytes;
    const std::unique_ptr<archive, int (*)(archive*)> zip(archive_write_new(), archive_write_free);
    const auto check = [&](int status) {
        if (status < ARCHIVE_WARN)
            throw EnvironmentError("cannot write {}: {}", file.string(), archive_error_string(zip.get()));
    };
    check(archive_write_set_format_zip(zip.get()));
    // Without times in the extra fields, and in UTF-8.
    check(archive_write_set_options(zip.get(), "zip:compression=deflate,zip:hdrcharset=UTF-8"));
    check(archive_write_set_bytes_in_last_block(zip.get(), 1));
    check(archive_write_open(zip.get(), &bytes, nullptr, append, nullptr));
    for (const auto& [name, content] : contents) {
        const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(), archive_entry_free);
        archive_entry_set_pathname_utf8(entry.get(), name.c_str());
        archive_entry_set_size(entry.get(), static_cast<la_int64_t>(content.size()));
        archive_entry_set_filetype(entry.get(), AE_IFREG);
        archive_entry_set_perm(entry.get(), 0644);
        archive_entry_set_mtime(entry.get(), kEntryTime, 0);
        check(archive_write_header(zip.get(), entry.get()));
        if (archive_write_data(zip.get(), content.data(), content.size()) < 0) check(ARCHIVE_FATAL);
    }
    check(archive_write_close(zip.get()));
    write_file_atomically(file, bytes);
}

}  // namespace dynlab::inline course
