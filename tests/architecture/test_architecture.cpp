// The project's rules that a machine can check. Oracle: engine/CMakeLists.txt (the layers and their links), the catalog
// of methods and the list of Lua functions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "numerics/estimators/method_catalog.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace test_architecture {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kRoot = DYNLAB_SOURCE_DIR;

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& extensions) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && extensions.contains(entry.path().extension())) files.push_back(entry.path());
    }
    return files;
}

std::vector<fs::path> sources_below(const fs::path& folder) {
    return files_below(folder, {".h", ".cpp"});
}

/// What a shell command prints.
std::string output_of(const std::string& command) {
    std::string text;
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return text;
    std::array<char, 65536> part;
    for (std::size_t length; (length = fread(part.data(), 1, part.size(), pipe)) > 0;) text.append(part.data(), length);
    pclose(pipe);
    return text;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) found.push_back((*it)[1]);
    return found;
}

std::string place_of(const fs::path& file) {
    return fs::relative(file, kRoot).string();
}

/// layer -> the layers it may include, itself among them, as engine/CMakeLists.txt links them.
std::map<std::string, std::set<std::string>> allowed_layers() {
    std::map<std::string, std::set<std::string>> allowed;
    const std::string cmake = text_of(kRoot / "engine/CMakeLists.txt");
    const std::regex line(R"(\ndynlab_layer\((\w+)\s*(?:USES\s+([a-z_ ]+?)\s*)?(?:(?:READS|WITH|PARTS)[^)]*)?\))");
    for (std::sregex_iterator it(cmake.begin(), cmake.end(), line), end; it != end; ++it) {
        const std::string layer = (*it)[1];
        std::set<std::string>& layers = allowed[layer];
        layers.insert(layer);
        std::istringstream uses((*it)[2]);
        for (std::string used; uses >> used;) {
            const std::set<std::string> inherited = allowed.at(used);  // throws when a layer uses a later one
            layers.insert(inherited.begin(), inherited.end());
        }
    }
    return allowed;
}

TEST(architecture, layers_include_only_layers_above_them) {
    const auto allowed = allowed_layers();
    ASSERT_GE(allowed.size(), 7u);
    std::vector<std::string> offences;
    for (const auto& [layer, layers] : allowed) {
        for (const fs::path& file : sources_below(kRoot / "engine" / layer)) {
            for (const std::string& included : matches(text_of(file), "#include \"([a-z_]+)/")) {
                if (!layers.contains(included)) offences.push_back(place_of(file) + " includes " + included);
            }
        }
    }
    EXPECT_THAT(offences, IsEmpty());
}

// The order of the rooms is the one in which engine/README.md names them.
TEST(architecture, modules_include_only_modules_of_their_layer_named_before_them) {
    const std::string readme = text_of(kRoot / "engine/README.md");
    std::vector<std::string> offences;
    std::set<std::string> all = {"cli"};  // a program, no layer
    for (const auto& [layer, layers] : allowed_layers()) all.insert(layer);
    for (const std::string& layer : all) {
        const std::vector<std::string> rows = matches(readme, "\n\\| `" + layer + "` \\| `([a-z_ ]+)`");
        std::map<std::string, std::size_t> places;
        std::istringstream names(rows.empty() ? "" : rows[0]);
        for (std::string name; names >> name;) places.emplace(name, places.size());
        for (const fs::path& file : sources_below(kRoot / "engine" / layer)) {
            const fs::path below = fs::relative(file, kRoot / "engine" / layer);
            if (!below.has_parent_path()) continue;
            const std::string module = below.begin()->string();
            if (!places.contains(module)) offences.push_back(layer + "/" + module + " is missing from the order");
            for (const std::string& included : matches(text_of(file), "#include \"" + layer + "/([a-z_]+)/"))
                if (!places.contains(included) || !places.contains(module) || places.at(included) > places.at(module))
                    offences.push_back(place_of(file) + " includes " + included);
        }
    }
    EXPECT_THAT(offences, IsEmpty());
}

