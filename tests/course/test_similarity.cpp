#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <random>
#include <regex>
#include <set>

#include "course/grading_bench.h"
#include "course/similarity/similarity.h"
#include "platform/files/zip_file.h"

namespace dynlab::test {
namespace test_similarity {
using ::testing::HasSubstr;

const std::string kStarter =
    "-- %% id=record\nlocal Ts, N = 0.01, 1500\nlocal u = prbs(4, 100)\nlocal Go = tf({2}, {1, 4, 3})\n"
    "local x = lsim(Go, u, Ts)\n-- YOUR CODE HERE\nlocal function show(name, value)\n"
    "  if type(value) == \"number\" then print(name, string.format(\"%.3f\", value)) else print(name, value) "
    "end\nend\n";

/// An author who writes a lesson's script alone. The author solves each task in one of several ways, with the pieces in
/// any order and with any names.
class Author {
  public:
    explicit Author(unsigned seed) : random_(seed) {}

    std::string script() {
        std::string text = kStarter;
        std::vector<std::string> tasks = {noise(),   regression(), library(),  table(),
                                          scatter(), fit_task(),   residuals()};
        // The data set comes first. The other tasks follow in the author's order.
        std::shuffle(tasks.begin() + 1, tasks.end(), random_);
        for (const std::string& task : tasks) text += extra() + task;
        return text;
    }

  private:
    unsigned pick(unsigned n) { return std::uniform_int_distribution<unsigned>(0, n - 1)(random_); }
    template <class... T>
    std::string one_of(T... texts) {
        const std::vector<std::string> all = {texts...};
        return all[pick(static_cast<unsigned>(all.size()))];
    }
    std::string name() { return fmt::format("{}{}", one_of("a", "my", "tmp", "res", "val", "k", "sig"), ++names_); }

    /// What people add by themselves: something printed, drawn, or computed on the way.
    std::string extra() {
        const std::string a = name(), b = name();
        switch (pick(8)) {
            case 0:
                return fmt::format("local {0} = mean(u)\nprint(\"mean of the input\", {0}, #u*Ts)\n", a);
            case 1:
                return fmt::format("for {0} = 1, {1} do\n  if u[{0}] > 0 then print({0}, u[{0}], x[{0}]) end\nend\n", a,
                                   3 + pick(9));
            case 2:
                return fmt::format("local function {0}({1}) return {1}*{1} + {2} end\nshow(\"square\", {0}(3))\n", a, b,
                                   pick(9));
            case 3:
                return fmt::format(
                    "plot(Ts*range(1, N), x, {{title = \"output\", xlabel = \"s\"}})\nshow(\"top\", max(x))\n");
            case 4:
                return fmt::format(
                    "local {0}, {1} = max(x), min(x)\nif {0} - {1} < 1 then error(\"odd\") else show(\"range\", {0} - "
                    "{1}) end\n",
                    a, b);
            case 5:
                return fmt::format(
                    "local {0} = {{}}\nwhile #{0} < {1} do {0}[#{0} + 1] = 2^#{0} end\nprint(table.concat({0}, \" "
                    "\"))\n",
                    a, 3 + pick(5));
            case 6:
                return fmt::format("bode(Go)\nlocal {0} = bandwidth(Go)\nshow(\"bandwidth\", {0}/(2*math.pi))\n", a);
            default:
                return "";
        }
    }

