#pragma once
#include <deque>
#include <nlohmann/json.hpp>
#include <string>

namespace dynlab::inline app {

/// The cells of a session as they were run, for history requests; the last thousand.
class InputHistory {
  public:
    static constexpr std::size_t kMax = 1000;

    void add(int count, const std::string& code, const std::string& result);
    /// What a history_request asks for by tail, range or search, as its reply lists it: [session, number, code], or
    /// [session, number, [code, result]] where outputs are wanted.
    nlohmann::json found(const nlohmann::json& request) const;

  private:
    struct Input {
        int count;
        std::string code, result;
    };
    std::deque<Input> inputs_;
};

}  // namespace dynlab::inline app
