#include "course/unpack.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <cctype>
#include <chrono>
#include <fstream>
#include <memory>

#include "platform/confinement.h"

namespace dynlab {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using Archive = std::unique_ptr<archive, int (*)(archive*)>;

constexpr std::size_t kBlock = 64u << 10;
constexpr int kDeepest = 20;

/// The place of a name in the folder; nothing for names that are absolute, lead outside or are too deep.
std::optional<fs::path> safe_place(const char* name) {
    if (name == nullptr) return {};
    std::string text = name;
    for (char& c : text)
        if (c == '\\') c = '/';
    const fs::path path(text);
    constexpr std::size_t kLongestName = 255;  // of a file system
    const bool on_a_drive = text.size() > 1 && std::isalpha(static_cast<unsigned char>(text[0])) && text[1] == ':';
    if (path.empty() || path.is_absolute() || on_a_drive) return {};
    int depth = 0;
    for (const fs::path& part : path) {
        if (part == ".." || ++depth > kDeepest || part.native().size() > kLongestName) return {};
        for (const unsigned char c : part.string())
            if (c < 0x20 || c == 0x7F) return {};
    }
    return path;
}

class Unpacking {
  public:
    explicit Unpacking(const json& job)
        : to_(job.at("to").get<std::string>()),
          bytes_left_(job.at("bytes").get<std::uint64_t>()),
          files_left_(job.at("files").get<int>()),
          keep_times_(job.at("keep_times").get<bool>()),
          archive_(archive_read_new(), archive_read_free) {
        archive_read_support_filter_gzip(archive_.get());
        archive_read_support_filter_xz(archive_.get());
        archive_read_support_filter_bzip2(archive_.get());
        archive_read_support_format_zip(archive_.get());
        archive_read_support_format_tar(archive_.get());
        const std::string file = job.at("archive");
        if (archive_read_open_filename(archive_.get(), file.c_str(), kBlock) != ARCHIVE_OK) fail();
    }

    json unpack() {
        archive_entry* entry = nullptr;
        int status = ARCHIVE_OK;
        while ((status = archive_read_next_header(archive_.get(), &entry)) == ARCHIVE_OK || status == ARCHIVE_WARN)
            take(entry);
        if (status != ARCHIVE_EOF) fail();
        return {{"left_out", left_out_}};
    }

  private:
    [[noreturn]] void fail() const {
        const char* const reason = archive_error_string(archive_.get());
        throw std::runtime_error(fmt::format("the archive cannot be read: {}", reason ? reason : "it is damaged"));
    }

    void take(archive_entry* entry) {
        const char* const name =
            archive_entry_pathname_utf8(entry) ? archive_entry_pathname_utf8(entry) : archive_entry_pathname(entry);
        const auto place = safe_place(name);
        const auto type = archive_entry_filetype(entry);
        const bool ordinary = type == AE_IFREG || type == AE_IFDIR;
        if (--files_left_ < 0) throw std::runtime_error("the archive holds too many files");
        if (!place || !ordinary || archive_entry_hardlink(entry) != nullptr) {
            left_out_.push_back(name ? name : "a name that cannot be read");
            // What is passed over has to be unpacked as well.
            if (archive_entry_size_is_set(entry)) use(static_cast<std::uint64_t>(archive_entry_size(entry)));
            return;
        }
        if (type == AE_IFDIR) {
            fs::create_directories(to_ / *place);
            return;
        }
        fs::create_directories((to_ / *place).parent_path());
        write(to_ / *place);
        if (keep_times_ && archive_entry_mtime_is_set(entry)) {
            const auto time = std::chrono::system_clock::from_time_t(archive_entry_mtime(entry));
            fs::last_write_time(to_ / *place, std::chrono::file_clock::from_sys(time));
        }
    }

    void use(std::uint64_t bytes) {
        if (bytes > bytes_left_) throw std::runtime_error("the archive is too large once unpacked");
        bytes_left_ -= bytes;
    }

    void write(const fs::path& file) {
        std::ofstream out(file, std::ios::binary | std::ios::trunc);
        char block[kBlock];
        la_ssize_t count = 0;
        while ((count = archive_read_data(archive_.get(), block, sizeof block)) > 0) {
            use(static_cast<std::uint64_t>(count));
            out.write(block, count);
        }
        if (count < 0) fail();
        if (!out) throw std::runtime_error("the archive cannot be unpacked: " + file.filename().string());
    }

    fs::path to_;
    std::uint64_t bytes_left_;
    int files_left_;
    bool keep_times_;
    Archive archive_;
    std::vector<std::string> left_out_;
};

}  // namespace

json unpack_archive(const json& job) {
    ProcessLimits limits;
    limits.file_bytes = job.at("bytes");
    confine_process(limits);
    try {
        return Unpacking(job).unpack();
    } catch (const std::runtime_error& error) {
        return {{"error", error.what()}};
    }
}

}  // namespace dynlab
