#pragma once
#include "support/program.h"

namespace dynlab::bench {

/// Throws what the program printed when it failed.
void must_succeed(const ChildResult& result);

/// Writes the folder "six", whose report has six pages, and makes it.
void make_six_pages(const test::Workbench& bench);

}  // namespace dynlab::bench
