#include "course/grading/content_hash.h"

#include <fmt/format.h>

#include <algorithm>

#include "platform/hash.h"

namespace dynlab::inline course {

std::string hash_of_content(const Submission& submission) {
    namespace fs = std::filesystem;
    const SubmissionLimits limits;
    const auto too_large = [](std::uintmax_t bytes) { return fmt::format("too large: {}", bytes); };
    if (!submission.loose.empty()) {
        Sha256 hash;
        for (const LooseFile& file : submission.loose) {
            const std::uintmax_t bytes = fs::file_size(file.path);
            if (bytes > limits.bytes) return too_large(bytes);
            hash.add(fmt::format("{}:{}:{}:", file.name.size(), file.name, bytes)).add_file(file.path);
        }
        return hash.hex();
    }
    if (submission.archive) {
        const std::uintmax_t bytes = fs::file_size(submission.path);
        return bytes > limits.bytes ? too_large(bytes) : sha256_of_file(submission.path);
    }
    Sha256 hash;
    std::vector<fs::path> files;
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(submission.path))
        if (entry.symlink_status().type() == fs::file_type::regular) {
            files.push_back(entry.path());
            bytes += entry.file_size();
        }
    if (bytes > limits.bytes) return too_large(bytes);
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        const std::string name = file.lexically_relative(submission.path).string();
        hash.add(fmt::format("{}:{}:{}:", name.size(), name, fs::file_size(file))).add_file(file);
    }
    return hash.hex();
}

}  // namespace dynlab::inline course