// Oracle: the files themselves. A file is named by its path or by the end of it.
TEST(architecture, files_that_guides_and_comments_name_are_there) {
    std::set<std::string> ends;
    for (const char* folder : {"engine", "lessons", "tests", "report_templates", "scripts", ".github"}) {
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string place = place_of(entry.path());
            for (std::size_t at = 0; at < place.size(); at = std::min(place.find('/', at), place.size()) + 1)
                ends.insert(place.substr(at));
        }
    }
    std::vector<std::string> missing;
    const auto look = [&](const fs::path& file, const std::string& pattern) {
        for (const std::string& name : matches(text_of(file), pattern))
            if (!ends.contains(name)) missing.push_back(place_of(file) + " names " + name);
    };
    for (const char* guide : {"README.md", "engine/README.md", ".github/CONTRIBUTING.md", ".github/SECURITY.md"})
        look(kRoot / guide, "`([a-z_0-9./]+[.](?:h|cpp|js|cmake))`");
    for (const fs::path& file : sources_below(kRoot / "engine"))
        look(file, "//[^\n]*?[ (`]([a-z_0-9]+(?:/[a-z_0-9]+)*[.](?:h|cpp))\\b");
    EXPECT_THAT(missing, IsEmpty());
}

// Oracle: the sources of the tests. The last cell of a row of four names suites.
TEST(architecture, suites_that_the_threat_model_names_are_there) {
    std::set<std::string> suites;
    for (const fs::path& file : sources_below(kRoot / "tests"))
        for (const std::string& suite : matches(text_of(file), "\nTEST(?:_F|_P)?\\((\\w+),")) suites.insert(suite);
    std::vector<std::string> missing;
    int named = 0;
    for (const std::string& cell :
         matches(text_of(kRoot / ".github/SECURITY.md"), "\n[|][^|\n]+[|][^|\n]+[|][^|\n]+[|]([^|\n]+)[|]"))
        for (const std::string& suite : matches(cell, "`(\\w+)`"))
            if (++named; !suites.contains(suite)) missing.push_back(suite);
    EXPECT_GT(named, 30);
    EXPECT_THAT(missing, IsEmpty());
}

TEST(architecture, every_source_is_in_the_namespace_of_its_layer) {
    std::vector<std::string> offences;
    for (const auto& [layer, layers] : allowed_layers()) {
        for (const fs::path& file : sources_below(kRoot / "engine" / layer)) {
            const std::vector<std::string> names = matches(text_of(file), "\nnamespace dynlab(?:::inline )?([a-z_]*)");
            if (std::find(names.begin(), names.end(), layer) == names.end())
                offences.push_back(place_of(file) + " is not in dynlab::" + layer);
        }
    }
    EXPECT_THAT(offences, IsEmpty());
}

TEST(architecture, folders_are_modules_of_limited_size) {
    std::map<fs::path, int> files;
    for (const fs::path& file : sources_below(kRoot / "engine")) ++files[file.parent_path()];
    ASSERT_GE(files.size(), 20u);
    std::vector<std::string> crowded;
    for (const auto& [folder, count] : files)
        if (count > 45) crowded.push_back(place_of(folder) + " has " + std::to_string(count) + " files");
    EXPECT_THAT(crowded, IsEmpty());
}

TEST(architecture, numerics_is_pure) {
    const std::regex allowed("Eigen/.*|unsupported/Eigen/.*|boost/math/.*|tbb/.*|oneapi/tbb/.*|immintrin[.]h");
    const std::set<std::string> forbidden = {"iostream", "fstream", "filesystem", "cstdio", "stdio.h",
                                             "chrono",   "random",  "thread",     "ctime"};
    std::vector<std::string> offences;
    for (const fs::path& file : sources_below(kRoot / "engine/numerics")) {
        for (const std::string& included : matches(text_of(file), "#include <([^>]+)>")) {
            const bool from_library = included.find('/') != std::string::npos || included.ends_with(".h");
            if (forbidden.contains(included) || (from_library && !std::regex_match(included, allowed))) {
                offences.push_back(place_of(file) + " includes <" + included + ">");
            }
        }
    }
    EXPECT_THAT(offences, IsEmpty());
}

