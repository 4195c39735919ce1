#pragma once
#include <filesystem>
#include <string>

namespace dynlab::inline course {

/// The language of what was handed in, "en" or "fr": that of the header of report.md (`lang: fr`), else that of
/// analysis.lua (`language: fr`). Empty where neither can be read.
std::string language_of_work(const std::filesystem::path& folder);

}  // namespace dynlab::inline course