    std::string noise() {
        const std::string s = name(), i = name();
        return one_of(
            fmt::format("local y = x + 0.2*randn(N)\nlocal data = iddata(y, u, Ts)\n"),
            fmt::format(
                "local {0} = 0.2\nlocal y = x + {0}*randn(#u)\nlocal data = iddata(y, u, Ts, {{InputName = \"u\"}})\n",
                s),
            fmt::format("local {0} = randn(N)\nlocal y = vector(N)\nfor {1} = 1, N do y[{1}] = x[{1}] + 0.2*{0}[{1}] "
                        "end\nlocal data = iddata(y, u, Ts)\n",
                        s, i),
            fmt::format("local function {0}(clean)\n  return clean + 0.2*randn(#clean)\nend\nlocal y = {0}(x)\nlocal "
                        "data = iddata(y, u, Ts)\n",
                        s));
    }
    std::string regression() {
        const std::string f = name(), a = name(), b = name(), c = name();
        return one_of(
            fmt::format("local function {0}(s)\n  local {1}, {2} = svf(s, 2, 3, {{Ts = Ts}}), svf(u, 2, 3, {{Ts = Ts, "
                        "hold = \"zoh\"}})\n  return solve(matrix{{-{1}:col(2), -{1}:col(3), {2}:col(3)}}, "
                        "{1}:col(1))\nend\nanswer(\"own\", {0}(y))\n",
                        f, a, b),
            fmt::format(
                "local {0} = svf(y, 2, 3, {{Ts = Ts}})\nlocal {1} = svf(u, 2, 3, {{Ts = Ts, hold = \"zoh\"}})\nlocal "
                "{2} = matrix{{-{0}:col(2), -{0}:col(3), {1}:col(3)}}\nanswer(\"own\", solve({2}, {0}:col(1)))\n",
                a, b, c),
            fmt::format("local {0} = {{}}\n{0}.out, {0}.inp = svf(y, 2, 3, {{Ts = Ts}}), svf(u, 2, 3, {{Ts = Ts, hold "
                        "= \"zoh\"}})\nlocal {1} = matrix{{{0}.out:col(2), {0}.out:col(3), {0}.inp:col(3)}}\nlocal {2} "
                        "= solve({1}, {0}.out:col(1))\nanswer(\"own\", vector{{-{2}[1], -{2}[2], {2}[3]}})\n",
                        a, b, c),
            fmt::format(
                "local {0}, {1} = 3, 2\nlocal function {2}(signal, how) return svf(signal, {1}, {0}, {{Ts = Ts, hold = "
                "how}}) end\nlocal {3} = {2}(y, \"foh\")\nlocal P = matrix{{-1*{3}:col(2), -1*{3}:col(3), {2}(u, "
                "\"zoh\"):col(3)}}\nlocal theta = solve(P.T*P, P.T*{3}:col(1))\nanswer(\"own\", theta)\n",
                a, b, f, c));
    }
    std::string library() {
        const std::string a = name(), b = name();
        return one_of(
            fmt::format(
                "answer(\"G_lssvf\", lssvf(data, {{2, 1, 0}}, 3))\nanswer(\"G_ivsvf\", ivsvf(data, {{2, 1, 0}}, 3))\n"),
            fmt::format("local {0} = {{2, 1, 0}}\nlocal {1} = lssvf(data, {0}, 3)\npresent({1})\nanswer(\"G_lssvf\", "
                        "{1})\nanswer(\"G_ivsvf\", ivsvf(data, {0}, 3))\n",
                        a, b),
            fmt::format("for {0}, {1} in pairs({{G_lssvf = lssvf, G_ivsvf = ivsvf}}) do\n  answer({0}, {1}(data, {{2, "
                        "1, 0}}, 3))\nend\n",
                        a, b),
            fmt::format("local {0}, {1} = lssvf(data, {{2, 1, 0}}, 3), ivsvf(data, {{2, 1, 0}}, 3)\nif {0} and {1} "
                        "then\n  answer(\"G_lssvf\", {0})\n  answer(\"G_ivsvf\", {1})\nend\n",
                        a, b));
    }
    std::string table() {
        const std::string a = name(), b = name(), c = name();
        return one_of(
            fmt::format(
                "local {0} = {{}}\nfor _, {1} in ipairs{{0.3, 1, 3, 10, 30}} do\n  {0}[#{0} + 1] = {{{1}, lssvf(data, "
                "{{2, 1, 0}}, {1}).param[1]}}\nend\nreport.table(\"cut_offs\", {0}, {{\"lambda\", \"a1\"}})\n",
                a, b),
            fmt::format(
                "local {0} = {{0.5, 2, 8}}\nfor {1} = 1, #{0} do\n  local {2} = lssvf(data, {{2, 1, 0}}, {0}[{1}])\n  "
                "print(string.format(\"%5.1f %8.4f %8.4f\", {0}[{1}], {2}.param[1], {2}.param[2]))\nend\n",
                a, b, c),
            fmt::format(
                "local function {0}({1}) return norm(lssvf(data, {{2, 1, 0}}, {1}).param - vector{{4, 3, 2}}) "
                "end\nlocal {2} = 1\nwhile {2} < 20 and {0}({2}) > 0.1 do {2} = 1.5*{2} end\nshow(\"cut-off\", {2})\n",
                a, b, c),
            fmt::format(
                "local {0}, {1} = math.huge, nil\nfor {2} = 1, 10 do\n  local e = std(resid(data, ivsvf(data, {{2, 1, "
                "0}}, {2})).e)\n  if e < {0} then {0}, {1} = e, {2} end\nend\nprint(\"best\", {1}, {0})\n",
                a, b, c));
    }
    std::string scatter() {
        const std::string a = name(), b = name();
        return one_of(
            fmt::format("local {0} = montecarlo{{system = Go, input = u, Ts = Ts, sigma = 0.2, runs = 200, estimators "
                        "= {{tfsrivc = {{2, 0}}}}}}\nanswer(\"scatter\", {0}.tfsrivc.std)\n",
                        a),
            fmt::format(
                "local {0} = {{system = Go, input = u}}\n{0}.Ts, {0}.sigma, {0}.runs = Ts, 0.2, 200\n{0}.estimators = "
                "{{srivc = {{{{1, 2, 0}}}}}}\nlocal {1} = montecarlo({0})\nanswer(\"scatter\", {1}.srivc.std)\n",
                a, b),
            fmt::format("local {0} = {{}}\nfor run = 1, 200 do\n  local d = iddata(x + 0.2*randn(N), u, Ts)\n  "
                        "{0}[run] = srivc(d, {{1, 2, 0}}).param\nend\nlocal {1} = matrix({0})\nanswer(\"scatter\", "
                        "vector{{std({1}:col(1)), std({1}:col(2)), std({1}:col(3))}})\n",
                        a, b));
    }
    std::string fit_task() {
        const std::string a = name(), b = name();
        return one_of(
            fmt::format("local {0} = tfsrivc(data, 2, 0)\npresent({0})\ncompare(data, {0})\nanswer(\"G_final\", {0})\n",
                        a),
            fmt::format("local {0} = srivc(data, {{1, 2, 0}})\nlocal {1} = fit(data, {0})\nif {1} > 50 then "
                        "answer(\"G_final\", {0}) else error(\"bad fit\") end\n",
                        a, b),
            fmt::format("local {0} = {{srivc(data, {{1, 2, 0}}), ivsvf(data, {{2, 1, 0}}, 3)}}\ntable.sort({0}, "
                        "function(g, h) return fit(data, g) > fit(data, h) end)\nanswer(\"G_final\", {0}[1])\n",
                        a));
    }
    std::string residuals() {
        const std::string a = name(), b = name();
        return one_of(
            fmt::format("resid(data, tfsrivc(data, 2, 0))\n"),
            fmt::format(
                "local {0} = y - lsim(srivc(data, {{1, 2, 0}}), u, Ts)\nhistogram({0})\nshow(\"noise\", std({0}))\n",
                a),
            fmt::format("local {0} = resid(data, lssvf(data, {{2, 1, 0}}, 3))\nlocal {1} = 0\nfor _, v in "
                        "ipairs({0}.e:table()) do {1} = {1} + v^2 end\nprint(\"sum of squares\", {1})\n",
                        a, b));
    }

