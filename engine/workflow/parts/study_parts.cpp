#include "workflow/parts/study_parts.h"

#include <algorithm>
#include <set>
#include <utility>

#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/program_identity.h"
#include "platform/temporary_folder.h"
#include "workflow/run_script.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFiles = 256, kMaxStudyFileBytes = 4096;

/// Pieces in one file: few enough that there are files for many parts. It depends on their number alone, so that
/// machines that split the work find each other's files.
std::size_t pieces_of_a_file(std::size_t pieces) {
    return std::clamp<std::size_t>((pieces + kFiles - 1) / kFiles, 1, kMaxStudyFileBytes);
}

}  // namespace

StudyParts::StudyParts(fs::path folder, const PercentScript& script, std::uint32_t seed, int count,
                       std::optional<WorkPart> part)
    : folder_(std::move(folder)), count_(count), part_(part) {
    DigestStream digest;
    digest.add_part(program_identity()).add_part(std::to_string(seed));
    for (const Cell& cell : script.cells) digest.add_part(cell.content);
    study_ = digest.digest().hex();
    fs::create_directories(folder_);
}

std::vector<std::string> StudyParts::all(const std::vector<fs::path>& files, std::size_t pieces, const Some& some) {
    DigestStream digest;
    digest.add_part(study_).add_part(std::to_string(++missing_.call)).add_part(std::to_string(pieces));
    for (const fs::path& file : files) digest.add_part(fs::exists(file) ? digest_of_file(file).hex() : "");
    const std::string call = digest.digest().hex();
    const std::size_t size = pieces_of_a_file(pieces);
    std::vector<fs::path> made;
    std::set<int> missing;  // a member only below: what `some` throws is the script's error, whatever else is missing
    for (std::size_t first = 0; first < pieces; first += size) {
        const fs::path file = folder_ / (call + "-" + std::to_string(first) + ".cbor");
        const std::size_t place = made.size();
        if (!fs::exists(file)) {
            if (part_ && part_->has(place))
                write_file_atomically(file, some(first, std::min(size, pieces - first)));
            else
                missing.insert(WorkPart{1, count_}.part_of(place));
        }
        made.push_back(file);
    }
    missing_.parts.merge(missing);
    if (!missing_.parts.empty())
        throw EnvironmentError("{}", plural(static_cast<std::int64_t>(missing_.parts.size()),
                                            "{} part of this call of montecarlo is missing",
                                            "{} parts of this call of montecarlo are missing"));
    std::vector<std::string> bytes;
    for (const fs::path& file : made) bytes.push_back(read_file(file));
    return bytes;
}

MissingParts run_study_part(const PercentScript& script, std::uint32_t seed, const fs::path& folder, int count,
                            std::optional<WorkPart> part) {
    StudyParts parts(folder, script, seed, count, part);
    RunRequest request;
    request.script = script;
    request.seed = seed;
    request.parts = &parts;
    const TemporaryFolder saved;  // of this run; those of the study are written where the parts are joined
    request.out_folder = saved.path();
    GnuplotRenderer renderer;
    const RunRecord record = run_script(request, renderer);
    if (record.error && parts.missing().parts.empty()) throw EnvironmentError("{}", record.error->text());
    return parts.missing();
}

}  // namespace dynlab::inline workflow
