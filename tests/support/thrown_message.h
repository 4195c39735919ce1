#pragma once
#include <string>

#include "numerics/error.h"

namespace dynlab {

/// What the InvalidArgument says that `call` throws; empty when it throws none.
template <class Call>
std::string thrown_message(Call call) {
    try {
        call();
    } catch (const InvalidArgument& error) {
        return error.what();
    }
    return "";
}

}  // namespace dynlab