    std::mt19937 random_;
    int names_ = 0;
};

/// Every chosen name becomes another one.
std::string renamed(const std::string& script) {
    static const std::regex chosen(R"(\b(?:a|my|tmp|res|val|k|sig)(\d+)\b)");
    return std::regex_replace(script, chosen, "quite_another_$1");
}

/// Other comments, other line ends and indents, other quotation marks.
std::string laid_out_differently(std::string script) {
    script = std::regex_replace(script, std::regex("\n"), "\n\n   -- as I understood it\n\t");
    script = std::regex_replace(script, std::regex(", "), " ,");
    return std::regex_replace(script, std::regex("\""), "'");
}

/// The pieces after the starter code and the data set, in another order.
std::string reordered(const std::string& script) {
    const std::size_t place = script.find("\n", script.size() / 2) + 1, head = script.find("iddata(");
    const std::size_t data_end = script.find('\n', head) + 1;
    return place <= data_end
               ? script
               : script.substr(0, data_end) + script.substr(place) + script.substr(data_end, place - data_end);
}

std::set<std::pair<std::string, std::string>> names_of(const std::vector<ComparedScript>& scripts,
                                                       const std::vector<SimilarPair>& pairs) {
    std::set<std::pair<std::string, std::string>> names;
    for (const SimilarPair& pair : pairs) names.insert(std::minmax(scripts[pair.a].name, scripts[pair.b].name));
    return names;
}

std::vector<ComparedScript> independent(unsigned count, unsigned seed) {
    std::vector<ComparedScript> scripts;
    for (unsigned k = 0; k < count; ++k) scripts.push_back({fmt::format("group-{:03}", k), Author(seed + k).script()});
    return scripts;
}

constexpr double kLine = 0.6;

// oracle: each script was made independently
TEST(similarity, fifty_who_work_alone_are_not_reported) {
    for (const unsigned seed : {1u, 1000u, 2000u, 3000u}) {
        const auto scripts = independent(50, seed);
        const auto pairs = similar_pairs(scripts, kStarter, kLine);
        EXPECT_TRUE(pairs.empty()) << pairs.size() << " pairs, the first " << scripts[pairs[0].a].name << ", "
                                   << scripts[pairs[0].b].name << ": " << pairs[0].share;
    }
}

// oracle: the copies that were planted
TEST(similarity, copies_are_found_whatever_they_are_called_and_laid_out) {
    auto scripts = independent(50, 1);
    std::set<std::pair<std::string, std::string>> planted;
    const auto plant = [&](std::size_t original, const std::string& source) {
        const std::string name = fmt::format("planted-{}", planted.size());
        planted.insert(std::minmax(scripts[original].name, name));
        scripts.push_back({name, source});
    };
    for (std::size_t k = 0; k < 5; ++k) {
        plant(k, scripts[k].source);
        plant(10 + k, renamed(scripts[10 + k].source));
        plant(20 + k, laid_out_differently(renamed(scripts[20 + k].source)));
        plant(30 + k, reordered(renamed(scripts[30 + k].source)));
        plant(40 + k,
              scripts[40 + k].source +
                  "local extra = {}\nfor i = 1, 30 do extra[i] = i^2 + math.sin(i) end\nprint(#extra, extra[3])\n");
    }
    EXPECT_EQ(names_of(scripts, similar_pairs(scripts, kStarter, kLine)), planted);
}

// oracle: as above; a class that copied from one source is reported although its scripts have everything in common
TEST(similarity, a_class_of_copies_and_copies_of_the_worked_solution_are_reported) {
    const std::string solution = Author(77).script();
    std::vector<ComparedScript> scripts;
    for (int k = 0; k < 10; ++k) scripts.push_back({fmt::format("{}", k), renamed(solution)});
    scripts.push_back({"alone", Author(78).script()});
    scripts.push_back({"untouched", kStarter});
    scripts.push_back({"the reference solution", solution, false});
    scripts.push_back({"2025/a", Author(78).script(), false});
    scripts.push_back({"2025/b", solution, false});
    const auto names = names_of(scripts, similar_pairs(scripts, kStarter, kLine));
    EXPECT_EQ(names.size(), 45u + 10 + 10 + 1);
    EXPECT_TRUE(names.contains({"2025/a", "alone"}));
    EXPECT_TRUE(names.contains({"0", "the reference solution"}));
    EXPECT_FALSE(names.contains({"2025/b", "the reference solution"}));
}

// oracle: the lessons' scripts that solve the same tasks by other methods, or wrongly, were written apart
TEST(similarity, of_the_lessons_scripts_none_is_a_copy) {
    for (const std::string& lesson : lessons_with_checks()) {
        std::vector<ComparedScript> scripts;
        for (const auto& entry : std::filesystem::directory_iterator(lesson_folder(lesson))) {
            const std::string name = entry.path().filename();
            if (name.ends_with(".lua") && name != "checks.lua" && name != "moved_answers.lua")
                scripts.push_back({name, read_file(entry.path())});
        }
        for (const auto& [a, b] : names_of(scripts, similar_pairs(scripts, "", kLine)))
            EXPECT_TRUE(a.starts_with("wrong_") && b.starts_with("wrong_")) << lesson << ": " << a << ", " << b;
    }
}

TEST(similarity, both_sides_are_shown_and_nothing_of_them_is_markup) {
    const std::string source = Author(5).script();
    const std::vector<ComparedScript> scripts = {{"a_b|c", source}, {"d", "-- one line more\n" + renamed(source)}};
    const auto pairs = similar_pairs(scripts, kStarter, kLine);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].share, 1);
    EXPECT_LT(pairs[0].same_lines, 0.9);
    ASSERT_FALSE(pairs[0].passages.empty());
    const CommonPassage& longest = pairs[0].passages[0];
    EXPECT_EQ(longest.first_b, longest.first_a + 1);
    EXPECT_EQ(longest.last_b, longest.last_a + 1);
    const std::string text = similarity_in_markdown(scripts, similar_groups(scripts, pairs), kLine);
    EXPECT_THAT(text, HasSubstr("| a\\_b\\|c and d | 100 % |"));
    EXPECT_THAT(text, HasSubstr(fmt::format("*d*, lines {} to {}:", longest.first_b, longest.last_b)));
    EXPECT_THAT(similarity_in_markdown(scripts, {}, kLine), HasSubstr("There are none."));
}

