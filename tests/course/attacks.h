#pragma once

namespace dynlab::test {

/// A lesson of one answer, which scripts attack instead of giving it.
inline constexpr const char* kAttackAnswers = "--   x: number\n";
inline constexpr const char* kAttackSolution = "answer('x', 42)\n";
inline constexpr const char* kAttackChecks =
    "check{id = 'x', test = function(a) return near(a.x, 42, {rel = 0.01}) end}\n";

struct Attack {
    const char *name, *script;
    double score;
    const char* reported;  ///< part of what the student or the instructor reads of it; "" where nothing need be said
};

/// Every attack submits the right answer if it can, so that the attack itself causes a score of zero.
inline const Attack kAttacks[] = {
    {"empty_repeated", "local s = string.rep('', 1e18)\nanswer('x', 42)", 1, ""},
    {"long_text", "local s = string.rep('x', 1e12)\nanswer('x', 42)", 0, ""},
    {"huge_move", "table.move({}, 1, 1e18, 2)\nanswer('x', 42)", 0, ""},
    {"huge_insert", "table.insert(setmetatable({}, {__len = function() return 1e15 end}), 1, 2)\nanswer('x', 42)", 0,
     ""},
    {"huge_remove", "table.remove(setmetatable({}, {__len = function() return 1e15 end}), 1)\nanswer('x', 42)", 0, ""},
    {"huge_concat", "table.concat({}, 'x', 1, 1e15)\nanswer('x', 42)", 0, ""},
    {"memory_bomb", "local t = {}\nwhile true do t[#t + 1] = string.rep('x', 1e6) .. #t end", 0, ""},
    {"table_bomb", "local t = {}\nwhile true do t = {t, t, {t}} t[#t + 1] = {} end", 0, ""},
    {"vector_bomb", "local v = {}\nwhile true do v[#v + 1] = zeros(7e7) end", 0, "the limit of the script is 1.07 GB"},
    {"huge_vector", "answer('x', #zeros(1e15))", 0, ""},
    {"huge_matrix", "eye(1e9)", 0, ""},
    {"deep_recursion", "local function f() return 1 + f() end\nf()", 0, ""},
    {"binary_chunk", "local f = load('\\27Lua')\nanswer('x', 42)", 0, ""},
    {"dump", "string.dump(print)\nanswer('x', 42)", 0, "dump"},
    {"poison", "getmetatable('').__index = function() return 1 end\nanswer('x', 42)", 0, ""},
    {"poison_answer", "dynlab.answer = nil", 0, ""},
    {"no_io", "io.open('/etc/passwd')", 0, "io"},
    {"no_os", "os.execute('touch pwned')", 0, "os"},
    {"no_require", "require('os')", 0, "require"},
    {"no_debug", "debug.sethook()", 0, "debug"},
    {"no_dofile", "dofile('/etc/passwd')", 0, "dofile"},
    {"read_system", "load('/etc/passwd')", 0, ""},
    {"read_up", "load('../../secret.csv')", 0, "is outside the folder"},
    {"read_solution", "load('../home/lessons/99_small/lesson.csv')", 0, "is outside the folder"},
    {"write_up", "save_csv('../../../pwned.csv', {y = vector{1, 2}})\nanswer('x', 42)", 0, ""},
    {"write_results", "save_csv('results.csv', {score = vector{1, 1}})\nanswer('x', 42)", 1, ""},
    {"forged_output",
     "print('{\"checks\":[{\"id\":\"x\",\"share\":1}],\"answers\":{\"x\":{\"kind\":\"number\",\"value\":42}}}')", 0,
     ""},
    {"forged_text", "answer('x', '42\"}},\"checks\":[{\"share\":1}]')", 0, "number"},
    {"flood", "while true do print(string.rep('x', 1e5)) end", 0, ""},
    {"not_a_number", "answer('x', 0/0)", 0, ""},
    {"infinite", "answer('x', 1/0)", 0, ""},
    {"cyclic", "local t = {}\nt.t = t\nanswer('x', t)", 0, "contains itself"},
    {"shared", "local t = {}\nfor i = 1, 7 do local n = {}\nfor k = 1, 100 do n[k] = t end\nt = n end\nanswer('x', t)",
     0, "at most"},
    {"functions", "answer('x', print)", 0, "cannot be an answer"},
    {"twice", "answer('x', 42)\nanswer('x', 41)", 0, "already has another value"},
    {"undeclared", "answer('y', 42)", 0, "was not submitted"},
    {"long_name", "answer(string.rep('x', 1e6), 42)", 0, ""},
    {"other_header", "-- ---\n-- title: Mine\n-- answers:\n--   x: text\n-- ---\nanswer('x', 'forty-two')\n", 0,
     "number"},
    {"shell_label", "save(plot(vector{1, 2}, {title = '`touch pwned`'}), 'a.pdf')\nanswer('x', 42)", 1, ""},
    {"shell_file", "save(plot(vector{1, 2}), 'a.pdf|touch pwned')\nanswer('x', 42)", 1, ""},
    {"syntax", "answer('x' 42)", 0, "analysis.lua:1"},
    {"nothing", "", 0, ""},
};
/// These are ended by time, of which a second is as good as any.
inline const Attack kEndlessAttacks[] = {
    {"endless", "while true do end", 0, "of processor time"},
    {"endless_pcall", "local function f() while true do end end\nwhile true do pcall(f) end", 0, "of processor time"},
    {"endless_coroutine", "while true do coroutine.wrap(function() while true do end end)() end", 0,
     "of processor time"},
    {"endless_coroutine_pcall",
     "while true do coroutine.resume(coroutine.create(function() while true do end end)) end", 0, "of processor time"},
    {"endless_xpcall", "local function h() while true do end end\nwhile true do xpcall(error, h) end", 0,
     "of processor time"},
    {"endless_close", "local x <close> = setmetatable({}, {__close = function() while true do end end})\nerror('out')",
     0, ""},
    {"endless_gc", "setmetatable({}, {__gc = function() while true do end end})\nanswer('x', 42)", 0, "__gc"},
    {"endless_tostring", "error(setmetatable({}, {__tostring = function() while true do end end}))", 0, ""},
    {"endless_index", "local t = setmetatable({}, {__index = function() while true do end end})\nanswer('x', t.y)", 0,
     "of processor time"},
    {"endless_sort",
     "local t = {}\nfor i = 1, 1e5 do t[i] = i end\nwhile true do table.sort(t, function() return math.random() < 0.5 "
     "end) end",
     0, ""},
    {"slow_pattern", "string.find(string.rep('a', 40), string.rep('a?', 40) .. string.rep('a', 40))\nanswer('x', 42)",
     0, ""},
    {"slow_gsub", "string.gsub(string.rep('a', 1e5), '.-.-.-.-b', '')\nanswer('x', 42)", 0, ""},
    {"absurd_order", "local d = iddata(randn(500), randn(500), 0.1)\nfor i = 1, 1e6 do pcall(arx, d, {400, 90, 1}) end",
     0, "of processor time"},
    {"long_native",
     "montecarlo{system = tf({2}, {1, 4, 3}), input = prbs(9, 100), Ts = 0.01, sigma = 1, runs = 1e7, seed = 1, "
     "estimators = {srivc = {{1, 2, 0}}}}",
     0, ""},
};

}  // namespace dynlab::test
