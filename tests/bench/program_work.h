#pragma once
#include "support/program.h"

namespace dynlab::bench {

/// All of lesson 4's answers but the Monte Carlo study's.
inline constexpr const char* kSubmissionOfLesson4 =
    "local u = prbs(4, 100)\nlocal x = lsim(tf({2}, {1, 4, 3}), u, 0.01)\n"
    "local data = iddata(x + 0.2*randn(#u), u, 0.01)\n"
    "answer('own_without_noise', lssvf(iddata(x, u, 0.01), {2, 1, 0}, 3).param)\n"
    "answer('own', lssvf(data, {2, 1, 0}, 3).param)\nanswer('record', data)\n"
    "answer('G_lssvf', lssvf(data, {2, 1, 0}, 3))\nanswer('G_ivsvf', ivsvf(data, {2, 1, 0}, 3))\n"
    "answer('G_final', tfsrivc(data, 2, 0, {TdMax = 0}))\n";

/// Throws what the program printed when it failed.
void must_succeed(const ChildResult& result);

/// Writes the folder "six", whose report has six pages, and makes it.
void make_six_pages(const test::Workbench& bench);

}  // namespace dynlab::bench
