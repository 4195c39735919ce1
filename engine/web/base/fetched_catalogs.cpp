#include "base/languages.h"

namespace dynlab::inline base {

/// A page brings the catalog of its language by add_language().
std::span<const PoFile> po_files() {
    return {};
}

}  // namespace dynlab::inline base
