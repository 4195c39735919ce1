#pragma once
#include <string>

namespace dynlab {

/// The running program by size and time of writing: hashing megabytes would cost more than a whole report.
std::string program_identity();

}  // namespace dynlab
