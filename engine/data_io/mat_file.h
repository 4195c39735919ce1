#pragma once
#include <filesystem>

#include "data_io/variable.h"

namespace dynlab {

/// Reads a MATLAB file (v4, v5, v7, v7.3): numeric arrays of every class, logical, complex, char, struct,
/// cell. Throws EnvironmentError that names the file and the reason: not there, not a MAT file, cut off, or a
/// variable of a class that cannot be read (table, object, function handle, sparse), named. `guarded`: the
/// file is read by a child process with limits (2 GiB, 3 s), so that a damaged one can neither crash nor hang
/// the caller.
VariableTable read_mat_file(const std::filesystem::path& file, bool guarded = true);

/// Writes MAT v5 (compressed), whole or not at all.
void write_mat_file(const std::filesystem::path& file, const VariableTable& variables);

/// Entry of the child process that read_mat_file starts (the program calls itself with this hidden command):
/// reads `file`, writes the variables in a private binary form to standard output, returns the exit code.
int mat_reader_main(const std::filesystem::path& file);

}  // namespace dynlab
