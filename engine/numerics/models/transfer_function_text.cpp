#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "numerics/models/transfer_function.h"

namespace dynlab::inline numerics {

namespace {

enum class Notation { kPlain, kLatex };

/// In LaTeX 1.5e-06 is 1.5 \cdot 10^{-6}.
std::string number_in(Notation notation, double value, int significant_digits) {
    const std::string number = number_text(value, significant_digits);
    const std::size_t power = number.find('e');
    if (notation == Notation::kPlain || power == std::string::npos) return number;
    return number.substr(0, power) + " \\cdot 10^{" + std::to_string(std::stoi(number.substr(power + 1))) + "}";
}

std::string power_in(Notation notation, const std::string& variable, Index exponent) {
    if (exponent == 1) return variable;
    const std::string digits = std::to_string(exponent);
    return variable + "^" + (notation == Notation::kLatex ? "{" + digits + "}" : digits);
}

std::string polynomial_text(const Vector& p, const std::string& variable, int significant_digits, Notation notation) {
    std::string text;
    for (Index i = 0; i < p.size(); ++i) {
        if (p(i) == 0) continue;
        if (text.empty())
            text = p(i) < 0 ? "-" : "";
        else
            text += p(i) < 0 ? " - " : " + ";
        const Index exponent = p.size() - 1 - i;
        const std::string number = number_in(notation, std::abs(p(i)), significant_digits);
        if (exponent == 0)
            text += number;
        else
            text += (number == "1" ? "" : number + " ") + power_in(notation, variable, exponent);
    }
    return text.empty() ? "0" : text;
}

std::string delay_text(const TransferFunction& G, int significant_digits) {
    if (G.delay() == 0) return "";
    if (G.continuous()) return "exp(-" + number_text(G.delay(), significant_digits) + " s) ";
    return "z^-" + std::to_string(std::lround(G.delay() / G.Ts())) + " ";
}

std::string latex_delay(const TransferFunction& G, int significant_digits) {
    if (G.delay() == 0) return "";
    if (!G.continuous()) return " z^{-" + std::to_string(std::lround(G.delay() / G.Ts())) + "}";
    return " e^{-" + number_in(Notation::kLatex, G.delay(), significant_digits) + " s}";
}

std::string centered(const std::string& text, std::size_t margin, std::size_t width) {
    return std::string(margin + (width - text.size()) / 2, ' ') + text;
}

}  // namespace

std::string to_text(const TransferFunction& G, int significant_digits) {
    const std::string variable = G.continuous() ? "s" : "z";
    const std::string num = polynomial_text(G.num(), variable, significant_digits, Notation::kPlain);
    const std::string den = polynomial_text(G.den(), variable, significant_digits, Notation::kPlain);
    const std::string delay = delay_text(G, significant_digits);
    const std::size_t width = std::max(num.size(), den.size());
    std::string fraction = delay + std::string(width, '-');
    if (!G.continuous()) fraction += "   Ts = " + number_text(G.Ts(), significant_digits) + " s";
    return centered(num, delay.size(), width) + "\n" + fraction + "\n" + centered(den, delay.size(), width);
}

std::string to_latex(const TransferFunction& G, int significant_digits) {
    const std::string variable = G.continuous() ? "s" : "z";
    const std::string num = polynomial_text(G.num(), variable, significant_digits, Notation::kLatex);
    const std::string den = polynomial_text(G.den(), variable, significant_digits, Notation::kLatex);
    const std::string fraction = den == "1" ? num : "\\frac{" + num + "}{" + den + "}";
    const std::string time =
        G.continuous() ? ""
                       : ",\\quad T_s = " + number_in(Notation::kLatex, G.Ts(), significant_digits) + "\\,\\mathrm{s}";
    return "G(" + variable + ") = " + fraction + latex_delay(G, significant_digits) + time;
}

}  // namespace dynlab::inline numerics