// A portable build compiles numerics for several levels of processors, and all else for the lowest: a header that looks
// different to each must not be read elsewhere.
TEST(architecture, headers_that_depend_on_the_processor_are_for_numerics_alone) {
    std::set<std::string> dependent;
    for (bool grows = true; grows;) {
        grows = false;
        for (const fs::path& file : files_below(kRoot / "engine/numerics", {".h"})) {
            const std::string text = text_of(file);
            bool depends = text.find("defined(__AVX") != std::string::npos;
            for (const std::string& included : matches(text, "#include \"([^\"]+)\""))
                depends = depends || dependent.contains(included);
            if (depends && dependent.insert(fs::relative(file, kRoot / "engine").string()).second) grows = true;
        }
    }
    ASSERT_GE(dependent.size(), 2u);
    std::vector<std::string> offences;
    for (const fs::path& file : sources_below(kRoot / "engine"))
        for (const std::string& included : matches(text_of(file), "#include \"([^\"]+)\""))
            if (dependent.contains(included) && file.string().find("/engine/numerics/") == std::string::npos)
                offences.push_back(place_of(file) + " includes " + included);
    EXPECT_THAT(offences, IsEmpty());
}

// The linker accepts either of two definitions of one function in one namespace without a message.
TEST(architecture, a_function_is_declared_in_one_header) {
    std::map<std::string, fs::path> headers;
    std::vector<std::string> offences;
    for (const fs::path& file : files_below(kRoot / "engine", {".h"})) {
        const std::string code = std::regex_replace(text_of(file), std::regex("//[^\n]*"), "");
        for (const std::string& declared : matches(code, R"(\n([A-Za-z][^;{}#()]*\([^;{}]*\)) *;)")) {
            const std::string in_one_line = std::regex_replace(declared, std::regex("\\s+"), " ");
            const std::string signature = std::regex_replace(in_one_line, std::regex(" = [^,()]*"), "");
            const auto [known, first] = headers.emplace(signature, file);
            if (!first) offences.push_back(signature + " in " + place_of(known->second) + " and " + place_of(file));
        }
    }
    EXPECT_GT(headers.size(), 500u);
    EXPECT_THAT(offences, IsEmpty());
}

// The linker accepts either of two definitions of one name without a message. The test compares types in the headers
// and strong symbols in the libraries. Templates and inline functions are in many objects on purpose.
TEST(architecture, a_type_has_its_name_for_itself) {
    std::map<std::string, fs::path> headers;
    std::vector<std::string> offences;
    for (const fs::path& file : files_below(kRoot / "engine", {".h"})) {
        for (const std::string& name :
             matches(text_of(file), R"(\n(?:struct|class|enum class) (\w+)(?: :[^;{]*| final)? \{)")) {
            const auto [known, first] = headers.emplace(name, file);
            if (!first) offences.push_back(name + " in " + place_of(known->second) + " and " + place_of(file));
        }
    }
    EXPECT_GT(headers.size(), 200u);
    EXPECT_THAT(offences, IsEmpty());
}

TEST(architecture, no_symbol_is_defined_twice) {
    std::istringstream listed(output_of("nm -A --defined-only " DYNLAB_LIBRARIES));
    std::map<std::string, std::string> objects;
    std::vector<std::string> offences;
    for (std::string line; std::getline(listed, line);) {  // "library.a:object.o:0000000000000040 T name"
        const std::size_t object = line.rfind(':'), kind = line.find(' ', object);
        if (object == line.npos || kind == line.npos || !std::strchr("TDBR", line[kind + 1])) continue;
        const std::string name = line.substr(kind + 3), place = line.substr(0, object);
        const auto [known, first] = objects.emplace(name, place);
        if (!first && known->second != place) offences.push_back(name + " in " + known->second + " and " + place);
    }
    EXPECT_GT(objects.size(), 1000u);
    EXPECT_THAT(offences, IsEmpty());
}

/// Function definitions of a source at the outermost level: "name" or "Class::name".
std::vector<std::string> functions_defined_in(const std::string& source) {
    const std::string code = std::regex_replace(source, std::regex("//[^\n]*"), "");
    return matches(code, R"(\n[A-Za-z][^;{}#()=\n]*?((?:\w+(?:<\w+>)?::)?\w+)\([^;{}]*\)(?: const)? \{)");
}

