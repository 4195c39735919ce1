#include <array>

#include "scripting/objects/model.h"
#include "scripting/objects/text_form.h"

namespace dynlab::inline scripting {
namespace {

const Complex& number_self(Call& call) {
    return object_argument<Complex>(call, 1, "z");
}
const ComplexVector& complex_vector_self(Call& call) {
    return object_argument<ComplexVector>(call, 1, "z");
}

int number_re(Call& call) {
    return call.give(number_self(call).real());
}
int number_im(Call& call) {
    return call.give(number_self(call).imag());
}
int number_abs(Call& call) {
    return call.give(std::abs(number_self(call)));
}
int number_arg(Call& call) {
    return call.give(std::arg(number_self(call)));
}
int number_tostring(Call& call) {
    return call.give(complex_text(number_self(call)));
}

int vector_re(Call& call) {
    return call.give_vector(complex_vector_self(call).real());
}
int vector_im(Call& call) {
    return call.give_vector(complex_vector_self(call).imag());
}
int vector_abs(Call& call) {
    return call.give_vector(complex_vector_self(call).cwiseAbs());
}
int vector_arg(Call& call) {
    return call.give_vector(complex_vector_self(call).cwiseArg());
}
int complex_vector_length(Call& call) {
    return call.give_integer(complex_vector_self(call).size());
}
int complex_vector_tostring(Call& call) {
    return call.give(complex_vector_text(complex_vector_self(call)));
}

int vector_element(Call& call) {
    const ComplexVector& v = complex_vector_self(call);
    const Index number = call.integer(2, "element");
    if (number < 1 || number > v.size())
        throw InvalidArgument(fmt::format("the element {} does not exist: there are 1 to {}", number, v.size()));
    push_object(call.state(), Complex(v[number - 1]));
    return 1;
}

constexpr std::array kNumberFields = {Member{"re", guarded<number_re>}, Member{"im", guarded<number_im>},
                                      Member{"abs", guarded<number_abs>}, Member{"arg", guarded<number_arg>}};
constexpr std::array kNumberOperators = {Member{"__tostring", guarded<number_tostring>}};
constexpr std::array kVectorFields = {Member{"re", guarded<vector_re>}, Member{"im", guarded<vector_im>},
                                      Member{"abs", guarded<vector_abs>}, Member{"arg", guarded<vector_arg>}};
constexpr std::array kComplexVectorOperators = {Member{"__len", guarded<complex_vector_length>},
                                                Member{"__tostring", guarded<complex_vector_tostring>}};

}  // namespace

const ObjectType Boxed<Complex>::type{"complex number", kNumberFields, {}, kNumberOperators};
const ObjectType Boxed<ComplexVector>::type{
    "complex vector", kVectorFields, {}, kComplexVectorOperators, guarded<vector_element>};

}  // namespace dynlab::inline scripting
