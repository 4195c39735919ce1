#pragma once
#include <filesystem>
#include <vector>

#include "base/message.h"
#include "data_io/variable.h"

namespace dynlab::inline data_io {

/// Reads a MATLAB file (v4, v5, v7, v7.3): numeric arrays of every class, logical, complex, char, struct, cell.
/// Integers and single precision become double (64-bit integers beyond 2^53 are rounded), a logical scalar a bool,
/// a logical array a Vector or Matrix of 0 and 1, a char array of several rows a list of its rows without trailing
/// blanks, [] an empty Vector. A variable that cannot be represented (table, object, function handle, sparse, more than
/// two dimensions) is left out, and a sentence that names it and the reason goes into `left_out`. Throws
/// EnvironmentError that names the file and the reason: not there, not a MAT file, of an unknown version, cut off,
/// damaged, or no variable of it can be represented.
///
/// `guarded`: a forked copy of this process with limits (memory as in reading_memory.h, 3 s) reads the file, so that a
/// damaged one can neither crash nor hang the caller; costs a few milliseconds. The copy opens no other file: what a
/// v7.3 file (HDF5) links to outside of itself is left out. Works from any program. Only files that ship with dynlab
/// need no guard. Not to be called from several threads at once (libmatio and HDF5 keep global state).
VariableTable read_mat_file(const std::filesystem::path& file, bool guarded = true,
                            std::vector<Message>* left_out = nullptr);

/// Writes MAT v5 (compressed; arrays of more than half a million numbers quickly, or not at all where it would save
/// next to nothing, as with noise), whole or not at all, the same bytes for the same variables. Vectors are written as
/// columns, lists as cell columns; real numbers are rounded to `digits` significant digits (17 keep every bit). Throws
/// InvalidArgument for a name MATLAB does not allow (letter first, then letters, digits and _, at most 63),
/// EnvironmentError when the file cannot be written.
void write_mat_file(const std::filesystem::path& file, const VariableTable& variables, int digits = 17);

}  // namespace dynlab::inline data_io