// oracle: sixteen who share one text are one group
TEST(similarity, copies_of_one_script_are_one_group) {
    const std::string source = Author(1).script();
    std::vector<ComparedScript> scripts;
    for (int k = 0; k < 16; ++k) scripts.push_back({fmt::format("s{:02}", k), source});
    auto pairs = similar_pairs(scripts, kStarter, kLine);
    EXPECT_EQ(pairs.size(), 120u);
    auto groups = similar_groups(scripts, pairs);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0].members.size(), 16u);
    EXPECT_TRUE(groups[0].identical);
    const std::string text = similarity_in_markdown(scripts, groups, kLine);
    EXPECT_THAT(text, HasSubstr("s00, s01, s02, s03, s04, s05, s06, s07, s08, s09, s10, s11, s12, s13, s14, s15 | "
                                "identical files | 100 % |"));
    EXPECT_THAT(text, HasSubstr("## s00 and 15 others: identical files"));
    EXPECT_THAT(text, HasSubstr("*s00*, lines "));
    EXPECT_THAT(text, Not(HasSubstr("*s01*, lines ")));  // the same once more
}

// oracle: the copies that were planted; a script with half of a copied one is paired with the group once
TEST(similarity, a_script_like_several_copies_is_listed_once) {
    const std::string source = Author(1).script(), other = Author(2).script();
    const std::string half = source.substr(0, source.find('\n', source.size() / 2) + 1) +
                             other.substr(other.find('\n', other.size() / 2) + 1);
    const std::vector<ComparedScript> scripts = {{"a", source},
                                                 {"b", renamed(source)},
                                                 {"c", laid_out_differently(source)},
                                                 {"d", half},
                                                 {"e", Author(3).script()}};
    const auto pairs = similar_pairs(scripts, kStarter, 0.3);
    EXPECT_GE(pairs.size(), 6u);
    const auto groups = similar_groups(scripts, pairs);
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_THAT(groups[0].members, testing::ElementsAre(0, 1, 2));
    EXPECT_FALSE(groups[0].identical);
    EXPECT_TRUE(groups[1].has(3));
    EXPECT_EQ(groups[1].copies_of_first + groups[1].copies_of_second, 2u);
    EXPECT_FALSE(groups[1].shown.passages.empty());
}

