#include "workflow/report_cache.h"

#include <vector>

#include "data_io/values/cbor_values.h"
#include "documents/template_file.h"
#include "platform/hash.h"
#include "platform/program_lookup.h"
#include "workflow/inputs_read.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// The hash of the output, and what the run read.
using ReportFacts = std::pair<std::string, InputsRead>;

std::string digest_or_nothing(const fs::path& file) {
    return fs::is_regular_file(file) ? digest_of_file(file).hex() : std::string();
}

/// What the script's and the template's headers name; that of the template may be any file beside it.
std::vector<fs::path> bibliographies(const ReportRequest& request) {
    std::vector<fs::path> files = {bibliography_of(request.script)};
    const auto metadata = read_template(request.template_file).metadata;
    if (const auto own = metadata.find("bibliography"); own != metadata.end())
        files.push_back(request.template_file.parent_path() / own->second);
    return files;
}

}  // namespace

std::string digest_of_origins(const ReportRequest& request) {
    EntryName name("origins");
    name.add(fs::absolute(request.script.file).lexically_normal().string());
    name.add(request.script.source);
    name.add(fs::absolute(request.template_file).lexically_normal().string());
    name.add(digest_of_file(request.template_file).hex());
    for (const auto& [key, value] : request.metadata) name.add(key).add(value);
    for (const fs::path& file : bibliographies(request)) name.add(digest_or_nothing(file));
    name.add(request.last_section.text);
    name.add(std::to_string(static_cast<int>(request.shows)));
    name.add(std::to_string(request.seed));
    name.add(cbor_of(request.slider_values));
    name.add(digest_of_folder(shared_folder() / "report_templates").hex());
    return name.text();
}

ReportCache::ReportCache(const ReportRequest& request, const Cache& cache)
    : cache_(cache),
      output_(fs::absolute(request.output)),
      script_folder_(fs::absolute(request.script.file).parent_path()),
      entry_(cache.lasting() ? EntryName("reports").add(digest_of_origins(request)).add(output_.string()).text()
                             : std::string()) {}

bool ReportCache::unchanged() const {
    const auto known = entry_.empty() ? std::nullopt : cache_.load_entry(entry_);
    if (!known) return false;
    try {
        const auto [output, inputs] = from_cbor<ReportFacts>(*known, ValueLimits::own());
        return output == digest_or_nothing(output_) && dynlab::unchanged(inputs);
    } catch (const ValueError&) {  // corrupt: the report is then made
        return false;
    }
}

void ReportCache::save_entry(const RunRecord& record) const {
    if (entry_.empty()) return;
    cache_.save_entry(entry_,
                      cbor_of(ReportFacts{digest_or_nothing(output_), inputs_read(record.files_read, script_folder_)}));
}

}  // namespace dynlab::inline workflow
