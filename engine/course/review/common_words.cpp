#include "platform/text/word_set.h"
#include "course/review/remark_traces.h"

namespace dynlab::inline course {
namespace {

constexpr std::string_view kCommonWords =
    // English
    "able about above according across actually after again against agree agreed agrees almost along already also "
    "although always among amount another answer answered answers anyone anything appear appears around aspect aspects "
    "because become becomes been before begin behind being believe below best better between beyond both bring came "
    "cannot case cases certain certainly choice choose chose chosen clear clearer clearly come comes comment comments "
    "complete completely concerning consider considered contain contains could correct correctly could describe "
    "described describes description despite detail detailed details different difficult discuss discussed discussion "
    "does doing done down during each easier easily easy either else enough especially even ever every everything "
    "exactly example examples excellent expect explain explained explains explanation explanations fact find first "
    "following follows found from full further general generally give given gives giving good great greatest group "
    "hard have having help helpful helps here however idea important improve improved improvement improvements include "
    "included includes indeed information instead interesting into itself just keep kind know known lack lacks last "
    "later least less like likely little look looks made main make makes making many maybe mean means mention "
    "mentioned might missing more moreover most much must namely need needed needs neither never next nice none "
    "nothing obtain obtained often once only open order other others otherwise ought over overall paper part parts "
    "perhaps place please point points possible possibly precise precisely present presented presents probably proper "
    "properly provide provided provides quality question questions quite rather read reader readers reading really "
    "reason reasons recommend regarding remark remarks remain remains repeat report reports result results review "
    "reviewer right said same say says second see seem seems seen several shall should show showed shown shows simply "
    "since small some something sometimes state stated states step steps still strength strengths strong such "
    "sufficient suggest suggested suggestion suggestions sure take taken takes tell tells text than that their them "
    "themselves then there therefore these they thing things think third this those though three through thus title "
    "together told toward towards true truly understand understood unclear under until upon used useful uses using "
    "usually various very want wanted weak weakness well were what whatever when where whether which while whole whom "
    "whose will wish with within without word words work would write written wrong your yourself author authors figure "
    "figures table tables equation equations section sections page pages appendix caption "
    // French
    "afin ainsi alors apres assez aucun aucune aupres aussi autant autre autres autour auteur auteurs avant avec avez "
    "avoir avons beaucoup bien bonne bons bonnes cela celle celles celui cependant certain certaine certaines certains "
    "cette ceux chaque chose choses choisi choisir choix claire clairement clairs comme comment commentaire "
    "comprendre compris concernant contre correct correctement dans decrire decrit decrite depuis derniere dernier des "
    "detail details deux devoir devrait devraient dire dont donne donner donc elle elles encore enfin ensuite entre "
    "etait etant etape etapes etre exemple exemples expliquer explique expliquee explication explications facile faire "
    "fait faite faites faut figure figures fois font forme fort general grand grande groupe ici idee important "
    "importante indiquer jamais jusqu justifier lecteur leur leurs lieu lire lors lorsque mais maniere manque manquent "
    "meilleur meilleure meme memes mettre mieux moins montre montrer montrent necessaire notre nous opinion ordre "
    "page pages parce parmi partie parties pas passe pendant petit peut peuvent phrase place plus plusieurs plutot "
    "point points possible pour pourquoi pourrait pouvoir precis precise preciser premier premiere presque presente "
    "presenter qualite quand quant quel quelle quelles quelque quelques quels question questions quoi rapport rapports "
    "remarque remarques rendre reponse reponses reste resultat resultats revoir rien sans savoir section sections "
    "selon semble sera serait serieux seul seule seulement sinon soient soit sont sous souvent suffisant suffisamment "
    "suggere suggestion suggestions suite sujet surtout tableau tableaux tant telle telles tels tout toute toutes tous "
    "travail tres trop trouve trouver trois utile utilise utiliser utilisee vers version voir voit votre vous vraiment";

}  // namespace

bool is_common_word(const std::string& folded) {
    static const std::unordered_set<std::string_view> words = word_set(kCommonWords);
    return words.contains(folded);
}

}  // namespace dynlab::inline course
