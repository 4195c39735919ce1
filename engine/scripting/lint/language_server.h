#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dynlab::inline scripting {

/// What an editor asks of `dynlab lsp` by the Language Server Protocol (3.17): mistakes as lint_script() finds them
/// while the text changes, completion by names, and the summary of a function under the cursor. Nothing is run or read
/// from disk.
class LanguageServer {
  public:
    /// The messages that answer one of the editor's: a response, notifications, both or nothing. Requests of another
    /// kind are answered with the protocol's error; what is no message at all with its parse error.
    std::vector<nlohmann::json> answers_to(const std::string& message);

    bool ended() const { return ended_; }           ///< the editor said `exit`
    bool ended_well() const { return shut_down_; }  ///< after `shutdown`, as it should

  private:
    nlohmann::json result_of(const std::string& method, const nlohmann::json& parameters);
    nlohmann::json diagnostics_of(const std::string& uri) const;
    std::string word_at(const nlohmann::json& parameters) const;

    std::map<std::string, std::string> texts_;  ///< by the editor's name of the file
    bool shut_down_ = false, ended_ = false;
};

}  // namespace dynlab::inline scripting
