#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline course {

/// What was said in a box about work that lay in `folder` there, as its author may be told it: files by their names in
/// the work ("analysis.lua:98: ..."), without the program's name in front.
std::string told_outside(const std::string& said, const std::filesystem::path& folder);

/// With a full stop, unless a sign that ends a sentence is there.
std::string as_sentence(std::string text);

}  // namespace dynlab::inline course