/// The functions that a header declares outside of its classes, and those that its classes declare, as Class::name.
std::set<std::string> functions_declared_in(const std::string& header) {
    const std::string code = std::regex_replace(header, std::regex("//[^\n]*"), "");
    std::set<std::string> names;
    for (const std::string& name :
         matches(code, R"(\n(?!using|typedef)[A-Za-z][^;{}#()=\n]*?(\w+)\([^;{}]*\)(?: const)?;)"))
        names.insert(name);
    const std::regex classes(R"((?:struct|class) (\w+(?:<\w+>)?)[^;{}()]*\{\n([^}]*)\n\};)");
    for (std::sregex_iterator it(code.begin(), code.end(), classes), end; it != end; ++it)
        for (const std::string& name :
             matches("\n" + std::string((*it)[2]), R"(\n    [A-Za-z][^;{}#()=\n]*?(\w+)\([^;{}]*\)(?: const)?;)"))
            names.insert(std::string((*it)[1]) + "::" + name);
    return names;
}

// What an early room declares and a later one defines would be an include upward that the linker hides.
TEST(architecture, declarations_of_a_module_are_not_defined_in_a_later_one) {
    const std::string readme = text_of(kRoot / "engine/README.md");
    std::vector<std::string> offences;
    std::size_t compared = 0;
    for (const auto& [layer, layers] : allowed_layers()) {
        const std::vector<std::string> rows = matches(readme, "\n\\| `" + layer + "` \\| `([a-z_ ]+)`");
        std::map<std::string, int> places;
        std::istringstream names(rows.empty() ? "" : rows[0]);
        for (std::string name; names >> name;) places.emplace(name, static_cast<int>(places.size()));
        const auto place = [&, layer = layer](const fs::path& file) {
            const auto found = places.find(fs::relative(file, kRoot / "engine" / layer).begin()->string());
            return found == places.end() ? -1 : found->second;
        };
        std::map<std::string, std::vector<fs::path>> definitions;
        for (const fs::path& file : files_below(kRoot / "engine" / layer, {".cpp"}))
            for (const std::string& name : functions_defined_in(text_of(file))) definitions[name].push_back(file);
        for (const fs::path& file : files_below(kRoot / "engine" / layer, {".h"})) {
            if (place(file) < 0) continue;
            for (const std::string& name : functions_declared_in(text_of(file))) {
                const std::vector<fs::path>& defined = definitions[name];
                compared += defined.empty() ? 0 : 1;
                if (!defined.empty() && std::all_of(defined.begin(), defined.end(), [&](const fs::path& source) {
                        return place(source) > place(file);
                    }))
                    offences.push_back(place_of(file) + " declares " + name + ", which " + place_of(defined.front()) +
                                       " defines");
            }
        }
    }
    EXPECT_GT(compared, 1000u);
    EXPECT_THAT(offences, IsEmpty());
}

// Where is srivc? In srivc.cpp. A family of methods in one file has its first function there.
TEST(architecture, an_estimator_is_defined_in_the_file_of_its_name) {
    std::map<std::string, std::string> first_of_family;
    for (const dynlab::MethodEntry& method : dynlab::method_catalog())
        first_of_family[fs::path(method.file).filename().string()] = method.lua_names.front();
    std::vector<std::string> offences;
    for (const fs::path& file : files_below(kRoot / "engine/numerics/estimators", {".cpp"})) {
        const std::string name = file.stem().string();
        if (name == "method_catalog") continue;
        const std::vector<std::string> defined = functions_defined_in(text_of(file));
        const auto holds = [&](const std::string& function) {
            return std::find(defined.begin(), defined.end(), function) != defined.end();
        };
        if (!holds(name) && !holds(first_of_family[name])) offences.push_back(place_of(file));
    }
    EXPECT_THAT(offences, IsEmpty());
}

TEST(architecture, every_module_of_the_core_has_its_own_test) {
    std::vector<std::string> untested;
    for (const char* module : {"statistics", "filters", "criteria", "fit", "estimators"}) {
        for (const fs::path& file : files_below(kRoot / "engine/numerics" / module, {".cpp"})) {
            const fs::path folder = fs::relative(file.parent_path(), kRoot / "engine/numerics");
            const fs::path test = kRoot / "tests/unit" / folder / ("test_" + file.filename().string());
            if (!fs::exists(test)) untested.push_back(place_of(file));
        }
    }
    EXPECT_THAT(untested, IsEmpty());
}

