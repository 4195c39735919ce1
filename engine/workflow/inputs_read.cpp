#include "workflow/inputs_read.h"

#include <algorithm>
#include <set>

#include "platform/hash.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

std::string state_of_folder(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const fs::path& file = entry.path();
        if (file.extension() == ".mat" || file.extension() == ".csv") names.insert(file.filename().string());
    }
    DigestStream digest;
    for (const std::string& name : names) digest.add_part(name);
    return digest.digest().hex();
}

std::string state_of(const fs::path& path) {
    if (fs::is_directory(path)) return state_of_folder(path);
    return fs::is_regular_file(path) ? digest_of_file(path).hex() : std::string();
}

}  // namespace

InputsRead inputs_read(const std::vector<fs::path>& files, const fs::path& script_folder) {
    InputsRead inputs;
    const auto add = [&inputs](const fs::path& path) { inputs[fs::absolute(path).string()] = state_of(path); };
    add(script_folder.empty() ? "." : script_folder);
    for (const fs::path& file : files) {
        add(file);
        add(fs::absolute(file).parent_path());
    }
    return inputs;
}

bool unchanged(const InputsRead& inputs) {
    return std::ranges::all_of(inputs, [](const auto& input) { return state_of(input.first) == input.second; });
}

}  // namespace dynlab::inline workflow
