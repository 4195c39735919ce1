#pragma once
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "numerics/signals/iddata.h"

namespace dynlab::test {

/// The 1000 input and 1000 output samples (means kept, 0.08 s apart) that the Debian package libslicot-doc gives as the
/// example of SLICOT's subspace identification. The file does not name its source; levels 3.41 and 6.41 of the binary
/// input and the outputs are those of the laboratory hair dryer of Ljung (1999).
inline IdData hair_dryer() {
    const std::string path = "/usr/share/doc/libslicot-doc/examples/fortran77/IB01AD.dat.gz";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(("gzip -dc " + path).c_str(), "r"), pclose);
    if (!pipe) throw std::runtime_error("cannot run gzip");
    std::string text;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe.get())) text.append(buffer, count);
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);  // title
    std::getline(lines, line);  // settings of the example program
    Vector values(2000);
    for (double& value : values)
        if (!(lines >> value)) throw std::runtime_error("cannot read " + path + ": install libslicot-doc");
    return IdData(Matrix(values.tail(1000)), Matrix(values.head(1000)), 0.08);
}

}  // namespace dynlab::test
