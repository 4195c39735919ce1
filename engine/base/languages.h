#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/catalog.h"

namespace dynlab::inline base {

/// A catalog of engine/po, compiled into the program: "fr.po".
struct PoFile {
    std::string_view name, text;
};
std::span<const PoFile> po_files();

/// The languages that messages can be read in, by their codes: "en", which needs no catalog, then all with one.
std::vector<std::string> languages();
bool is_language(std::string_view code);

/// The catalog of a language, read at its first use; nullptr, and thus English, for "en", for a language without one,
/// and for one that cannot be read, which is reported once on the error output. Safe to call from several threads.
const Catalog* catalog_of(std::string_view language);

/// Why catalog_of() is nullptr for a language that is not English; empty where it is not.
std::string missing_catalog(std::string_view language);

/// One more language, or another catalog of one, by the text of its PO file: for translators and tests. Before its
/// first use.
void add_language(const std::string& code, const std::string& po_text);

}  // namespace dynlab::inline base
