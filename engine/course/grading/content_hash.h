#pragma once
#include <string>

#include "course/hand_ins/submission.h"

namespace dynlab::inline course {

/// SHA-256 of all that was handed in, names and contents. Of what is too large to be graded its size alone: reading it
/// may take for ever. Throws what the file system does where something cannot be looked into.
std::string hash_of_content(const Submission& submission);

}  // namespace dynlab::inline course