/// The functions that a header declares outside classes without a comment for the function or its block.
std::vector<std::string> undocumented_functions(const std::string& header) {
    std::vector<std::string> found;
    std::istringstream lines(header);
    bool documented = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("///")) documented = true;
        if (line.empty()) documented = false;
        static const std::regex declaration(
            R"((?!namespace|template|struct|class|enum|using|static_assert)[A-Za-z][^=]* (\w+)\(.*)");
        if (std::smatch parts;
            !documented && std::regex_match(line, parts, declaration) && line.find("///") == line.npos)
            found.push_back(parts[1]);
    }
    return found;
}

// What a caller must know of numerics: what a function is for, what it refuses, in which unit it wants and gives what
// has one.
TEST(architecture, headers_of_numerics_state_purpose_errors_and_units) {
    const std::regex refuses("\\bthrow |\\brequire\\w*\\("), reported("[Tt]hrow|InvalidArgument|[Rr]efuse");
    const std::regex dimensioned(
        "\\b(Ts|delay|duration|cutoff|frequency|frequencies|period|lambda|time)\\b(?= ?[,)=;])");
    const std::regex unit("\\b(s|rad/s|Hz|samples?|seconds|time unit|rad|unit)\\b");
    std::vector<std::string> offences;
    for (const fs::path& file : files_below(kRoot / "engine/numerics", {".h"})) {
        const std::string header = text_of(file);
        std::string comments;
        for (const std::string& comment : matches(header, "//([^\n]*)")) comments += comment + "\n";
        const std::string code = std::regex_replace(header, std::regex("//[^\n]*"), "");
        for (const std::string& function : undocumented_functions(header))
            offences.push_back(place_of(file) + ": no comment on " + function);
        const fs::path source = fs::path(file).replace_extension(".cpp");
        if (fs::exists(source) && std::regex_search(text_of(source), refuses) && !std::regex_search(comments, reported))
            offences.push_back(place_of(file) + ": no word on what is refused");
        if (std::regex_search(code, dimensioned) && !std::regex_search(comments, unit))
            offences.push_back(place_of(file) + ": no unit");
    }
    EXPECT_THAT(offences, IsEmpty());
}

TEST(architecture, only_the_renderer_knows_gnuplot_iostream) {
    std::vector<std::string> users;
    for (const fs::path& file : sources_below(kRoot / "engine")) {
        if (text_of(file).find("#include <gnuplot-iostream.h>") != std::string::npos) users.push_back(place_of(file));
    }
    EXPECT_THAT(users, testing::ElementsAre("engine/figures/gnuplot_renderer.cpp"));
}

// tests/fuzz is compiled by clang, and clang 14 cannot read the views of GCC 12's library.
TEST(architecture, sources_need_no_views_which_clang_cannot_read) {
    std::vector<std::string> users;
    for (const fs::path& file : sources_below(kRoot / "engine")) {
        const std::string text = text_of(file);
        if (text.find("#include <ranges>") != std::string::npos || text.find("std::views::") != std::string::npos)
            users.push_back(place_of(file));
    }
    EXPECT_THAT(users, IsEmpty());
}

/// The text between the quotes of a source, piece by piece.
std::vector<std::string> literals_of(const std::string& source) {
    const std::string code = std::regex_replace(source, std::regex("#include[^\n]*|//[^\n]*"), "");
    return matches(code, R"rx("((?:[^"\\\n]|\\.)*)")rx");
}

/// Names of options as scripts write them, MaxIter, of all functions, but for the field's own symbols.
std::set<std::string> option_words_of_lua() {
    const std::set<std::string> symbols = {"Kp", "Td",   "Ts",       "Tw",
                                           "Tz", "Zeta", "Reference"};  // "Reference: Ljung ..."
    std::set<std::string> words;
    for (const dynlab::FunctionEntry& function : dynlab::catalog_of_functions())
        for (const std::string& word : dynlab::option_names(function.options))
            if (std::regex_match(word, std::regex("[A-Z][A-Za-z]+")) && !symbols.contains(word)) words.insert(word);
    return words;
}

/// Whether `text` contains `word` as a complete word, not as a part of a longer name.
bool says_word(const std::string& text, const std::string& word) {
    const auto goes_on = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; at += word.size()) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !goes_on(text[at - 1])) && (end == text.size() || !goes_on(text[end]))) return true;
    }
    return false;
}

