#include "workflow/report_cache.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "platform/hash.h"
#include "platform/program_identity.h"
#include "platform/program_lookup.h"
#include "workflow/inputs_read.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> template_files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(shared_folder() / "report_templates")) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string hash_or_nothing(const fs::path& file) {
    return fs::is_regular_file(file) ? sha256_of_file(file) : std::string();
}

}  // namespace

ReportCache::ReportCache(const ReportRequest& request)
    : cache_("reports", 4u << 20),
      output_(fs::absolute(request.output)),
      script_folder_(fs::absolute(request.script.file).parent_path()) {
    Sha256 hash;
    const auto add = [&hash](const std::string& text) { hash.add(std::to_string(text.size()) + ":").add(text); };
    add(program_identity());
    add(fs::absolute(request.script.file).string());
    add(request.script.source);
    add(fs::absolute(request.template_file).string());
    add(sha256_of_file(request.template_file));
    for (const auto& [name, value] : request.metadata) {
        add(name);
        add(value);
    }
    add(std::to_string(request.seed));
    add(output_.string());
    for (const fs::path& file : template_files()) add(sha256_of_file(file));
    key_ = hash.hex();
}

bool ReportCache::unchanged() const {
    const auto remembered = cache_.recall(key_);
    if (!remembered) return false;
    const auto facts = nlohmann::json::parse(*remembered, nullptr, false);
    if (!facts.is_object() || facts.value("output", "") != hash_or_nothing(output_)) return false;
    return dynlab::unchanged(facts.value("inputs", InputsRead()));
}

void ReportCache::remember(const RunRecord& record) const {
    const nlohmann::json facts = {{"output", hash_or_nothing(output_)},
                                  {"inputs", inputs_read(record, script_folder_)}};
    cache_.store(key_, facts.dump());
}

}  // namespace dynlab::inline workflow
