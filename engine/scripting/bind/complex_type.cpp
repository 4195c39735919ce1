#include <array>

#include "scripting/bind/bindings.h"
#include "scripting/conversions/localized.h"
#include "scripting/conversions/table_fields.h"
#include "scripting/objects/model.h"
#include "scripting/runtime/text_form.h"

namespace dynlab::inline scripting {
namespace {

int vector_element(Call& call) {
    const ComplexVector& v = object_argument<ComplexVector>(call, 1, "z");
    const Index number = call.integer(2, "element");
    if (number < 1 || number > v.size())
        throw InvalidArgument("the element {} does not exist: {}", number, numbered_from_one(v.size()));
    push_object(call.state(), Complex(v[number - 1]));
    return 1;
}

constexpr std::array kNumberFields = {Member{"re", field<Complex, [](const Complex& z) { return z.real(); }>},
                                      Member{"im", field<Complex, [](const Complex& z) { return z.imag(); }>},
                                      Member{"abs", field<Complex, [](const Complex& z) { return std::abs(z); }>},
                                      Member{"arg", field<Complex, [](const Complex& z) { return std::arg(z); }>}};
constexpr std::array kNumberOperators = {
    Member{"__tostring", field<Complex, [](const Complex& z) { return complex_text(z); }>}};
constexpr std::array kVectorFields = {
    Member{"re", field<ComplexVector, [](const ComplexVector& z) { return Vector(z.real()); }>},
    Member{"im", field<ComplexVector, [](const ComplexVector& z) { return Vector(z.imag()); }>},
    Member{"abs", field<ComplexVector, [](const ComplexVector& z) { return Vector(z.cwiseAbs()); }>},
    Member{"arg", field<ComplexVector, [](const ComplexVector& z) { return Vector(z.cwiseArg()); }>}};
constexpr std::array kComplexVectorOperators = {
    Member{"__len", field<ComplexVector, [](const ComplexVector& z) { return z.size(); }>},
    Member{"__tostring", localized_field<ComplexVector, complex_vector_text>}};

constexpr std::array kComplexTypes = {
    TypeEntry{&Userdata<Complex>::type, kNumberFields, {}, kNumberOperators},
    TypeEntry{&Userdata<ComplexVector>::type, kVectorFields, {}, kComplexVectorOperators, guarded<vector_element>}};

}  // namespace

TypeEntries complex_types() {
    return kComplexTypes;
}

}  // namespace dynlab::inline scripting
