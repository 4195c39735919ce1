#include "data_io/packaged_data.h"

#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <fstream>
#include <limits>

#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
    std::error_code error;
    return fs::exists(file, error);
}

[[noreturn]] void refuse_missing(const PackagedData& packaged) {
    if (is_there(fs::path("/var/lib/dpkg/info") / (packaged.package + ".list")))
        throw EnvironmentError(
            "the package {} is installed, but its file {} is missing: this system excludes documentation (see "
            "/etc/dpkg/dpkg.cfg.d). Include the file there, then run sudo apt-get install --reinstall {}",
            packaged.package, packaged.file.string(), packaged.package);
    throw EnvironmentError(
        "this data set is part of the Debian package {}, which is not installed: run sudo apt-get install {}",
        packaged.package, packaged.package);
}

/// Reads as many numbers as the data set has samples; `what` names them in messages.
Vector next_values(std::istream& text, const PackagedData& packaged, const Message& what) {
    Vector values(packaged.samples);
    for (Index k = 0; k < packaged.samples; ++k)
        if (!(text >> values[k]))
            throw EnvironmentError("{} ends early or contains text at {} sample {} of {}: reinstall the package {}",
                                   packaged.file.string(), what, k + 1, packaged.samples, packaged.package);
    return values;
}

}  // namespace

VariableTable read_packaged_data(const PackagedData& packaged) {
    if (!is_there(packaged.file)) refuse_missing(packaged);
    std::ifstream packed(packaged.file, std::ios::binary);
    boost::iostreams::filtering_istream text;
    text.push(boost::iostreams::gzip_decompressor());
    text.push(packed);
    for (int line = 0; line < 2; ++line) text.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    VariableTable variables;
    variables["u"] = {next_values(text, packaged, Message("input"))};
    variables["y"] = {next_values(text, packaged, Message("output"))};
    variables["Ts"] = {packaged.Ts};
    return variables;
}

}  // namespace dynlab::inline data_io
