#include "course/review/edit_script.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <span>

#include "platform/utf8.h"

namespace dynlab::inline course {
namespace {

bool is_letter(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalpha(byte);
}

std::string key_of_character(char32_t c, std::string_view bytes) {
    if (c == 0x2018 || c == 0x2019) return "'";
    if (c == 0x201C || c == 0x201D || c == 0xAB || c == 0xBB) return "\"";
    if (c == 0x2212 || c == 0x2013) return "-";
    if (c <= 0x20 || (c >= 0x7F && c <= 0xA0) || (c >= 0x2000 && c <= 0x200B) || c == 0x202F || c == 0xFEFF) return "";
    if (is_silent(c)) return "";
    if (c >= 0xFB00 && c <= 0xFB06) return folded_letter(c);
    return std::string(bytes);
}

using Items = std::span<const std::size_t>;

/// Ways from the beginnings of two lists. E. W. Myers, An O(ND) difference algorithm and its variations, Algorithmica 1
/// (1986), section 4: on the diagonal k stand the points (x, y), x items of `before` and y = x - k of `after`.
class WaySearch {
  public:
    WaySearch(Items before, Items after)
        : before_(before), after_(after), n_(static_cast<int>(before.size())), m_(static_cast<int>(after.size())) {}

    /// A shortest way to the ends, or the one of kMostEdits edits that leads furthest.
    std::string way() {
        for (int edits = 0;; ++edits) {
            furthest_.emplace_back(static_cast<std::size_t>(edits) + 1);
            int best = 0, most = -1;
            for (int k = -edits; k <= edits; k += 2) {
                int x = after_edit(edits, k);
                while (x < n_ && x - k < m_ &&
                       before_[static_cast<std::size_t>(x)] == after_[static_cast<std::size_t>(x - k)])
                    ++x;
                furthest(edits, k) = x;
                if (x <= n_ && x - k <= m_ && 2 * x - k > most) best = k, most = 2 * x - k;
            }
            if (most == n_ + m_ || edits == kMostEdits) return way_to(edits, best);
        }
    }

  private:
    int& furthest(int edits, int k) {
        return furthest_[static_cast<std::size_t>(edits)][static_cast<std::size_t>((k + edits) / 2)];
    }

    /// Whether the last edit on the way to this diagonal adds an item.
    bool adds(int edits, int k) {
        return k == -edits || (k != edits && furthest(edits - 1, k - 1) < furthest(edits - 1, k + 1));
    }

    /// The x that the last edit leads to, before what both lists have.
    int after_edit(int edits, int k) {
        if (edits == 0) return 0;
        return adds(edits, k) ? furthest(edits - 1, k + 1) : furthest(edits - 1, k - 1) + 1;
    }

    std::string way_to(int edits, int k) {
        std::string reversed;
        for (; edits >= 0; --edits) {
            reversed.append(static_cast<std::size_t>(furthest(edits, k) - after_edit(edits, k)), '=');
            if (edits == 0) break;
            const bool added = adds(edits, k);
            reversed += added ? '+' : '-';
            k += added ? 1 : -1;
        }
        return {reversed.rbegin(), reversed.rend()};
    }

    Items before_, after_;
    int n_, m_;
    std::vector<std::vector<int>> furthest_;  ///< x by the number of edits and the diagonal
};

/// Equal numbers for equal keys.
std::vector<std::size_t> numbered(const std::vector<std::string>& items, std::map<std::string, std::size_t>& numbers) {
    std::vector<std::size_t> numbered;
    for (const std::string& item : items)
        numbered.push_back(numbers.try_emplace(comparison_key(item), numbers.size()).first->second);
    return numbered;
}

}  // namespace

std::string comparison_key(const std::string& text) {
    std::string plain;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view before = rest;
        const char32_t c = next_character(rest);
        plain += key_of_character(c, before.substr(0, before.size() - rest.size()));
    }
    std::string key;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const bool inside =
            plain[i] == '-' && i > 0 && i + 1 < plain.size() && is_letter(plain[i - 1]) && is_letter(plain[i + 1]);
        if (!inside) key += plain[i];
    }
    return key;
}

std::string edit_script(const std::vector<std::string>& before, const std::vector<std::string>& after) {
    std::map<std::string, std::size_t> numbers;
    const std::vector<std::size_t> old_items = numbered(before, numbers), new_items = numbered(after, numbers);
    std::string script;
    for (Items old_rest = old_items, new_rest = new_items; !old_rest.empty() || !new_rest.empty();) {
        const std::string piece = WaySearch(old_rest, new_rest).way();
        const auto added = static_cast<std::size_t>(std::count(piece.begin(), piece.end(), '+'));
        const auto removed = static_cast<std::size_t>(std::count(piece.begin(), piece.end(), '-'));
        old_rest = old_rest.subspan(piece.size() - added), new_rest = new_rest.subspan(piece.size() - removed);
        script += piece;
    }
    return script;
}

}  // namespace dynlab::inline course
