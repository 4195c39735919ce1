-- ---
-- title: Identification d'un propulseur sous-marin
-- subtitle: Leçon 5 – une non-linéarité statique, deux balayages, douze diapositives
-- language: fr
-- ---

-- %% [markdown]
-- Un propulseur sous-marin est commandé par la largeur d'impulsions électriques ; il pousse ou tire sur un capteur de force. Deux sortes
-- d'expériences ont été faites, avec un sinus et avec un signal carré de fréquence croissante (@fig:thruster). Propulseur et capteur sont *simulés* : les
-- enregistrements viennent d'un programme qui résout leurs équations, bruit compris, et vos résultats pourront être comparés à la vérité. Trouvez
-- un modèle à partir des uns, éprouvez-le sur les autres, puis échangez les rôles ; dites quel modèle vous recommandez et pourquoi. On vous
-- interrogera : sachez ce que vous avez essayé et pourquoi vous l'avez écarté.
--
-- ::: {.drawing name=thruster}
-- Le propulseur est suspendu dans l'eau à une poutre qui pivote et appuie sur un capteur de force : l'entrée est la largeur $p$ des impulsions, la sortie l'indication $F$ {#fig:thruster}
-- :::
--
-- Travaillez dans ce script, cellule par cellule ; votre texte va dans `report.md`, qui devient des diapositives : douze au plus, pour un exposé de dix
-- minutes suivi de cinq minutes de questions. Ce fichier contient les huit points d'une présentation et des notes sur ce qui appartient à chacun. Rendez les diapositives en PDF avec ce script : `dynlab pack` met les deux dans un seul fichier.
--
-- L'exercice suit celui d'un vrai propulseur T200 : MathWorks Student Competitions Team, *MATLAB and Simulink Robotics Arena: From Data to Model*, MATLAB Central File Exchange 65919,
-- avec une [vidéo](https://www.youtube.com/watch?v=RU_LOtrEOBo) qui montre un des essais à partir de 17:25.
--
-- # Les enregistrements
--
-- | enregistrement | ce qui a été fait |
-- |-------------|----------------|
-- | `sine_100`, `sine_200`, `sine_300` | impulsions de 1500 ± 100, 200 ou 300 µs, un sinus de 0,1 Hz à 3 Hz en 20 s, avec un repos avant et après |
-- | `square_100`, `square_200`, `square_300` | le signe du même sinus, multiplié par la même amplitude |
--
-- Chacun contient `t` (s), `pwm` (µs) et `force` (N), toutes les 0,002 s ; la largeur est maintenue entre les échantillons, et 1500 µs est le neutre.

-- %% [markdown]
-- **Question 1.** Montrez les enregistrements bruts des deux sortes. Que voit-on avant tout calcul ?
--
-- **Question 2.** Mesurez à partir du neutre et du niveau de repos, puis interrogez `advice` sur un balayage sinusoïdal (un échantillon sur cinq lui
-- suffit : `resample`). Comparez l'écart type qu'un modèle linéaire laisse inexpliqué, selon lui, au bruit au repos. De quoi la différence est-elle faite ?
-- Pourquoi un balayage carré d'une seule amplitude ne le montrerait-il pas ?

-- %% [markdown]
-- **Question 3.** Le balayage carré fait vibrer quelque chose. Trouvez sa fréquence (`etfe` avec un peu de lissage, ou une moyenne sur de nombreuses
-- commutations). Est-ce le propulseur ? Choisissez un filtre passe-bas pour ce que vous voulez voir du propulseur, et dites ce que le filtre ne doit pas faire.
--
-- **Question 4.** Faites la moyenne des réponses à de nombreuses commutations. Pendant combien de temps ne se passe-t-il rien ? Devinez d'abord (`predict_first`, `reveal`).

-- %% [markdown]
-- **Question 5.** La poussée selon la largeur : filtrez les deux signaux de la même façon, prenez la partie lente des balayages sinusoïdaux, et faites des
-- moyennes par classes. Où la zone morte finit-elle ? En quoi marche avant et marche arrière diffèrent-elles ? Tracez aussi la racine de la poussée : quelle
-- est sa courbe au-delà de la zone morte, et pourquoi la physique la veut-elle ainsi ?

-- %% [markdown]
-- **Question 6.** Quelles structures comparez-vous, et selon quel critère ? Un modèle linéaire avec un retard ; un modèle de Hammerstein (`hammerstein`), une
-- courbe statique suivie d'une dynamique linéaire ; et ce que la physique vous suggère. Ce que vous filtrez dans la poussée mesurée, filtrez-le aussi dans la
-- poussée simulée : que devient un retard quand un seul côté est filtré ? Combien de pôles faut-il à une structure, et que devient le retard quand on ajoute
-- des pôles ? Une fois la courbe statique connue, `tfsrivc`, avec la valeur de la courbe comme entrée, répond vite. Un signal carré d'une seule
-- amplitude a trois valeurs : que peut-il dire d'une courbe ?

-- %% [markdown]
-- **Question 7.** Estimez ce que vous avez retenu, sur les balayages sinusoïdaux puis sur les balayages carrés. Quels paramètres concordent ? Que disent les
-- erreurs types des différences ?

-- %% [markdown]
-- **Question 8.** Validez dans les deux sens : les modèles des sinus sur les carrés, et inversement. Où, en temps et en amplitude, chaque modèle échoue-t-il ?
-- `motion` montre le propulseur et le modèle côte à côte, en mouvement (sur la page de `dynlab preview analysis.lua`, pas sur les diapositives).

-- %% [markdown]
-- **Question 9.** On peut interroger de nouveau le propulseur de ce cours : `plant("thruster", {seed = 2})` répète tous les enregistrements avec un autre bruit.
-- Répétez votre démarche. L'ordre de vos modèles est-il un hasard ? De combien le retard varie-t-il d'une répétition à l'autre, et son erreur est-elle due au bruit ?

-- %% [markdown]
-- **Question 10.** Quel modèle recommandez-vous, pour quoi, et pour quoi non ? Quelle expérience feriez-vous ensuite ?
--
-- # Ce que vous rendez en plus des diapositives
--
-- Si le script est noté aussi, rendez vos résultats avec `answer(nom, valeur)` :
--
-- * `ring_frequency` (Hz) : la fréquence de la question 3 ;
-- * `dead_band` : les deux bouts de la zone morte, avant puis arrière (µs depuis le neutre, le second est négatif) ;
-- * `delay` (s) : le retard du propulseur ;
-- * `thrust_300` : la poussée établie (N) à +300 µs et à −300 µs ;
-- * `model` : votre modèle recommandé, estimé sur les balayages sinusoïdaux ;
-- * `fit` (%) : son adéquation à la poussée de tous les balayages carrés ensemble, les deux signaux sous 8 Hz.
--
-- Le modèle est une table à quatre champs. Les vecteurs `width` (µs depuis le neutre, croissants) et `level` sont la courbe statique, linéaire entre
-- ses points. `G` est la dynamique qui la suit. `root` est vrai si la sortie est la racine de la poussée, à élever au carré avec son signe.
-- L'évaluation exécute aussi votre script sur les données d'un autre propulseur, avec des balayages carrés cachés. Les vérifications cherchent les
-- figures `curve` et `validation`.

-- %% id=comments
-- µs; samples before the thruster moves
-- µs ; échantillons avant que le propulseur ne bouge
