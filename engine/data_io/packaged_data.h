#pragma once
#include <filesystem>
#include <string>

#include "data_io/variable.h"

namespace dynlab::inline data_io {

/// A measured data set of one input and one output that a Debian package contains as the input of an example program of
/// the SLICOT library: gzipped text with a line of title and a line of settings, then the inputs, then the outputs,
/// then any text.
struct PackagedData {
    std::string package;
    std::filesystem::path file;
    Index samples = 0;
    double Ts = 0;  ///< s
};

/// Vectors u and y and the number Ts. Throws EnvironmentError that says how to install the package when the file is not
/// there, and for a file that is damaged or too short.
VariableTable read_packaged_data(const PackagedData& packaged);

}  // namespace dynlab::inline data_io
