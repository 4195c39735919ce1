#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "platform/atomic_file.h"
#include "support/program.h"

namespace dynlab::test {
namespace test_site {

namespace fs = std::filesystem;

/// The files of a folder by their paths in it.
inline std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(folder).generic_string()] = read_file(entry.path());
    return files;
}

inline std::vector<std::string> attributes(const std::string& html, const std::string& name) {
    std::vector<std::string> values;
    const std::string sign = " " + name + "=\"";
    for (std::size_t at = 0; (at = html.find(sign, at)) != std::string::npos;) {
        at += sign.size();
        values.push_back(html.substr(at, html.find('"', at) - at));
    }
    return values;
}

/// The course site, generated once for all tests of the suite. Two placeholder files replace the engine, which needs
/// another compiler.
struct MadeSite {
    Workbench bench{Workbench::Memory::kShared};
    ChildResult made;
    fs::path folder = bench.path("site");
    std::map<std::string, std::string> files, pages;

    MadeSite() {
        bench.write("engine/dynlab.js", "// engine");
        bench.write("engine/dynlab.wasm", "engine");
        made = bench.dynlab({"site", "site", "--engine", "engine"});
        if (made.exit_code != 0) return;
        files = files_in(folder);
        for (const auto& [name, content] : files)
            if (name.ends_with(".html")) pages[name] = content;
    }
};

inline const MadeSite& made_site() {
    static const MadeSite site;
    return site;
}

}  // namespace test_site
}  // namespace dynlab::test
