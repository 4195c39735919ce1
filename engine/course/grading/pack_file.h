#pragma once
#include <map>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// The files of a folder that are submitted, in one zip.
struct PackFile {
    std::vector<std::string> files;  ///< in it, MANIFEST.json aside
    std::string bytes;
};

/// The pack of these files, path in the folder -> content: without earlier packs and what dynlab run saved, with
/// MANIFEST.json, the SHA-256 of each. A page in a browser makes its packs by it, too.
PackFile pack_of(std::map<std::string, std::string> contents);

}  // namespace dynlab::inline course
