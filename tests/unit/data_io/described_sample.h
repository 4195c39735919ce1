#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data_io/values/array_descriptions.h"

namespace dynlab {

enum class Shade { kLight, kDark };
constexpr std::array<const char*, 2> names_of(Shade) {
    return {"light", "dark"};
}

struct Part {
    std::string name;
    std::int16_t count = 0;
    bool operator==(const Part&) const = default;
};

template <Is<Part> T, class V>
void describe(T& object, V& member) {
    auto& [name, count] = object;
    member("name", name), member("count", count);
}

inline void check_value(const Part& part, const ValueLimits&) {
    if (part.count == 13) throw std::invalid_argument("thirteen parts bring bad luck");
}

/// A member of every kind.
struct Whole {
    bool truth = false;
    double number = 0;
    std::size_t size = 0;
    Shade shade = Shade::kLight;
    std::string text;
    Vector vector;
    Matrix matrix;
    ComplexVector complex;
    std::optional<double> none, some;
    std::shared_ptr<const Part> shared;
    std::vector<Part> parts;
    std::map<std::string, Part> named;
    std::vector<std::pair<std::string, double>> pairs;
    std::string maybe_empty;
    std::string secret;
};

template <Is<Whole> T, class V>
void describe(T& object, V& member) {
    auto& [truth, number, size, shade, text, vector, matrix, complex, none, some, shared, parts, named, pairs,
           maybe_empty, secret] = object;
    member("truth", truth), member("number", number), member("size", size), member("shade", shade);
    member("text", text), member("vector", vector), member("matrix", matrix), member("complex", complex);
    member("none", none), member("some", some), member("shared", shared), member("parts", parts);
    member("named", named), member("pairs", pairs), member.unless_empty("maybe_empty", maybe_empty);
    member.kept("secret", secret);
}

inline Whole sample_whole() {
    Whole whole;
    whole.truth = true;
    whole.number = -1.0 / 3;
    whole.size = 7;
    whole.shade = Shade::kDark;
    whole.text = "R\xC3\xA9gression \"1\"";
    whole.vector = Vector{{0.1, -2}};
    whole.matrix = Matrix{{1, 2, 3}, {4, 5, 6}};
    whole.complex = ComplexVector{{Complex(1, -2), Complex(0, 1)}};
    whole.some = 2.5;
    whole.shared = std::make_shared<Part>(Part{"shared", -5});
    whole.parts = {{"a", 1}, {"b", 2}};
    whole.named = {{"first", {"c", 3}}};
    whole.pairs = {{"x", 1.5}};
    whole.secret = "for programs";
    return whole;
}

/// All but the secret.
inline bool equal(const Whole& a, const Whole& b) {
    return a.truth == b.truth && a.number == b.number && a.size == b.size && a.shade == b.shade && a.text == b.text &&
           a.vector == b.vector && a.matrix == b.matrix && a.complex == b.complex && a.none == b.none &&
           a.some == b.some && (a.shared && b.shared ? *a.shared == *b.shared : a.shared == b.shared) &&
           a.parts == b.parts && a.named == b.named && a.pairs == b.pairs && a.maybe_empty == b.maybe_empty;
}

}  // namespace dynlab
