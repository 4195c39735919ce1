#include "course/anonymity/name_patterns.h"
#include "platform/text/word_set.h"

namespace dynlab::inline course {
namespace {

/// Words that are surnames or given names as well, names of the field (methods, units, authors that reports cite), and
/// of programs that write themselves into documents; folded.
constexpr std::string_view kOrdinaryWords =
    "abel able ackermann acre acrobat admin adobe akaike alder alpha america ampere anderson ange angel anonymous "
    "apple april arbre arch archer arnoldi ash astrom auger august austin author authors avril azur back backlund "
    "bacon bailey baker ball bank banks barber bartlett bas bass battle bayes beach beamer bean bear beau bell belle "
    "bellman bench bender berger bernard bernoulli berry bessel best beta bijou bird birkhoff bishop black blackman "
    "blanc blanche blank block bloom blue board bode bohlin bohr bois boltzmann bon bond bonne bonnet book booth "
    "bordeaux bosse bottou boucher boulanger bourgeois bow bowl box branch brand bras breton bridge bridges bright "
    "bristol brittany brook brooks brown brun bruno bud bull burg burn burns bush butcher butler butter butterworth "
    "cable cairo camp cane canon caratheodory card carlo carpenter carre carter case cash castle cauchy cayley cerf "
    "chaine champ champs chance chapel chapter charbon charge charlotte charpentier charrette chart chase chat chateau "
    "chauvin chebyshev chelsea chemin cheval chevalier chevre china chirikov cholesky chrome church clair claire clark "
    "clarke clay clerc cloche close cloutier coast cohen coin cole colin comte cook coon cooper corbeau cordier "
    "coriolis corner coste cote couleur coulomb counts cour courbe court cousin couture craft cramer crane crank croix "
    "cross crow dahlin dakota dale danielson data david day dean dear debian deep delta dernier descartes desert dial "
    "diamond dimanche diophantus dirac dirichlet doe doppler dormand doux draft drew drive droit droite duck duhamel "
    "duke dur durbin dwell dyer earl early earth east easy eau ecole edge eglise eight eighth einstein elder eleven "
    "english entree epson etoile etude euclid euler evans even evrard excel faible fair faith falls faraday farmer "
    "fast faure fer ferme fevrier fibonacci field fields fifth figure fille fils fin finch first fish fisher five "
    "fletcher fleur fleury flint flood florence flower flowers fold fontaine force ford forest fort forte fosse foster "
    "foulon fountain four fourier fournier fourth fowler fox frame franc francais france frank franks free freeman "
    "french frobenius frost fuller gage gain gale galerkin galileo galton game gamma garde garden gardner garnier "
    "gates gauche gauss gaussian gauthier gay gendre gentle german gershgorin ghostscript gibbs gift gilles gilson "
    "givens givre glass glover gnuplot gold golden good goodman google gout grace gram grand grande granger grant "
    "grassmann grave graves gray great green grey gros grosse ground group groups grove groves guerin guerre guy "
    "hadamard hall hamilton hammerstein hamming hand hands hankel hann hardy harp harris hart haut hay head heath "
    "heaviside heisenberg held helmholtz hermite hertz hessenberg hessian heureux high hilbert hill hills hiver hobbs "
    "holder hole holiday holland home hood hook hooke hooper hope hopkinson horn horne house householder houston huber "
    "hunt hunter hurwitz huygens hyperref image inch india iron israel jack jacobi jacobian james jardin jaune jay "
    "jenkins jersey jeune john joli jolly jones jordan joule jour joy judge juin june jury just juste justice kailath "
    "kaiser kalman karhunen keen keep kelvin key keys kind king kirchhoff kleinman knight knot kolmogorov kronecker "
    "krylov kutta lac lacroix lagrange laguerre lake lamb lamp lanczos land landau lane langevin laplace large last "
    "latex laurent law lawn lay lead leaf league lean leave lebesgue leclerc left legendre leger legere leibniz lent "
    "lente leroy level levenberg lever levier levinson lewis libre lieu light lily limb lincoln line link linux lion "
    "lipschitz lit little live ljung loan lock london long longue loop lord love low lowe luatex lucky luenberger "
    "lundi lyapunov maclaurin madison main maison maitre major mann marble march marchand marche mardi marechal mark "
    "markov marks marquardt mars marsh marshall mason masse master masters matin matlab matrix maxwell may mayne "
    "mcbride mead meadows mealy means mehra member members mercer mercier mercy merit merle merry mesure meunier "
    "michel microsoft midi might miles milieu mill miller mills mint mode model modele moine moler monday monnier mont "
    "montagne monte moon moor moore moreau morin morrow morse moss moteur moulin mount mountain mouton mur music nail "
    "name names nash near neige nelder new newman newton newtonian nichols nicholson nicolas night nine ninth nobel "
    "noble noel noir noire noise nom north nouveau nussbaum nut nyquist oak oakes octave octobre office ohm olive "
    "olympic ombre omega one order osborn owen pace pack pade padgett page paille pain paine palais palier palm palmer "
    "palmgren pandoc parent paris park parker parks parseval parson part partie pas pascal pass patch paul peace peak "
    "pearl pearson penny penrose pepper perfect perrin perron perry petit petite phase picard piece pied pierre pike "
    "pine pitt place plage plain plan planck plant plat pleine plot poids poincare point poirier poisson pole pomme "
    "pond pont pontryagin pool poole pope poppler port porte porter potter poulain poulet pound powder power powers "
    "prandtl pratt premier prevot price pride prieur prince prior process processus proctor professor prudhomme pseudo "
    "pseudonym puits pulley pulse python quade quanser quartz quick ragazzini rain rameau ramp ramsey ranger rank rao "
    "raphson rapport rate ray rayleigh rayon read reader recherche record red reed regard regnier reid renard report "
    "rest reste retard review reynolds riccati rice rich richardson riche riemann right ring rise rissanen river "
    "rivers riviere road robert robin robot roche rock rod rode roi roll roman rond root rose rosenbrock rouge "
    "rousseau routh roux row roy royal royer ruelle rule runge runner rush sable sagara sage sales salle salt samedi "
    "sand sands sargan sauvage savage sawyer scale schmidt school schur schwarz sea seal season second seidel self "
    "senior serie series serrure seul seven seventh shade shaft shannon sharp shaw sheep shell shepherd ship shore "
    "short siecle siemens sigma signal silver simon simpson simulink sine singer single sinha six sixth skia skinner "
    "sky slater small smart smith snow soderstrom soleil son sort sortie souris south southwell spear speed spring "
    "square stable stage star start state steel steep steiglitz step stern steward still stirling stoica stokes stone "
    "storm street strejc stribeck strong stuart student students subject such suite summer summers sun sunday swan "
    "sweet swift sydney sylvester system systeme tableau tache tail takagi taller tanner taylor teacher team temps ten "
    "tenth term terme terre tesla tessier test tete tex texte thank theil theta third thorn thorpe three tikhonov time "
    "tison todd toeplitz tour toussaint tower towers train travel travers tree tresor truth tsypkin tucker tukey "
    "turner tustin twelve twist two unbehauen under union unit user users vale valeur valle vallee value vandermonde "
    "vane vent verdier vert verte victor victoria vidal vieille vieux vigne vigneron ville vine vivant voice voisin "
    "volt volta volterra vrai wade wahlberg wake wald walk walker wall walls walsh ward warden warm warner washington "
    "water waters watt watts wave way weaver webb weber week weeks weight welch well wells west wheel wheeler white "
    "whittaker whole wide widrow wiener wigner wild will willow wilson wind windows winter winters wise with wold wolf "
    "wood woods word work works worth wright writer wronskian xetex yard year york young yule zadeh zero zhu ziegler";

}  // namespace

bool is_ordinary_word(const std::string& folded) {
    static const std::unordered_set<std::string_view> words = word_set(kOrdinaryWords);
    return words.contains(folded);
}

}  // namespace dynlab::inline course