// Numerics is a library for C++: its options have names of C++, and messages name them in backticks, for scripting to
// put in its own words. A type may be called as an option is (InitialState), but no message says so.
TEST(architecture, numerics_knows_no_option_of_lua) {
    const std::set<std::string> words = option_words_of_lua();
    ASSERT_GE(words.size(), 12u);
    std::set<std::string> types;
    for (const fs::path& file : sources_below(kRoot / "engine/numerics"))
        for (const std::string& type : matches(text_of(file), R"((?:enum class|struct|class) ([A-Z]\w*))"))
            types.insert(type);
    std::vector<std::string> offences;
    for (const fs::path& file : sources_below(kRoot / "engine/numerics")) {
        const std::string text = text_of(file);
        std::string said;
        for (const std::string& literal : literals_of(text)) said += literal + "\n";
        for (const std::string& word : words)
            if (says_word(types.contains(word) ? said : text, word))
                offences.push_back(place_of(file) + " says " + word);
    }
    EXPECT_THAT(offences, IsEmpty());
}

TEST(architecture, scripting_has_a_word_for_every_option_that_messages_name) {
    const std::vector<std::string> known = dynlab::translated_options();
    std::set<std::string> unknown, named;
    const auto count = [&](const std::vector<std::string>& options) {
        for (const std::string& option : options)
            (std::find(known.begin(), known.end(), option) == known.end() ? unknown : named).insert(option);
    };
    for (const fs::path& file : sources_below(kRoot / "engine/numerics")) {
        const std::string text = text_of(file);
        count(matches(text, R"re(OptionName(?: \w+)?\{"([a-z_]+)"\})re"));
        for (const std::string& literal : literals_of(text)) count(matches(literal, "`([a-z_]+)`"));
    }
    EXPECT_THAT(unknown, IsEmpty());
    EXPECT_EQ(named.size(), known.size()) << "a word that no message needs";
}

TEST(architecture, top_level_is_the_fixed_one) {
    const std::set<std::string> fixed = {"CMakeLists.txt",   "engine", "lessons",   "scripts", "data",
                                         "report_templates", "tests",  "README.md", "LICENSE"};
    std::vector<std::string> extra;
    for (const auto& entry : fs::directory_iterator(kRoot)) {
        const std::string name = entry.path().filename().string();
        const bool made_here = name.starts_with("build") || name.ends_with(".pdf") || name.ends_with(".html");
        if (!name.starts_with(".") && !made_here && !fixed.contains(name)) extra.push_back(name);
    }
    EXPECT_THAT(extra, IsEmpty());
    for (const std::string& name : fixed) EXPECT_TRUE(fs::exists(kRoot / name)) << name;
}

/// The last of GCC's options for the level of optimization, "" where there is none.
std::string optimization_in(const std::string& command) {
    const std::vector<std::string> levels = matches(command, R"( (-O\w?)(?= ))");
    return levels.empty() ? "" : levels.back();
}

// GCC optimizes a source file at the level of the precompiled headers that it reads. Another level in the options of
// the source file would silently change nothing.
TEST(architecture, sources_have_the_optimization_level_of_their_precompiled_headers) {
    const nlohmann::json commands = nlohmann::json::parse(text_of(DYNLAB_COMPILE_COMMANDS));
    std::map<std::string, std::string> levels;  // of precompiled headers
    for (const nlohmann::json& entry : commands) {
        const std::string file = entry["file"];
        if (file.ends_with("cmake_pch.hxx.cxx"))
            levels[file.substr(0, file.size() - 4)] = optimization_in(entry["command"]);
    }
    std::size_t compared = 0;
    std::vector<std::string> offences;
    for (const nlohmann::json& entry : commands) {
        const std::string file = entry["file"], command = entry["command"];
        const std::vector<std::string> headers = matches(command, R"(-include (\S+cmake_pch\.hxx) )");
        if (headers.empty() || file.ends_with("cmake_pch.hxx.cxx")) continue;
        ++compared;
        const std::string& level = levels.at(headers.back());
        if (optimization_in(command) != level) offences.push_back(file + " instead of " + level);
    }
    EXPECT_GT(compared, 20u);
    EXPECT_THAT(offences, IsEmpty());
}

