#include "base/catalog.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

namespace dynlab::inline base {
namespace {

/// The C expressions that plural rules use: ?:, ||, &&, comparisons, + - * / %, !, parentheses, n and numbers.
class Expression {
  public:
    Expression(std::string_view text, std::int64_t n) : text_(text), n_(n) {}

    std::int64_t value() {
        const std::int64_t result = choice();
        if (!rest().empty()) fail();
        return result;
    }

  private:
    std::string_view rest() {
        while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\t')) text_.remove_prefix(1);
        return text_;
    }
    bool take(std::string_view sign) {
        if (!rest().starts_with(sign)) return false;
        text_.remove_prefix(sign.size());
        return true;
    }
    [[noreturn]] void fail() const {
        throw std::runtime_error("the plural rule cannot be read from \"" + std::string(text_) + "\"");
    }

    std::int64_t choice() {
        const std::int64_t condition = operation(0);
        if (!take("?")) return condition;
        const std::int64_t yes = choice();
        if (!take(":")) fail();
        const std::int64_t no = choice();
        return condition != 0 ? yes : no;
    }

    struct Operator {
        std::string_view sign;
        int level;
        std::int64_t (*apply)(std::int64_t, std::int64_t);
    };

    /// Of that level of precedence or a higher one.
    std::int64_t operation(int level) {
        using I = std::int64_t;
        static constexpr Operator kOperators[] = {{"||", 0, [](I a, I b) -> I { return a != 0 || b != 0; }},
                                                  {"&&", 1, [](I a, I b) -> I { return a != 0 && b != 0; }},
                                                  {"==", 2, [](I a, I b) -> I { return a == b; }},
                                                  {"!=", 2, [](I a, I b) -> I { return a != b; }},
                                                  {"<=", 3, [](I a, I b) -> I { return a <= b; }},
                                                  {">=", 3, [](I a, I b) -> I { return a >= b; }},
                                                  {"<", 3, [](I a, I b) -> I { return a < b; }},
                                                  {">", 3, [](I a, I b) -> I { return a > b; }},
                                                  {"+", 4, [](I a, I b) -> I { return a + b; }},
                                                  {"-", 4, [](I a, I b) -> I { return a - b; }},
                                                  {"*", 5, [](I a, I b) -> I { return a * b; }},
                                                  {"/", 5, [](I a, I b) -> I { return b == 0 ? 0 : a / b; }},
                                                  {"%", 5, [](I a, I b) -> I { return b == 0 ? 0 : a % b; }}};
        if (level > 5) return operand();
        std::int64_t left = operation(level + 1);
        for (bool more = true; more;) {
            more = false;
            for (const Operator& binary : kOperators) {
                if (binary.level != level || !take(binary.sign)) continue;
                left = binary.apply(left, operation(level + 1));
                more = true;
                break;
            }
        }
        return left;
    }

    std::int64_t operand() {
        if (take("!")) return operand() == 0;
        if (take("n")) return n_;
        if (take("(")) {
            if (++depth_ > 20) fail();
            const std::int64_t inner = choice();
            --depth_;
            if (!take(")")) fail();
            return inner;
        }
        std::int64_t number = 0;
        const std::string_view digits = rest();
        const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (end.ec != std::errc()) fail();
        text_.remove_prefix(static_cast<std::size_t>(end.ptr - digits.data()));
        return number;
    }

    std::string_view text_;
    std::int64_t n_;
    int depth_ = 0;
};

/// What follows "KEY=" up to the next semicolon.
std::string_view value_of(std::string_view header, std::string_view key) {
    const std::size_t at = header.find(std::string(key) + "=");
    if (at == header.npos) throw std::runtime_error("Plural-Forms has no \"" + std::string(key) + "=\"");
    const std::string_view value = header.substr(at + key.size() + 1);
    return value.substr(0, value.find(';'));
}

/// One entry of a PO file, while its lines are read.
struct Entry {
    std::string context, id;
    std::vector<std::string> forms;
    bool has_context = false, fuzzy = false;
};

/// Lines of a PO file, entry by entry.
class PoReader {
  public:
    explicit PoReader(std::string_view text) : text_(text) {}

    /// False at the end of the file.
    bool next(Entry& entry) {
        entry = {};
        std::string* place = nullptr;
        bool begun = false;
        for (; begin_ < text_.size(); begin_ = end_ + 1, ++line_) {
            end_ = std::min(text_.find('\n', begin_), text_.size());
            std::string_view line = text_.substr(begin_, end_ - begin_);
            if (line.ends_with('\r')) line.remove_suffix(1);
            if (line.empty() || line.starts_with('#')) {
                if (!entry.forms.empty()) return true;
                if (line.starts_with("#,") && line.find("fuzzy") != line.npos) entry.fuzzy = true;
                continue;
            }
            if (line.starts_with("msg")) {
                const bool starts_entry = line.starts_with("msgctxt ") || line.starts_with("msgid ");
                if (starts_entry && !entry.forms.empty()) return true;
                begun = true;
                place = place_of(entry, line);
            }
            if (place == nullptr) fail("expected msgid, msgstr or a comment");
            add_quoted(*place, line);
        }
        if (begun && entry.forms.empty()) fail("an entry without msgstr");
        return begun;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
    }

