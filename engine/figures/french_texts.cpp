#include "figures/french_texts.h"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "figures/figure.h"

namespace dynlab::inline figures {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

/// Whole texts of the standard plots; those of axes without their unit.
constexpr std::array kTexts = {
    Words{"best model at each delay", "meilleur modèle à chaque retard"},
    Words{"beyond the bound", "hors de la borne"},
    Words{"by hand", "à la main"},
    Words{"by the standard error", "d'après l'erreur type"},
    Words{"chosen", "retenu"},
    Words{"delay", "retard"},
    Words{"distortion", "distorsion"},
    Words{"estimate", "estimation"},
    Words{"estimation data", "données d'estimation"},
    Words{"even lines without input", "raies paires sans entrée"},
    Words{"final level", "niveau final"},
    Words{"final value", "valeur finale"},
    Words{"first peak", "premier pic"},
    Words{"fit", "adéquation"},
    Words{"fit of the simulation", "adéquation de la simulation"},
    Words{"forecast", "prévision"},
    Words{"frequency", "fréquence"},
    Words{"imaginary axis", "axe imaginaire"},
    Words{"imaginary part", "partie imaginaire"},
    Words{"impulse response", "réponse impulsionnelle"},
    Words{"initial value", "valeur initiale"},
    Words{"input", "entrée"},
    Words{"lag", "décalage"},
    Words{"level", "niveau"},
    Words{"loss", "perte"},
    Words{"magnitude", "module"},
    Words{"mean square error", "erreur quadratique moyenne"},
    Words{"measured", "mesuré"},
    Words{"no zero", "sans zéro"},
    Words{"noise", "bruit"},
    Words{"number of parameters", "nombre de paramètres"},
    Words{"number of poles", "nombre de pôles"},
    Words{"odd lines without input", "raies impaires sans entrée"},
    Words{"output", "sortie"},
    Words{"part left out", "partie écartée"},
    Words{"poles", "pôles"},
    Words{"power of the output", "puissance de la sortie"},
    Words{"real axis", "axe réel"},
    Words{"real part", "partie réelle"},
    Words{"reference", "consigne"},
    Words{"simulated", "simulé"},
    Words{"simulation", "simulation"},
    Words{"smoothed", "lissé"},
    Words{"time", "temps"},
    Words{"true value", "vraie valeur"},
    Words{"unstable", "instable"},
    Words{"validation data", "données de validation"},
    Words{"validation fit", "adéquation en validation"},
    Words{"zeros", "zéros"},
    Words{"±5 % band", "bande de ±5 %"},
};

/// How texts begin that go on with the name of a channel or a number.
constexpr std::array kBeginnings = {
    Words{"Cramér–Rao ellipse, ", "ellipse de Cramér–Rao, "},
    Words{"autocorrelation of the error in ", "autocorrélation de l'erreur de "},
    Words{"correlation with ", "corrélation avec "},
    Words{"dead time ", "retard pur "},
    Words{"estimate, ", "estimation, "},
    Words{"experiment ", "expérience "},
    Words{"nearly as good, ", "presque aussi bon, "},
};

/// How texts end that begin with a percentage, and what stands before it in French.
constexpr std::array kEndings = {
    Words{" % bound", "borne à "},
    Words{" % confidence", "confiance à "},
    Words{" % confidence band", "bande de confiance à "},
    Words{" % of chance", "part du hasard à "},
    Words{" % prediction band", "bande de prévision à "},
};

constexpr std::array kUnits = {Words{" (samples)", " (échantillons)"}, Words{" (per s)", " (par s)"}};

std::string french(const std::string& text) {
    const std::size_t bracket = text.find(" (");
    const std::string head = text.substr(0, bracket);
    for (const auto& [english, other] : kTexts) {
        if (head != english) continue;
        std::string unit = bracket == text.npos ? "" : text.substr(bracket);
        for (const auto& [here, there] : kUnits)
            if (unit == here) unit = there;
        return std::string(other) + with_decimal_commas(unit);
    }
    for (const auto& [english, other] : kBeginnings)
        if (text.starts_with(english)) return std::string(other) + with_decimal_commas(text.substr(english.size()));
    for (const auto& [english, other] : kEndings)
        if (text.ends_with(english) && std::isdigit(static_cast<unsigned char>(text.front())))
            return std::string(other) + with_decimal_commas(text.substr(0, text.size() - english.size())) + " %";
    return with_decimal_commas(text);
}

}  // namespace

std::string with_decimal_commas(const std::string& text) {
    const auto digit = [&text](std::size_t i) {
        return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
    };
    std::string result = text;
    for (std::size_t i = 0; i < text.size();) {
        if (!digit(i)) {
            ++i;
            continue;
        }
        const std::size_t first = i;
        std::size_t points = 0, place = 0;
        for (; digit(i) || (text[i] == '.' && digit(i + 1)); ++i)
            if (text[i] == '.') {
                ++points;
                place = i;
            }
        if (points == 1 && (first == 0 || text[first - 1] != '.')) result[place] = ',';
    }
    return result;
}

Figure in_french(const Figure& figure) {
    Figure result = figure;
    const auto change = [](std::string& text) { text = french(text); };
    change(result.title);
    for (Panel& panel : result.panels) {
        for (std::string* text : {&panel.title, &panel.x_label, &panel.y_label}) change(*text);
        for (Curve& curve : panel.curves) change(curve.label);
        for (ReferenceLine& reference : panel.references) change(reference.label);
        for (Annotation& annotation : panel.annotations) change(annotation.text);
        for (Arrow& arrow : panel.arrows) change(arrow.text);
    }
    return result;
}

}  // namespace dynlab::inline figures
