#pragma once
#include <string>

namespace dynlab::inline workflow {

/// Of what must be equal on all machines that take part, so that results are: the program, what it was compiled for,
/// and the lessons, data and templates that it finds. Contents count, not dates. Takes about 0.1 s.
std::string shared_identity();

}  // namespace dynlab::inline workflow
