#pragma once
#include <matio.h>

#include <memory>
#include <string>

#include "data_io/variable.h"

namespace dynlab::inline data_io {

struct MatVariableDeleter {
    void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatVariable = std::unique_ptr<matvar_t, MatVariableDeleter>;

struct MatFileDeleter {
    void operator()(mat_t* file) const { Mat_Close(file); }
};
using MatFile = std::unique_ptr<mat_t, MatFileDeleter>;

/// Loads libmatio unless it is loaded: before processes are forked that read one file each. Throws EnvironmentError
/// when it is not there.
void load_matio();

/// Looks at a variable whose header has been read, before its data are: throws EnvironmentError when it or a part
/// of it is of a class that cannot be represented, or claims more values than a file of `file_bytes` bytes can hold
/// (unless it may `link` to other places, as HDF5 does) or than reading may turn into numbers in memory.
void check_mat_header(const matvar_t& variable, const std::string& name, std::size_t file_bytes, bool links);

/// libmatio's variable as ours. `name` is for messages: throws EnvironmentError "variable NAME is ..." when it
/// cannot be represented or is inconsistent.
Variable from_mat(const matvar_t& variable, const std::string& name);

/// The other way; lists become cell columns, real numbers are rounded to `digits` significant digits. The numbers of
/// real arrays that keep all 17 stay where they are, so `variable` must live as long as the result. Throws
/// InvalidArgument for a name MATLAB does not allow.
MatVariable to_mat(const Variable& variable, const std::string& name, int digits = 17);

}  // namespace dynlab::inline data_io
