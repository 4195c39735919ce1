// The language server. Oracles: the Language Server Protocol 3.17 (names and codes by hand), lint_script's own places.
#include "scripting/lint/language_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dynlab::test {
namespace test_language_server {
using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kUri = "file:///a.lua";

json ask(LanguageServer& server, const json& message) {
    const std::vector<json> answers = server.answers_to(message.dump());
    EXPECT_EQ(answers.size(), 1u);
    return answers.empty() ? json() : answers.front();
}

json opened(LanguageServer& server, const std::string& text) {
    return ask(server, {{"jsonrpc", "2.0"},
                        {"method", "textDocument/didOpen"},
                        {"params", {{"textDocument", {{"uri", kUri}, {"text", text}}}}}});
}

json request(LanguageServer& server, const std::string& method, const json& parameters = json::object()) {
    return ask(server, {{"jsonrpc", "2.0"}, {"id", 7}, {"method", method}, {"params", parameters}});
}

TEST(language_server, marks_mistakes_in_units_of_utf_16) {
    LanguageServer server;
    const json reported = opened(server, "print(\"é😀\", zzz)\n");
    EXPECT_EQ(reported.at("method"), "textDocument/publishDiagnostics");
    EXPECT_EQ(reported.at("params").at("uri"), kUri);
    const json found = reported.at("params").at("diagnostics").at(0);
    // print(" are 7 units, é one, the face two, then quote, comma and blank.
    EXPECT_EQ(found.at("range").at("start"), json({{"line", 0}, {"character", 13}}));
    EXPECT_EQ(found.at("range").at("end"), json({{"line", 0}, {"character", 16}}));
    EXPECT_EQ(found.at("code"), "unknown-name");
    const json fixed =
        ask(server, {{"jsonrpc", "2.0"},
                     {"method", "textDocument/didChange"},
                     {"params", {{"textDocument", {{"uri", kUri}}}, {"contentChanges", {{{"text", "print(1)"}}}}}}});
    EXPECT_TRUE(fixed.at("params").at("diagnostics").empty());
}

TEST(language_server, answers_hover_completion_and_the_end) {
    LanguageServer server;
    EXPECT_EQ(request(server, "initialize").at("result").at("capabilities").at("textDocumentSync"), 1);
    opened(server, "local G = srivc(d)\n");
    const auto hover = [&](int character) {
        return request(server, "textDocument/hover",
                       {{"textDocument", {{"uri", kUri}}}, {"position", {{"line", 0}, {"character", character}}}})
            .at("result");
    };
    EXPECT_THAT(hover(12).at("contents").at("value").get<std::string>(), HasSubstr("srivc(data, {nb, nf, nk}"));
    EXPECT_TRUE(hover(7).is_null());
    EXPECT_TRUE(hover(5000).is_null());
    std::vector<std::string> names;
    const json offered = request(server, "textDocument/completion").at("result");
    for (const json& item : offered) names.push_back(item.at("label"));
    EXPECT_THAT(names, testing::IsSupersetOf({"srivc", "report.value", "math", "print"}));
    EXPECT_FALSE(server.ended_well());
    EXPECT_TRUE(request(server, "shutdown").at("result").is_null());
    EXPECT_TRUE(server.answers_to(R"({"jsonrpc": "2.0", "method": "exit"})").empty());
    EXPECT_TRUE(server.ended() && server.ended_well());
}

TEST(language_server, answers_what_it_does_not_understand_with_the_codes_of_the_protocol) {
    LanguageServer server;
    const auto code = [&](const std::string& message) {
        return server.answers_to(message).front().at("error").at("code");
    };
    EXPECT_EQ(code("{"), -32700);
    EXPECT_EQ(code("[1]"), -32600);
    EXPECT_EQ(code(R"({"id": 1, "method": "textDocument/rename"})"), -32601);
    EXPECT_EQ(code(R"({"id": 1, "method": "textDocument/hover", "params": {}})"), -32602);
    EXPECT_EQ(code(R"({"method": "textDocument/didOpen", "params": {"textDocument": 3}})"), -32602);
    EXPECT_TRUE(server.answers_to(R"({"method": "$/setTrace", "params": {}})").empty());
    EXPECT_TRUE(server.answers_to(R"({"id": 1, "result": null})").empty());
}

}  // namespace test_language_server
}  // namespace dynlab::test
