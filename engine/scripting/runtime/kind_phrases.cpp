#include "scripting/runtime/kind_phrases.h"

#include <algorithm>
#include <array>
#include <string>

namespace dynlab::inline scripting {
namespace {

struct KindPhrases {
    std::string_view kind;
    Message with_article, with_the;
};

const auto& kind_phrases() {
    static const std::array phrases = {
        KindPhrases{"number", Message("a number"), Message("the number")},
        KindPhrases{"string", Message("a string"), Message("the string")},
        KindPhrases{"boolean", Message("a boolean"), Message("the boolean")},
        KindPhrases{"table", Message("a table"), Message("the table")},
        KindPhrases{"function", Message("a function"), Message("the function")},
        KindPhrases{"thread", Message("a thread"), Message("the thread")},
        KindPhrases{"coroutine", Message("a coroutine"), Message("the coroutine")},
        KindPhrases{"vector", Message("a vector"), Message("the vector")},
        KindPhrases{"matrix", Message("a matrix"), Message("the matrix")},
        KindPhrases{"mask", Message("a mask"), Message("the mask")},
        KindPhrases{"complex number", Message("a complex number"), Message("the complex number")},
        KindPhrases{"complex vector", Message("a complex vector"), Message("the complex vector")},
        KindPhrases{"iddata", Message("an iddata object"), Message("the iddata object")},
        KindPhrases{"idfrd", Message("an idfrd object"), Message("the idfrd object")},
        KindPhrases{"model", Message("a model"), Message("the model")},
        KindPhrases{"process structure", Message("a process structure"), Message("the process structure")},
        KindPhrases{"state-space model", Message("a state-space model"), Message("the state-space model")},
        KindPhrases{"simulated model", Message("a nonlinear model"), Message("the nonlinear model")},
        KindPhrases{"grey-box model", Message("a grey-box model"), Message("the grey-box model")},
        KindPhrases{"grey-box estimate", Message("a grey-box estimate"), Message("the grey-box estimate")},
        KindPhrases{"traced value", Message("a symbolic value"), Message("the symbolic value")},
        KindPhrases{"regression", Message("a regression result"), Message("the regression result")},
        KindPhrases{"Monte Carlo study", Message("a Monte Carlo study"), Message("the Monte Carlo study")},
        KindPhrases{"table of orders", Message("a result of srivcstruc"), Message("the result of srivcstruc")},
        KindPhrases{"table of ARX orders", Message("a result of arxstruc"), Message("the result of arxstruc")},
        KindPhrases{"figure", Message("a figure"), Message("the figure")},
    };
    return phrases;
}

const KindPhrases* phrases_of(std::string_view kind) {
    const auto found = std::ranges::find(kind_phrases(), kind, &KindPhrases::kind);
    return found == kind_phrases().end() ? nullptr : &*found;
}

}  // namespace

Message with_article(std::string_view kind) {
    if (const KindPhrases* known = phrases_of(kind)) return known->with_article;
    const bool vowel = !kind.empty() && std::string_view("aeiou").find(kind.front()) != std::string_view::npos;
    return Message::verbatim((vowel ? "an " : "a ") + std::string(kind));
}

Message with_the(std::string_view kind) {
    const KindPhrases* const known = phrases_of(kind);
    return known != nullptr ? known->with_the : Message::verbatim("the " + std::string(kind));
}

Message what_it_is(std::string_view kind) {
    if (kind == "nil") return Message("nil (it has no value)");
    if (kind == "boolean") return Message("true or false");
    if (kind == "string") return Message("a string");
    if (kind == "userdata") return Message("an object");
    return with_article(kind);
}

}  // namespace dynlab::inline scripting
