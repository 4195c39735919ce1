// Oracle: results worked out by hand, and algebraic identities.
#include <gtest/gtest.h>

#include "script_run.h"

namespace test_script_vectors {

using dynlab::test::error_of;
using dynlab::test::printed;

TEST(script_vectors, calculate_element_by_element) {
    EXPECT_EQ(printed("local v, w = vector{1, 2, 3}, vector{4, 5, 6}\nprint(v + w, v - w, v*w, w/v, v^2, -v)"),
              "[5 7 9]\t[-3 -3 -3]\t[4 10 18]\t[4 2.5 2]\t[1 4 9]\t[-1 -2 -3]\n");
    EXPECT_EQ(printed("local v = vector{1, 2}\nprint(v + 1, 1 - v, 2*v, v/2, 2^v, 1/v)"),
              "[2 3]\t[0 -1]\t[2 4]\t[0.5 1]\t[2 4]\t[1 0.5]\n");
    EXPECT_EQ(printed("local v = vector{1, 2}\nprint(v + {10, 20}, {10, 20} - v)"), "[11 22]\t[9 18]\n");
    EXPECT_EQ(error_of("local v = vector{1, 2} + vector{1, 2, 3}"),
              "lesson.lua:1: x + y needs equal sizes, but x is a vector of 2 values and y is a vector of 3 values");
    EXPECT_EQ(error_of("local v = vector{1, 2} + 'a'"), "lesson.lua:1: x + y is not defined for the string \"a\"");
}

TEST(script_vectors, measure_matrices_by_columns) {
    EXPECT_EQ(
        printed("local A = matrix{{1, 2}, {3, 6}, {8, 1}}\nprint(sum(A), mean(A), median(A))\n"
                "print(max(A))\nprint(min(A))\nprint(var(matrix{{1, 2}, {3, 6}}), std(matrix{{0, 1}, {2, 1}})^2)"),
        "[12 9]\t[4 3]\t[3 2]\n[8 6]\t[3 2]\n[1 1]\t[1 3]\n[2 8]\t[2 0]\n");
    EXPECT_EQ(printed("print(median{5, 1, 3}, median{4, 1, 3, 2}, sum(gt({1, 5, 7}, 2)), sum(5), sum(zeros(0)))"),
              "3\t2.5\t2\t5\t0\n");
    EXPECT_EQ(error_of("median{}"),
              "lesson.lua:1: median: argument 1 (v) must have at least one element, but it is empty");
    EXPECT_EQ(
        error_of("std(matrix{{1, 2}})"),
        "lesson.lua:1: std: a standard deviation or a variance needs at least two values, but only one was given");
}

TEST(script_vectors, round_and_take_logarithms) {
    EXPECT_EQ(printed("print(round(2.5), round(-2.5), floor(-2.5), ceil(2.1), sign(-3), sign(0), log10(1000))"),
              "3\t-3\t-3\t3\t-1\t0\t3\n");
    EXPECT_EQ(printed("print(round{0.4, 0.6}, logspace(-1, 2, 4), #logspace(0, 1))"), "[0 1]\t[0.1 1 10 100]\t50\n");
}

// Oracle: A inv(A) = 1, det by the rule of Sarrus, eigenvalues of a companion matrix, the definition of the transform.
TEST(script_vectors, know_the_inverse_the_eigenvalues_and_the_transform) {
    EXPECT_EQ(printed("local A = matrix{{2, 1, 0}, {1, 3, 1}, {0, 1, 4}}\nlocal E = A*inv(A)\n"
                      "for i = 1, 3 do for j = 1, 3 do\n"
                      "  if abs(E[{i, j}] - (i == j and 1 or 0)) > 1e-14 then print(i, j) end\nend end\n"
                      "print(abs(det(A) - 18) < 1e-12, abs(det(matrix{{1, 2}, {3, 4}}) + 2) < 1e-14)\n"
                      "local v = eig(matrix{{0, 1}, {-3, -4}})\nprint(abs(min(v.re) + 3) < 1e-14, abs(max(v.re) + 1) < "
                      "1e-14)\nprint(eig(matrix{{2, 0}, {0, 1}}))"),
              "true\ttrue\ntrue\ttrue\n[1 2]\n");
    EXPECT_EQ(printed("local x = vector{1, 2, 0, -1, 3}\nlocal X = fft(x)\nlocal worst = 0\nfor k = 1, 5 do\n"
                      "  local re, im = 0, 0\n  for n = 1, 5 do\n    local a = -2*math.pi*(k - 1)*(n - 1)/5\n"
                      "    re, im = re + x[n]*math.cos(a), im + x[n]*math.sin(a)\n  end\n"
                      "  worst = math.max(worst, math.abs(X.re[k] - re), math.abs(X.im[k] - im))\nend\n"
                      "print(worst < 1e-14, abs(abs(X[1]) - 5) < 1e-14, #abs(X))"),
              "true\ttrue\t5\n");
    EXPECT_NE(error_of("inv(matrix{{1, 2}, {2, 4}})").find("singular to working precision"), std::string::npos);
    EXPECT_EQ(error_of("det(matrix{{1, 2}})"),
              "lesson.lua:1: det: argument 1 (A) must be a square matrix, but it is 1 x 2");
}

TEST(script_vectors, a_table_of_named_entries_is_not_a_vector) {
    EXPECT_EQ(
        error_of("vector{x = 3, a = 1}"),
        "lesson.lua:1: vector: argument 1 (values) must be a vector of numbers, but the table contains only named "
        "entries: a, x");
    EXPECT_NE(error_of("mean{a = 1}").find("the table contains only named entries: a"), std::string::npos);
    EXPECT_EQ(printed("print(#vector{})"), "0\n");
}

TEST(script_vectors, where_names_its_arguments_if_their_lengths_differ) {
    for (const char* c : {"vector{1, 1}", "gt({1, 1}, 0)"})
        EXPECT_EQ(
            error_of("where(" + std::string(c) + ", vector{1, 2, 3}, 0)"),
            "lesson.lua:1: where: all vectors must have the same number of elements, but c has 2 values and a has 3");
    EXPECT_EQ(error_of("where(-1*vector{1, 1}, 0, vector{1})"),
              "lesson.lua:1: where: all vectors must have the same number of elements, but c has 2 values and b has 1");
}

TEST(script_vectors, delays_are_written_as_exponentials) {
    EXPECT_EQ(printed("local s = tf('s')\nlocal G = exp(-2*s)/(s + 1)\nprint(G.IODelay, dcgain(G), #pole(G))"),
              "2\t1\t1\n");
    EXPECT_EQ(printed("local s = tf('s')\nlocal G = exp(-0*s)/(s + 1)\nprint(G.IODelay, dcgain(exp(0*s)), #pole(G))"),
              "0\t1\t1\n");
    EXPECT_NE(error_of("local s = tf('s')\nprint(exp(2*s))").find("for models, exp supports only a delay"),
              std::string::npos);
}

TEST(script_vectors, logarithmic_axes_say_what_they_leave_out) {
    EXPECT_EQ(printed("local fig = semilogy(range(1, 4), vector{1, 0, -1, 2})"),
              "semilogy: the figure omits 2 of 4 points, because a logarithmic axis shows only positive values\n");
    EXPECT_EQ(printed("local fig = loglog(range(1, 4), range(1, 4), {color = 'red'})"), "");
}

// Lengths are compared before anything is read: behind the shorter one lies other memory.
TEST(script_vectors, plots_on_logarithmic_axes_refuse_lengths_that_differ) {
    for (const char* call :
         {"semilogx({}, linspace(0, 1, 50))", "loglog({}, linspace(0, 1, 50))", "semilogx({1, 2}, linspace(0, 1, 50))",
          "semilogy(linspace(0, 1, 50), {1, 2})", "semilogx({1}, {1}, {curves = {{x = {1}, y = {1, 2, 3}}}})"})
        EXPECT_NE(error_of(call).find("x and y must have the same length"), std::string::npos) << call;
}

TEST(script_vectors, grids_of_panels_have_a_size) {
    for (const char* call : {"subplot(100000, 100000, {plot({1, 2})})", "figure{panels = {{}}, rows = 2^40 + 1}"})
        EXPECT_NE(error_of(call).find("rows and columns"), std::string::npos) << call;
}

// What is calculated outside of the script's memory is asked for before.
TEST(script_vectors, signals_beyond_the_memory_are_refused_at_once) {
    for (const char* call : {"multisine({1, 5}, 1e9, 0.1)", "sine(1, 1e9, 0.1)", "chirp(1, 2, 1e9, 0.1)",
                             "step_signal(1e10)", "rbs(1e10)", "multisine(1000, {periods = 1e8})"})
        EXPECT_NE(error_of(call).find("values needs 2"), std::string::npos) << call << ": " << error_of(call);
}

TEST(script_vectors, give_and_take_elements) {
    EXPECT_EQ(printed("local v = vector{1, 2, 3}\nv[2] = 7\nprint(#v, v[2], v[3.0], v:range(2, 3), v:range(2, 1))"),
              "3\t7\t3\t[7 3]\t[]\n");
    EXPECT_EQ(printed("local s = 0\nfor i, x in ipairs(vector{1, 2, 3}) do s = s + i*x end\nprint(s)"), "14\n");
    EXPECT_EQ(printed("print(vector{1, vector{2, 3}, 4}, vector{1, 2} == vector{1, 2}, vector{1} == vector{2})"),
              "[1 2 3 4]\ttrue\tfalse\n");
    EXPECT_EQ(printed("local t = vector{1, 2}:table()\nprint(#t, t[2], type(t))"), "2\t2\ttable\n");
    EXPECT_EQ(error_of("local v = vector{1, 2, 3}\nprint(v[4])"),
              "lesson.lua:2: v[4] does not exist: v has the elements 1 to 3");
    EXPECT_EQ(error_of("local v = vector{1, 2, 3}\nprint(v[0])"),
              "lesson.lua:2: v[0] does not exist: v has the elements 1 to 3; the first element is v[1]");
    EXPECT_EQ(error_of("local v = vector{1, 2, 3}\nprint(v[1.5])"),
              "lesson.lua:2: v[1.5]: the index of an element must be a whole number from 1 to 3");
    EXPECT_EQ(
        error_of("local v = vector{1, 2, 3}\nv[4] = 1"),
        "lesson.lua:2: v[4] does not exist: v has 3 elements, and its length is fixed. Use zeros(n) to create a vector "
        "of length n, or vector{v, x} to append x to v");
    EXPECT_EQ(error_of("local v = vector{1, 2, 3}\nv:range(2, 4)"),
              "lesson.lua:2: range: elements 2 to 4 cannot be selected: v has the elements 1 to 3");
    EXPECT_EQ(error_of("local s = 'v = ' .. vector{1}"),
              "lesson.lua:1: the operator .. joins strings; convert the vector to a string first: tostring(x)");
}

TEST(script_vectors, compare_by_functions_that_give_masks) {
    EXPECT_EQ(printed("local v = vector{3, 1, 2}\nprint(gt(v, 1), find(gt(v, 1)), v:select(gt(v, 1)), v:select{2, 1})"),
              "mask: 2 of 3 true\t[1 3]\t[3 2]\t[1 3]\n");
    EXPECT_EQ(printed("local v = vector{3, 1, 2}\nlocal w = vector{2, 2, 2}\n"
                      "print(find(lt(v, w)), find(ge(v, w)), find(le(v, w)), find(eq(v, w)), find(gt(v, 1) & lt(v, "
                      "3)), find(~gt(v, 1)), gt(v, 2)[1])"),
              "[2]\t[1 3]\t[2 3]\t[3]\t[3]\t[2]\ttrue\n");
    EXPECT_EQ(error_of("if vector{1} < 2 then end"),
              "lesson.lua:1: for an element-wise comparison of vectors, use gt(x, y), lt, ge, le or eq, which return a "
              "mask. x < y would return a single true or false");
}

TEST(script_vectors, are_made_in_the_usual_ways) {
    EXPECT_EQ(
        printed(
            "print(zeros(2), ones(2), linspace(0, 1, 3), range(1, 4), range(0, 0.5, 1), range(3, -1, 1), range(2, 1))"),
        "[0 0]\t[1 1]\t[0 0.5 1]\t[1 2 3 4]\t[0 0.5 1]\t[3 2 1]\t[]\n");
    EXPECT_EQ(printed("print(#range(0, 0.01, 15), range(0, 0.1, 0.3)[4] == 3*0.1)"), "1501\ttrue\n");
}

// Oracle: the same numbers have the same sums, wherever in memory they lie.
TEST(script_vectors, sums_do_not_depend_on_the_place_in_memory) {
    EXPECT_EQ(printed("local v = randn(1001)\n"
                      "local keep, seen, count = {}, {}, 0\n"
                      "for i = 1, 300 do\n"
                      "  keep[#keep + 1] = string.rep('x', 40 + i)\n"
                      "  local w = v + 0\n"
                      "  keep[#keep + 1] = w\n"
                      "  for _, x in ipairs{mean(w), sum(w), std(w), norm(w), dot(w, v)} do\n"
                      "    if not seen[x] then seen[x] = true; count = count + 1 end\n"
                      "  end\n"
                      "end\n"
                      "print(count)"),
              "5\n");
}

TEST(script_vectors, are_summed_up) {
    EXPECT_EQ(
        printed("local v = {4, 1, 3}\nprint(sum(v), mean(v), var(v), std{1, 3}^2, norm{3, 4}, dot({1, 2}, {3, 4}))"),
        "8\t2.666667\t2.333333\t2\t5\t11\n");
    EXPECT_EQ(
        printed("print(min{4, 1, 3})\nprint(max{4, 1, 3})\nprint(max({1, 5}, 3), min(2, 1), max({1, 5}, {2, 4}))"),
        "1\t2\n4\t1\n[3 5]\t1\t[2 5]\n");
    EXPECT_EQ(printed("print(cumsum{1, 2, 3}, diff{1, 4, 9}, (sort{3, 1, 2}), select(2, sort{3, 1, 2}))"),
              "[1 3 6]\t[3 5]\t[1 2 3]\t[2 3 1]\n");
    EXPECT_EQ(printed("print(abs{-1, 2}, sqrt{4, 9}, exp(0), log(1), sin(0), cos{0})"), "[1 2]\t[2 3]\t1\t0\t0\t[1]\n");
    EXPECT_EQ(
        printed("print(polyval({1, 2, 3}, 2), polyval({1, 0}, {1, 2}), interp1({0, 1, 2}, {0, 10, 0}, {0.5, 1.5, 2}))"),
        "11\t[1 2]\t[5 5 0]\n");
    EXPECT_EQ(error_of("interp1({0, 1}, {0, 1}, 2)"),
              "lesson.lua:1: interp1: interpolation at 2 is not possible, because x ranges from 0 to 1. To use the "
              "values of the end points outside this range, specify outside = \"hold\"");
}

TEST(script_vectors, form_matrices) {
    EXPECT_EQ(printed("local A = matrix{{1, 2}, {3, 4}}\nprint(A*A)\nprint(A:times(A))\nprint(A:t(), A*vector{1, 1})"),
              " 7  10\n15  22\n\n1   4\n9  16\n\n1  3\n2  4\t[3 7]\n");
    EXPECT_EQ(printed("local A = matrix{vector{1, 2}, vector{3, 4}}\nprint(A[{1, 2}], A:at(2, 1), A:row(1), A:col(1), "
                      "A.rows, A.columns)\n"
                      "A[{1, 2}] = 9\nA:set(2, 2, 8)\nprint(A)"),
              "3\t2\t[1 3]\t[1 2]\t2\t2\n1  9\n2  8\n");
    EXPECT_EQ(printed("print(solve(matrix{{2, 0}, {0, 4}}, {2, 4}), solve(matrix{{1}, {1}, {1}}, {1, 2, 3}))"),
              "[1 1]\t[2]\n");
    EXPECT_EQ(printed("print(eye(2) == matrix{{1, 0}, {0, 1}}, 2*eye(2) - eye(2) == eye(2), zeros(2, 3))"),
              "true\ttrue\t0  0  0\n0  0  0\n");
    EXPECT_EQ(
        error_of("local B = eye(2)*ones(3, 3)"),
        "lesson.lua:1: A * B needs as many columns in A as rows in B, but A is a 2 x 2 matrix and B is a 3 x 3 matrix");
    EXPECT_EQ(error_of("matrix{{1, 2}, {3}}"),
              "lesson.lua:1: matrix: argument 1 (rows or columns): row 2 has 1 value, but row 1 has 2; all rows must "
              "have the same length");
    EXPECT_EQ(error_of("local x = eye(2)[1]"),
              "lesson.lua:1: write an element of a matrix as A[{i, j}], a row as A:row(i), and a column as A:col(j), "
              "not as A[1]");
    EXPECT_EQ(error_of("eye(2):at(3, 1)"), "lesson.lua:1: at: row 3 does not exist: the valid numbers are 1 to 2");
}

TEST(script_vectors, print_short_forms) {
    EXPECT_EQ(printed("print(range(1, 100))"), "[1 2 3 4 ... 97 98 99 100] (100 values)\n");
    EXPECT_EQ(printed("print(6.0, 0.1, 1e300, -0/1, {1, 'a', b = {2}}, print, nil, 2^53)"),
              "6\t0.1\t1e+300\t0\t{1, \"a\", b = {2}}\tfunction\tnil\t9.007199254741e+15\n");
}

TEST(script_vectors, draw_the_specified_random_numbers) {
    // First normals of seed 1 from the specification (MT19937, 53-bit uniforms, Box-Muller in pairs).
    EXPECT_EQ(printed("rng(1)\nfor _, x in ipairs(randn(4)) do print(string.format('%.10f', x)) end"),
              "-0.1925803402\n-1.0208449868\n-0.0048841639\n0.0143145961\n");
    EXPECT_EQ(
        printed("rng(1) local a = randn(4) rng(1) local b = randn(2, 2)\nprint(a[3] == b:at(1, 2), #randn(5, 1))"),
        "true\t5\n");
    dynlab::RunOptions options;
    options.seed = 1;
    EXPECT_EQ(printed("print(string.format('%.10f', randn()))", options), "-0.1925803402\n");
    EXPECT_EQ(printed("local u = rand(1000)\nprint(min(u) >= 0 and max(u) < 1, math.random(3) <= 3)"), "true\ttrue\n");
}

TEST(script_vectors, walk_tables_in_a_repeatable_order) {
    EXPECT_EQ(printed("local t = {z = 1, a = 2, [3] = 3, 10, m = 4}\nfor k, v in pairs(t) do print(k, v) end"),
              "1\t10\n3\t3\na\t2\nm\t4\nz\t1\n");
}
TEST(script_vectors, extremes_pass_over_what_is_not_a_number) {
    EXPECT_EQ(printed("print(max(vector{0/0, 1, 3})) print(max(vector{3, 0/0, 1})) print(min(vector{0/0, 2, 1}))"),
              "3\t3\n3\t1\n1\t3\n");
    EXPECT_EQ(error_of("linspace(0, 1/0, 3)"),
              "lesson.lua:1: linspace: first and last must be finite numbers, but they are 0 and Inf");
}

TEST(script_vectors, matrix_rows_of_vectors_and_numbers_are_joined) {  // oracle: by hand
    EXPECT_EQ(printed("print(matrix{{vector{1, 2}, 3}, {4, 5, 6}})"), "1  2  3\n4  5  6\n");
    EXPECT_EQ(printed("print(matrix{{1, 2, 3}, {4, vector{5, 6}}})"), "1  2  3\n4  5  6\n");
    EXPECT_EQ(error_of("matrix{{vector{1, 2}, 3}, {4, 5}}"),
              "lesson.lua:1: matrix: argument 1 (rows or columns): row 2 has 2 values, but row 1 has 3; all rows must "
              "have the same length");
    EXPECT_EQ(
        error_of("matrix{{1, 'a'}}"),
        "lesson.lua:1: matrix: argument 1 (rows or columns), row 1 must be a vector of numbers, but its element 2 "
        "is the string \"a\"");
}

}  // namespace test_script_vectors
