// Instead of <qpdf/JSON.hh>, whose lists of itself clang 14 refuses in C++20 (LLVM's constexpr vector of an incomplete
// class); nothing here reads JSON by libqpdf. Included before all else, by the fuzzers' build and by scripts/tidy.
class JSON;
#define JSON_HH
