#include "platform/files/atomic_files.h"

#include <algorithm>
#include <deque>

#include "platform/files/replacement_file.h"

namespace dynlab::inline platform {

void write_files_atomically(const std::vector<NewFile>& files) {
    constexpr std::size_t kOpenAtOnce = 64;
    for (std::size_t from = 0; from < files.size(); from += kOpenAtOnce) {
        std::deque<ReplacementFile> replacements;
        for (std::size_t i = from; i < std::min(files.size(), from + kOpenAtOnce); ++i) {
            replacements.emplace_back(files[i].file).append(files[i].content);
            replacements.back().begin_to_sync();
        }
        // The file system writes down what is new in all of them when it does so for the first.
        for (ReplacementFile& replacement : replacements) replacement.commit();
    }
}

}  // namespace dynlab::inline platform
