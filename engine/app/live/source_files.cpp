#include "app/live/source_files.h"

#include <unistd.h>

#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/files/temporary_file.h"
#include "platform/hash.h"

namespace dynlab::inline app {

namespace fs = std::filesystem;

SourceFiles::SourceFiles(const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        std::error_code failure;
        const fs::path place = fs::canonical(file, failure);  // a link is followed, not replaced
        const bool writable =
            !failure && ::access(place.c_str(), W_OK) == 0 && ::access(place.parent_path().c_str(), W_OK) == 0;
        if (!writable || std::find(files_.begin(), files_.end(), place) != files_.end()) continue;
        files_.push_back(place);
        remove_leftover_files(place.parent_path());
    }
}

std::optional<SourceText> SourceFiles::read(std::size_t number) const {
    if (number >= files_.size())
        throw EnvironmentError("the document has no file with the number {}; reload the page", number);
    try {
        SourceText source{number, files_[number].filename(), read_file(files_[number]), {}, files_[number]};
        if (in_utf8(source.text) != source.text) return {};
        source.digest = digest_of(source.text).hex();
        return source;
    } catch (const EnvironmentError&) {  // gone for now
        return {};
    }
}

std::vector<SourceText> SourceFiles::read() const {
    const std::lock_guard lock(mutex_);
    std::vector<SourceText> sources;
    for (std::size_t i = 0; i < files_.size(); ++i)
        if (auto source = read(i)) sources.push_back(*std::move(source));
    return sources;
}

std::map<std::string, std::string> SourceFiles::digests() const {
    std::map<std::string, std::string> digests;
    for (const SourceText& source : read()) digests[std::to_string(source.number)] = source.digest;
    return digests;
}

SourceFiles::Outcome SourceFiles::save(const SourceText& saved) {
    const std::lock_guard lock(mutex_);
    std::optional<SourceText> there = read(saved.number);
    if (there && there->digest != saved.digest) return {false, *std::move(there)};
    const fs::path& file = files_[saved.number];
    if (!there && fs::exists(file))
        throw EnvironmentError(
            "{} was not saved, because another program replaced its text with text that is not UTF-8. Convert the file "
            "to UTF-8",
            file.string());
    if (in_utf8(saved.text) != saved.text)
        throw EnvironmentError("{} was not saved: the text is not UTF-8", file.string());
    write_file_atomically(file, saved.text);
    return {true, {saved.number, file.filename(), {}, digest_of(saved.text).hex()}};
}

}  // namespace dynlab::inline app
