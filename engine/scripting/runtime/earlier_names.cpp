#include "scripting/runtime/earlier_names.h"

#include <algorithm>
#include <array>

namespace dynlab::inline scripting {
namespace {

struct RenamedFunction {
    std::string_view earlier, present;
};
constexpr std::array kRenamedFunctions = {
    RenamedFunction{"guess", "predict_first"}, RenamedFunction{"outcome", "reveal"}, RenamedFunction{"rig", "plant"},
    RenamedFunction{"rig_truth", "true_model"}, RenamedFunction{"declare_rig", "declare_plant"}};

}  // namespace

std::string_view present_name(std::string_view earlier) {
    const auto found = std::ranges::find(kRenamedFunctions, earlier, &RenamedFunction::earlier);
    return found == kRenamedFunctions.end() ? std::string_view() : found->present;
}

Message renamed(std::string_view earlier) {
    return Message("{} is now called {}; the earlier name works until the end of 2027", std::string(earlier),
                   std::string(present_name(earlier)));
}

}  // namespace dynlab::inline scripting
