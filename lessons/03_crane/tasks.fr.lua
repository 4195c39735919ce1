-- ---
-- title: Identification d'une grue à chariot
-- subtitle: Leçon 3.2 – une entrée, deux sorties, un rapport
-- language: fr
-- ---

-- %% [markdown]
-- Un chariot roule le long d'un rail, tiré par un moteur ; un pendule y est suspendu. Une seule tension fait bouger les deux, si bien qu'un seul modèle a
-- deux sorties : la position du chariot et l'oscillation de la charge. Vous recevez cinq enregistrements, dont un où la grue a été
-- menée là où aucun modèle linéaire ne suit (la @fig:crane montre ce qui est mesuré). La grue est *simulée* : un programme en résout les équations, bruit compris. Trouvez un modèle, dites ce qu'il vaut, et
-- décrivez-le de sorte que quelqu'un qui n'était pas là puisse tout refaire.
--
-- ::: {.drawing name=crane}
-- La grue : la tension $u$ du moteur, la position $x$ du chariot et l'angle $\theta$ de la tige, positifs comme ils sont dessinés {#fig:crane}
-- :::
--
-- Travaillez dans ce script, cellule par cellule ; votre texte va dans `report.md`, qui contient les sections d'un rapport et des notes sur
-- ce qui appartient à chacune. Ce que vous rendez est le rapport : six pages au plus, sept avec l'annexe.
--
-- # Les enregistrements
--
-- | enregistrement | ce qui a été fait |
-- |-----------|-----------------------|
-- | `estimation`, `validation` | un repos, puis une tension binaire pseudo-aléatoire de ±2 V, dans deux ordres différents |
-- | `steps` | un repos, puis des impulsions de ±2 V et ±4 V séparées par des pauses |
-- | `free_swing` | moteur à 0 V, charge lâchée à la main |
-- | `limits` | tension pseudo-aléatoire, puis conduite à la main jusqu'aux deux bouts du rail, puis de nouveau pseudo-aléatoire |
--
-- Chacun contient `t` (s), `u` (V), `x` (m) et `theta` (rad), toutes les 0,02 s ; la tension est maintenue entre deux échantillons.

-- %% [markdown]
-- **Question 1.** Montrez les enregistrements bruts. Que voit-on avant tout calcul ?

-- %% [markdown]
-- **Question 2.** Bruit, résolution, niveaux au repos : que disent la première seconde d'un enregistrement et les différences entre ses échantillons ?
--
-- **Question 3.** Quelle section de `limits` n'appartient à aucun modèle linéaire, et pourquoi ? Trouvez-en le premier et le dernier instant dans
-- l'enregistrement, et comparez avec ce que `advice` dit de l'enregistrement et de son champ `discard`.

-- %% [markdown]
-- **Question 4.** Qu'y a-t-il entre la tension et la position qu'aucun enregistrement de durée finie ne montre entièrement ? Écrivez les équations
-- de la grue comme la physique les donne, et lisez-y quels pôles et zéros position et angle ont en commun.
--
-- **Question 5.** Comparez des structures pour chaque sortie, sur les enregistrements d'estimation et de validation (`srivcstruc`).

-- %% [markdown]
-- **Question 6.** Estimez le modèle que vous avez retenu. Les deux sorties, estimées chacune pour elle-même, s'accordent-elles sur ce qu'elles
-- ont en commun ? Que donnent-elles ensemble (`CommonDenominator`) ? Un millimètre et un milliradian ne s'additionnent pas : par quoi
-- faut-il diviser les erreurs de chaque sortie (`OutputWeights`) ?

-- %% [markdown]
-- **Question 7.** Qu'a-t-on essayé d'autre, et pourquoi l'écarter ? Comparez la simulation d'un modèle ARX, et ce que devient votre
-- modèle quand il est estimé sur `limits`, en entier puis sans la section que vous avez écartée.