// oracle: the shorter script is all of a part of both longer ones, which have nothing else in common
TEST(similarity, a_part_of_two_scripts_does_not_make_them_copies) {
    std::string part = Author(4).script(), one = part, two = part;
    for (unsigned k = 0; k < 4; ++k) {
        one += Author(100 + k).script().substr(kStarter.size());
        two += Author(200 + k).script().substr(kStarter.size());
    }
    const std::vector<ComparedScript> scripts = {{"part", part}, {"one", one}, {"two", two}};
    for (const SimilarGroup& group : similar_groups(scripts, similar_pairs(scripts, kStarter, kLine)))
        EXPECT_EQ(group.members.size(), 2u);
}

TEST(similarity, the_command_compares_a_class_with_a_former_year) {
    GradingBench bench("--   x: number\n", "check{id = 'x', test = function(a) return true end}\n",
                       "-- BEGIN SOLUTION\n" + Author(9).script().substr(kStarter.find('\n') + 1) +
                           "-- END SOLUTION\nanswer('x', 1)\n");
    bench.submit_file("a", Author(1).script());
    bench.submit_file("b", renamed(Author(1).script()));
    bench.submit_file("c", Author(2).script());
    bench.bench().write("in/d/notes.txt", "no script");
    bench.bench().write("2025/old/analysis.lua", laid_out_differently(Author(2).script()));
    std::map<std::string, std::string> files;  // as a platform exports them
    for (const auto& entry : std::filesystem::recursive_directory_iterator(bench.bench().path("in")))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(bench.bench().path("in")).string()] = read_file(entry.path());
    write_zip(bench.bench().path("Lab4.zip"), files);
    const ChildResult found =
        bench.bench().dynlab({"similar", "Lab4.zip", "--lesson", "99", "--out", "out", "--compare", "2025"});
    EXPECT_EQ(found.exit_code, 1);
    EXPECT_THAT(found.error_output, HasSubstr("\"d\": The submission contains no"));
    EXPECT_EQ(found.output, "3 scripts compared: 0 groups of copies, 2 pairs\nout/similarity.md\n");
    EXPECT_THAT(bench.bench().read("out/similarity.csv"), HasSubstr("a,b,100,"));
    EXPECT_THAT(bench.bench().read("out/similarity.csv"), HasSubstr("c,2025/old,100,"));
}

}  // namespace test_similarity
}  // namespace dynlab::test