    std::string* place_of(Entry& entry, std::string_view& line) {
        const std::size_t space = std::min(line.find(' '), line.size());
        const std::string_view keyword = line.substr(0, space);
        line.remove_prefix(space);
        if (keyword == "msgctxt") {
            entry.has_context = true;
            return &entry.context;
        }
        if (keyword == "msgid") return &entry.id;
        if (keyword == "msgid_plural") return &unused_;
        if (!keyword.starts_with("msgstr")) fail("unknown keyword \"" + std::string(keyword) + "\"");
        const bool numbered = keyword != "msgstr";
        if (numbered && keyword != "msgstr[" + std::to_string(entry.forms.size()) + "]")
            fail("plural forms must be numbered from 0");
        return &entry.forms.emplace_back();
    }

    void add_quoted(std::string& text, std::string_view line) const {
        const std::size_t begin = line.find_first_not_of(' ');
        if (begin == line.npos || line[begin] != '"' || line.size() < begin + 2 || line.back() != '"')
            fail("expected text in quotation marks");
        const std::string_view inner = line.substr(begin + 1, line.size() - begin - 2);
        for (std::size_t i = 0; i < inner.size(); ++i) {
            if (inner[i] == '"') fail("a quotation mark inside text needs a backslash");
            if (inner[i] != '\\') {
                text += inner[i];
                continue;
            }
            if (++i == inner.size()) fail("text ends with a backslash");
            const char escaped = inner[i];
            if (escaped != 'n' && escaped != 't' && escaped != '"' && escaped != '\\') fail("unknown escape in text");
            text += escaped == 'n' ? '\n' : escaped == 't' ? '\t' : escaped;
        }
    }

    std::string_view text_;
    std::size_t begin_ = 0, end_ = 0;
    int line_ = 1;
    std::string unused_;
};

std::string key(std::string_view id, std::string_view context) {
    return context.empty() ? std::string(id) : std::string(context) + '\4' + std::string(id);
}

}  // namespace

PluralRule::PluralRule(std::string_view header) {
    const std::string_view forms = value_of(header, "nplurals");
    if (std::from_chars(forms.data(), forms.data() + forms.size(), forms_).ec != std::errc() || forms_ == 0 ||
        forms_ > 6)
        throw std::runtime_error("nplurals must be 1 to 6, and is \"" + std::string(forms) + "\"");
    expression_ = value_of(header, "plural");
    for (std::int64_t n = 0; n < 200; ++n) form(n);
}

std::size_t PluralRule::form(std::int64_t count) const {
    const std::int64_t chosen = Expression(expression_, count < 0 ? -count : count).value();
    if (chosen < 0 || static_cast<std::size_t>(chosen) >= forms_)
        throw std::runtime_error("the plural rule gives form " + std::to_string(chosen) + " of " +
                                 std::to_string(forms_));
    return static_cast<std::size_t>(chosen);
}

Catalog::Catalog(std::string_view po_text) {
    PoReader reader(po_text);
    for (Entry entry; reader.next(entry);) {
        if (entry.id.empty() && !entry.has_context) {
            const std::string_view header = entry.forms.front();
            if (const std::size_t at = header.find("Plural-Forms:"); at != header.npos)
                rule_ = PluralRule(header.substr(at, header.find('\n', at) - at));
            continue;
        }
        bool whole = !entry.fuzzy;
        for (const std::string& form : entry.forms) whole = whole && !form.empty();
        if (whole) forms_[key(entry.id, entry.context)] = std::move(entry.forms);
    }
}

std::span<const std::string> Catalog::forms(std::string_view id, std::string_view context) const {
    const auto found = context.empty() ? forms_.find(id) : forms_.find(key(id, context));
    return found == forms_.end() ? std::span<const std::string>() : std::span<const std::string>(found->second);
}

std::string_view Catalog::translation(std::string_view id, std::string_view context) const {
    const std::span<const std::string> found = forms(id, context);
    return found.empty() ? std::string_view() : found.front();
}

std::string_view Catalog::plural(std::string_view id, std::int64_t count) const {
    const std::span<const std::string> found = forms(id);
    if (found.empty()) return {};
    const std::size_t form = rule_.form(count);
    return form < found.size() ? std::string_view(found[form]) : std::string_view();
}

std::string Catalog::decimal_sign() const {
    const std::string_view sign = translation(marked("decimal sign", "."), "decimal sign");
    return std::string(sign.empty() ? "." : sign);
}

std::string Catalog::list_separator(std::string_view english) const {
    const std::string_view other = translation(english, "list");
    return std::string(other.empty() ? english : other);
}

}  // namespace dynlab::inline base
