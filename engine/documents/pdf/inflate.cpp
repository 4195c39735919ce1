#include "documents/pdf/inflate.h"

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/filter/zlib.hpp>
#include <boost/iostreams/filtering_stream.hpp>

namespace dynlab::inline documents {

Inflated inflate(std::string_view compressed, std::size_t most) {
    namespace io = boost::iostreams;
    Inflated result;
    try {
        io::filtering_istream in;
        in.push(io::zlib_decompressor());
        in.push(io::array_source(compressed.data(), compressed.size()));
        in.exceptions(std::ios::badbit);
        char block[1 << 15];
        while (result.bytes.size() < most && in.read(block, sizeof block).gcount() > 0)
            result.bytes.append(block, static_cast<std::size_t>(in.gcount()));
        result.whole = result.bytes.size() < most;
    } catch (const std::exception&) {
        result.whole = false;  // What was read before the damage counts.
    }
    return result;
}

}  // namespace dynlab::inline documents
