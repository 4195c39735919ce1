#include <algorithm>
#include <cmath>

#include "numerics/models/transfer_function.h"
#include "numerics/number_text.h"

namespace dynlab::inline numerics {

namespace {

std::string term_text(double magnitude, Index exponent, const std::string& variable, int significant_digits) {
    const std::string number = number_text(magnitude, significant_digits);
    if (exponent == 0) return number;
    const std::string power = exponent == 1 ? variable : variable + "^" + std::to_string(exponent);
    return number == "1" ? power : number + " " + power;
}

std::string polynomial_text(const Vector& p, const std::string& variable, int significant_digits) {
    std::string text;
    for (Index i = 0; i < p.size(); ++i) {
        if (p(i) == 0) continue;
        if (text.empty())
            text = p(i) < 0 ? "-" : "";
        else
            text += p(i) < 0 ? " - " : " + ";
        text += term_text(std::abs(p(i)), p.size() - 1 - i, variable, significant_digits);
    }
    return text.empty() ? "0" : text;
}

std::string delay_text(const TransferFunction& G, int significant_digits) {
    if (G.delay() == 0) return "";
    if (G.continuous()) return "exp(-" + number_text(G.delay(), significant_digits) + " s) ";
    return "z^-" + std::to_string(std::lround(G.delay() / G.Ts())) + " ";
}

std::string centred(const std::string& text, std::size_t margin, std::size_t width) {
    return std::string(margin + (width - text.size()) / 2, ' ') + text;
}

}  // namespace

std::string to_text(const TransferFunction& G, int significant_digits) {
    const std::string variable = G.continuous() ? "s" : "z";
    const std::string num = polynomial_text(G.num(), variable, significant_digits);
    const std::string den = polynomial_text(G.den(), variable, significant_digits);
    const std::string delay = delay_text(G, significant_digits);
    const std::size_t width = std::max(num.size(), den.size());
    std::string fraction = delay + std::string(width, '-');
    if (!G.continuous()) fraction += "   Ts = " + number_text(G.Ts(), significant_digits) + " s";
    return centred(num, delay.size(), width) + "\n" + fraction + "\n" + centred(den, delay.size(), width);
}

}  // namespace dynlab::inline numerics
