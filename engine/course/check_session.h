#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dynlab {

/// A check as its file declares it.
struct DeclaredCheck {
    std::string id, about, hint;
    double points = 1;
    std::string rerun;      ///< a data set's name, "seed", or empty
    bool document = false;  ///< it asks for findings of the document
    int test = 0;           ///< place of the function in Lua's registry
    int mistakes = 0;       ///< place of the list of typical mistakes, 0 for none
    bool visible = true;    ///< students may read the file it stands in
};

/// What a check says of a submission.
struct Verdict {
    double share = 0;     ///< of the points, 0 to 1
    std::string message;  ///< one or two sentences for the student; may be empty
};

/// What the functions of checks.lua share while a submission is checked.
struct CheckSession {
    std::vector<DeclaredCheck> checks;
    nlohmann::json runs = nlohmann::json::object();     ///< run_for_grading's results: "main", and one for each rerun
    nlohmann::json findings = nlohmann::json::array();  ///< of `dynlab check --json`
    std::map<std::string, std::uint32_t>
        specimens;                        ///< of the hidden records by data set, the same of reruns, "rerun:NAME"
    std::filesystem::path hidden_folder;  ///< holds NAME.mat
    bool visible_file = true;             ///< of the file that is being read
    const DeclaredCheck* current = nullptr;
    bool took_hidden = false;  ///< the current check asked for a hidden record or what theory says of one
    std::optional<Verdict> verdict;
};

}  // namespace dynlab
