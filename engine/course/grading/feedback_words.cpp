#include "course/grading/feedback_words.h"

namespace dynlab::inline course {
namespace {

constexpr FeedbackWords kEnglishFeedback = {
    "Feedback for {}",
    "Lesson {}: **{} of {} points.**",
    "{} of {} points.",
    ": ",
    "{} of {}",
    "not graded yet",
    "Checks",
    "Your script ran to its end.",
    "Your script ran to its end but gave no answer.",
    "**Your work could not be read, so it has no marks yet:** ",
    "**Your script could not be begun:** ",
    "**Your script did not run to its end:** ",
    "It was late, which costs {} points: {}.",
    "**This hand-in does not count.** Of several from you the better one counts: {}.",
    "**This hand-in does not count.** Of several from you the newest one counts: {}.",
    "Points are given by programs that hold your answers against your data and against records that nobody has seen. "
    "If you think that one of them is wrong, tell your instructor which, and why.",
};

constexpr FeedbackWords kFrenchFeedback = {
    "Retour pour {}",
    "Leçon {}, points : **{} sur {}.**",
    "Points : {} sur {}.",
    " : ",
    "{} sur {}",
    "pas encore noté",
    "Contrôles",
    "Votre script est allé jusqu'au bout.",
    "Votre script est allé jusqu'au bout, mais n'a donné aucune réponse.",
    "**Votre travail n'a pas pu être lu ; il n'a donc pas encore de note :** ",
    "**Votre script n'a pas pu commencer :** ",
    "**Votre script n'est pas allé jusqu'au bout :** ",
    "Il est arrivé en retard ; points perdus : {} ({}).",
    "**Cette remise ne compte pas.** De plusieurs remises de votre part, la meilleure compte : {}.",
    "**Cette remise ne compte pas.** De plusieurs remises de votre part, la plus récente compte : {}.",
    "Les points sont donnés par des programmes qui comparent vos réponses avec vos données et avec des enregistrements "
    "que personne n'a vus. Si vous pensez que l'un d'eux se trompe, dites à votre enseignant lequel, et pourquoi.",
};

}  // namespace

const FeedbackWords& feedback_words(const std::string& language) {
    return language == "fr" ? kFrenchFeedback : kEnglishFeedback;
}

}  // namespace dynlab::inline course