-- %% [markdown]
-- **Question 8.** Validez : les sorties simulées contre l'enregistrement qui n'a pas servi, puis les résidus. Que vaut le modèle sur les
-- impulsions de `steps`, et que dit l'oscillation libre du pendule ? `motion` montre la grue et le modèle côte à côte, en mouvement (sur la page de
-- `dynlab preview analysis.lua`, pas dans le rapport).

-- %% [markdown]
-- **Question 9.** Un enregistrement n'est qu'une réalisation. On peut faire tourner de nouveau la grue simulée de ce cours : `plant("crane", {seed = 2})` répète les cinq
-- expériences avec un autre ordre des bits et un autre bruit. Devinez d'abord (`predict_first`, `reveal`) : quelle adéquation de l'angle est typique ? Puis répétez toute votre
-- démarche quarante fois. De combien adéquation, paramètres et pulsation varient-ils d'une répétition à l'autre, les erreurs types annoncent-elles cette dispersion, et à quelle
-- distance votre modèle est-il du meilleur modèle linéaire de cette structure ?

-- %% [markdown]
-- **Question 10.** Quelle non-linéarité reste-t-il ? Simulez les équations de la question 4 avec le frottement sec, avec le sinus de l'angle au lieu de l'angle
-- (et la traînée de l'air), et avec les deux ; estimez leurs quelques paramètres comme ceux du modèle linéaire, par la plus petite erreur de simulation. Laquelle
-- explique la position, laquelle l'angle, et que reste-t-il à la fin ?

-- %% [markdown]
-- **Question 11 (annexe).** Proposez un moyen d'amener vite le chariot à un endroit donné tandis que la charge oscille peu : un schéma-bloc,
-- un régulateur conçu sur votre modèle (`lqr`, `place`), et sa boucle fermée sur la grue non linéaire (`drive_crane`).

-- %% [markdown]
-- # Relecture par les pairs
--
-- Après la date limite de la première version, vous recevez le rapport d'un autre groupe, sans ses noms, et en écrivez une relecture d'une à deux pages ; vos noms n'apparaissent sur aucun des deux. `dynlab new review ma-relecture --lang fr` crée le formulaire. Il pose cinq questions :
--
-- 1. Les données et leur collecte sont-elles décrites assez clairement pour que quelqu'un d'autre refasse les expériences ?
-- 2. La solution de chaque étape de la démarche est-elle décrite ?
-- 3. Les conclusions découlent-elles des données, des expériences et des résultats ? Les partagez-vous, et que proposez-vous d'y changer ?
-- 4. Quel est le plus grand mérite du contenu ?
-- 5. Comment améliorer la clarté, la lisibilité et l'exactitude technique ?
--
-- Répondez sous forme de discussion : donnez des raisons, proposez d'autres méthodes. Critiquez de façon constructive, gardez un ton bienveillant, dites précisément ce qui peut être amélioré, évitez ce qui pourrait blesser. Des remarques vagues ou dures sont ignorées. Votre enseignant fixe trois dates limites : la première version du rapport, la relecture, et
-- la version finale, qui tient compte des relectures.
--
-- # Ce que vous rendez en plus du rapport
--
-- Des lecteurs lisent le rapport. Si le script est noté aussi, rendez vos résultats avec `answer(nom, valeur)` :
--
-- * `discarded` : le premier et le dernier instant (s) de la partie de `limits` qu'aucun modèle linéaire ne peut décrire ;
-- * `rest_angle` : ce qu'indique le potentiomètre (rad) quand la charge est au repos ;
-- * `G_position` et `G_angle` : vos modèles recommandés, de la tension à la position, intégrateur compris, et de la tension à l'angle ;
-- * `fits` : l'adéquation (%) avec laquelle ils simulent position et angle des données de validation ;
-- * `free_swing` : la pulsation (rad/s) de la charge quand le moteur est arrêté.
--
-- L'évaluation exécute aussi votre script sur les données d'une autre grue, et compare les modèles obtenus avec des expériences cachées. Les
-- vérifications cherchent les figures `raw` et `validation`.