// The warnings of the optimizer differ between processors. A copied array without values was an error on processors
// without AVX-512, where dynlab could not be built.
TEST(architecture, warnings_that_depend_on_the_processor_stop_no_build) {
    const auto compiles = [](const std::string& source) {
        const std::string command =
            "echo '" + source + "' | LC_ALL=C " DYNLAB_COMPILER " -O2 -x c++ -c -o /dev/null - 2>&1; echo $?";
        return output_of(command);
    };
    const std::string no_value = "int f(int n) { int x; if (n > 3) x = n; return x; }";
    const std::string freed = "void f(char* p) { __builtin_free(p); *p = 1; }";
    EXPECT_THAT(compiles(no_value), testing::EndsWith("0\n"));
    EXPECT_THAT(compiles(freed), testing::AllOf(HasSubstr("warning: "), testing::EndsWith("0\n")));
    EXPECT_THAT(compiles("void f() { int unused; }"), testing::AllOf(HasSubstr("error: "), testing::EndsWith("1\n")));
}

TEST(architecture, files_stay_readable) {
    std::vector<std::string> long_files;
    for (const fs::path& file : sources_below(kRoot / "engine")) {
        const std::string text = text_of(file);
        const auto lines = std::count(text.begin(), text.end(), '\n');
        if (lines > (file.extension() == ".h" ? 160 : 450)) {
            long_files.push_back(place_of(file) + " has " + std::to_string(lines) + " lines");
        }
    }
    EXPECT_THAT(long_files, IsEmpty());
}

TEST(architecture, every_data_set_names_its_source) {
    for (const auto& entry : fs::directory_iterator(kRoot / "data")) {
        if (!entry.is_directory()) continue;
        EXPECT_TRUE(fs::exists(entry.path() / "SOURCE.md")) << entry.path().filename();
    }
}

TEST(architecture, every_method_has_its_files_test_and_lua_name) {
    std::set<std::string> lua_names;
    for (const dynlab::FunctionEntry& function : dynlab::catalog_of_functions()) lua_names.insert(function.name);
    for (const dynlab::MethodEntry& method : dynlab::method_catalog()) {
        const fs::path source = kRoot / "engine/numerics/estimators" / method.file;
        EXPECT_TRUE(fs::exists(source.string() + ".h")) << method.file;
        EXPECT_TRUE(fs::exists(source.string() + ".cpp")) << method.file;
        const fs::path test = kRoot / "tests/unit/estimators" / method.file;
        EXPECT_TRUE(fs::exists(test.parent_path() / ("test_" + test.filename().string() + ".cpp"))) << method.file;
        for (const std::string& name : method.lua_names) EXPECT_TRUE(lua_names.contains(name)) << name;
    }
}

TEST(architecture, every_method_has_its_invariances_tested) {
    std::string properties;
    for (const fs::path& file : sources_below(kRoot / "tests/properties")) properties += text_of(file);
    for (const dynlab::MethodEntry& method : dynlab::method_catalog())
        EXPECT_THAT(properties, HasSubstr("\"numerics/estimators/" + method.file + ".h\"")) << method.file;
}

TEST(architecture, every_function_has_a_help_page) {
    std::vector<std::string> missing;
    for (const dynlab::FunctionEntry& function : dynlab::catalog_of_functions()) {
        if (!dynlab::find_help_page(function.name)) missing.push_back(function.name);
    }
    EXPECT_THAT(missing, IsEmpty());
}

TEST(architecture, every_data_set_can_be_made_again) {
    for (const auto& entry : fs::directory_iterator(kRoot / "data")) {
        if (!entry.is_directory()) continue;
        if (text_of(entry.path() / "SOURCE.md").find("\nPackage: ") != std::string::npos) continue;  // not stored here
        EXPECT_TRUE(fs::exists(kRoot / "scripts/make_data" / (entry.path().filename().string() + ".lua")))
            << entry.path().filename();
    }
}

}  // namespace test_architecture
