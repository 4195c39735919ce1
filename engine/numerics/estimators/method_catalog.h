#pragma once
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline numerics {

enum class TimeDomain { kContinuous, kDiscrete, kStatic };

/// One method of the folder: where it lives, how scripts call it, and what it is for.
struct MethodEntry {
    /// estimators/FILE.{h,cpp}, tests/unit/estimators/test_FILE.cpp; a family has a separate folder: "recursive/rlssvf"
    /// means estimators/recursive/rlssvf.{h,cpp} and tests/unit/estimators/recursive/test_rlssvf.cpp.
    std::string file;
    std::vector<std::string> lua_names;  ///< the first one has the help page, the others may share it
    std::string title;                   ///< half a sentence
    std::string structure;               ///< of the model it fits
    TimeDomain domain;
    std::string noise;      ///< assumption under which its estimates are the best ones
    std::string reference;  ///< book or paper
};

/// All methods, in the order a course meets them.
const std::vector<MethodEntry>& method_catalog();

/// The entry with this Lua name, or nothing.
std::optional<MethodEntry> find_method(const std::string& lua_name);

}  // namespace dynlab::inline numerics
