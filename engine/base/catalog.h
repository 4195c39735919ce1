#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace dynlab::inline base {

/// Marks an id that is looked up in a context, for xgettext.
constexpr const char* marked(const char* /*context*/, const char* english) {
    return english;
}

/// The rule by which a language chooses among its plural forms: the C expression in `n` of a catalog's header.
class PluralRule {
  public:
    /// "nplurals=2; plural=n > 1;". Throws std::runtime_error that quotes what it cannot read.
    explicit PluralRule(std::string_view header = "nplurals=2; plural=n != 1;");

    /// The index of the plural form for the count; below forms().
    std::size_t form(std::int64_t count) const;
    std::size_t forms() const { return forms_; }

  private:
    std::size_t forms_ = 2;
    std::string expression_;
};

/// The translations of one language: a file in gettext's PO format (engine/po). It is read without the system's
/// locales, as one process may serve readers of two languages. Fuzzy, obsolete and empty entries are left out.
///
/// References: GNU gettext manual, "The Format of PO Files", "Plural forms".
class Catalog {
  public:
    /// Nothing is translated.
    Catalog() = default;

    /// Throws std::runtime_error with the line of what is no PO file.
    explicit Catalog(std::string_view po_text);

    /// The text for an id, in a context or none; empty where there is none.
    std::string_view translation(std::string_view id, std::string_view context = {}) const;
    /// The form for a count.
    std::string_view plural(std::string_view id, std::int64_t count) const;
    /// All plural forms, or the one text, of an id in a context or none; empty where there is none.
    std::span<const std::string> forms(std::string_view id, std::string_view context = {}) const;
    const PluralRule& rule() const { return rule_; }

    /// The sign between a number's integer part and its decimals: the entry "." of the context "decimal sign".
    std::string decimal_sign() const;
    /// The translation of ", ", " and ", " or ", "; " in lists: entries of the context "list".
    std::string list_separator(std::string_view english) const;

    std::size_t size() const { return forms_.size(); }

  private:
    struct Hash : std::hash<std::string_view> {
        using is_transparent = void;
    };
    std::unordered_map<std::string, std::vector<std::string>, Hash, std::equal_to<>> forms_;
    PluralRule rule_;
};

}  // namespace dynlab::inline base
