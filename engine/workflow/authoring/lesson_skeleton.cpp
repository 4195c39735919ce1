#include "workflow/authoring/lesson_skeleton.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/locks/complete_folder.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;

/// SLUG is replaced by the lesson's name.
constexpr const char* kLesson = R"LUA(-- ---
-- title: A spring and its stiffness
-- subtitle: A lesson of your own
-- lesson: SLUG
-- language: en
-- seed: 1
-- answers:
--   stiffness: number
--   noise: number
-- ---

-- %% [markdown]
-- A spring was loaded with known forces and its elongation measured. How stiff is it, and how accurate is the result?
--
-- # The data
--
-- `record.csv` has the force `u` in newtons and the elongation `y` in millimeters.

-- %% id=record
local record = load("record")
report.figure("record", plot(record.u, record.y, "measured",
  {style = "points", xlabel = "force (N)", ylabel = "elongation (mm)"}), "The data")

-- %% [markdown]
-- ![Elongation over force.](figure:record){#fig:record}
--
-- **Question 1.** How stiff is the spring (@fig:record), in N/mm? The elongation is $y = u/k + e$; use least squares.

-- %% id=stiffness
-- BEGIN SOLUTION
local compliance = dot(record.u, record.y)/dot(record.u, record.u)
local stiffness = 1/compliance
answer("stiffness", stiffness)
report.value("stiffness", stiffness, "%.2f")
-- END SOLUTION

-- %% [markdown]
-- BEGIN SOLUTION
-- The stiffness is `stiffness`{.value} N/mm.
-- END SOLUTION
--
-- **Question 2.** How large is the standard deviation of the measurement errors, in millimeters?

-- %% id=noise
-- BEGIN SOLUTION
answer("noise", std(record.y - compliance*record.u))
-- END SOLUTION

-- %% [markdown]
-- # What you have learned
--
-- Least squares computes the parameter of this linear model as a quotient of two sums. The residuals show its
-- uncertainty.
)LUA";

constexpr const char* kChecks =
    R"LUA(-- Students receive this file: it computes the expected answers from the data. See `dynlab help checks`.
local record = load("record")
local compliance = dot(record.u, record.y)/dot(record.u, record.u)

check { id = "stiffness", points = 3, about = "The stiffness of the spring",
    test = function(a) return near(a.stiffness, 1/compliance, {rel = 0.01}) end,
    mistakes = {
        {when = function(a) return math.abs(a.stiffness/compliance - 1) < 0.01 end,
         say = "This is the compliance in mm/N; the stiffness is its inverse."},
    },
    hint = "Which of the two, force or elongation, is divided by the other?" }

check { id = "noise", points = 2, about = "The measurement errors",
    test = function(a) return near(a.noise, std(record.y - compliance*record.u), {rel = 0.04}) end,
    hint = "How large are the residuals of the model?" }
)LUA";

constexpr const char* kWrong = R"LUA(-- expects: stiffness: This is the compliance
-- The script submits the compliance, elongation divided by force, as the stiffness.
local record = load("record")
local k = dot(record.u, record.y)/dot(record.u, record.u)
answer("stiffness", k)
answer("noise", std(record.y - k*record.u))
)LUA";

constexpr const char* kRight = R"LUA(-- Uses a library function, with a constant term that is not significant here.
local record = load("record")
local fit = lsq(matrix{record.u, ones(#record.u)}, record.y)
answer("stiffness", 1/fit.theta[1])
answer("noise", std(record.y - fit.theta[1]*record.u - fit.theta[2]))
)LUA";

constexpr const char* kHints = R"(# Question 1

1. Draw a straight line through the origin by hand: what is its slope?
2. With one unknown, least squares is a sum of products divided by a sum of squares.

# Question 2

1. Subtract the elongation that the model computes from the measured elongation.
)";

constexpr const char* kFrenchTasks = R"LUA(-- ---
-- title: La raideur d'un ressort
-- subtitle: Une leçon à vous
-- language: fr
-- ---

-- %% [markdown]
-- On a chargé un ressort de forces connues et mesuré son allongement. Quelle est sa raideur, et la connaît-on bien ?
--
-- # L'enregistrement
--
-- `record.csv` contient la force `u` en newtons et l'allongement `y` en millimètres.

-- %% [markdown]
-- ![L'allongement en fonction de la force.](figure:record){#fig:record}
--
-- **Question 1.** Quelle est la raideur du ressort (@fig:record), en N/mm ? L'allongement vaut $y = u/k + e$ ; servez-vous des moindres carrés.

-- %% [markdown]
-- BEGIN SOLUTION
-- La raideur vaut `stiffness`{.value} N/mm.
-- END SOLUTION
--
-- **Question 2.** Quel est l'écart type des erreurs de mesure, en millimètres ?

-- %% [markdown]
-- # Ce qu'on a appris
--
-- Un paramètre d'un modèle linéaire est un quotient de sommes, et ce qui reste dit jusqu'où s'y fier.
)LUA";

constexpr const char* kFrenchHints = R"(# Question 1

1. Tracez à la main une droite par l'origine : quelle est sa pente ?
2. Pour une seule inconnue, les moindres carrés divisent une somme de produits par une somme de carrés.

# Question 2

1. Retranchez de l'allongement ce que le modèle fait de la force.
)";

constexpr const char* kFrenchChecks = R"(# What checks.lua says, in French.
msgid ""
msgstr ""
"Project-Id-Version: dynlab\n"
"Language: fr\n"
"MIME-Version: 1.0\n"
"Content-Type: text/plain; charset=UTF-8\n"
"Content-Transfer-Encoding: 8bit\n"

msgid "The stiffness of the spring"
msgstr "La raideur du ressort"

msgid "This is the compliance in mm/N; the stiffness is its inverse."
msgstr "C'est la souplesse en mm/N ; la raideur en est l'inverse."

msgid "Which of the two, force or elongation, is divided by the other?"
msgstr "Laquelle des deux, force ou allongement, divise l'autre ?"

msgid "The measurement errors"
msgstr "Les erreurs de mesure"

msgid "How large are the residuals of the model?"
msgstr "Que laisse le modèle ?"
)";

/// 24 loadings of a spring of 2.5 N/mm; the errors come from no random numbers, so that the file is the same
/// everywhere.
std::string spring_data() {
    std::string csv = "u (N),y (mm)\n";
    for (int k = 1; k <= 24; ++k) {
        const double u = 0.5 * k, error = 0.08 * std::sin(2.4 * k * k);
        csv += fmt::format("{:.1f},{:.3f}\n", u, u / 2.5 + error);
    }
    return csv;
}

}  // namespace

std::vector<std::string> make_lesson_skeleton(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    const std::string slug = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
    if (!is_name("_" + slug))
        throw EnvironmentError("'{}' is not a valid lesson name: use letters, digits, _ and -, as in 08_springs", slug);
    const std::map<std::string, std::string> files = {{"lesson.lua", replaced(kLesson, "SLUG", slug)},
                                                      {"record.csv", spring_data()},
                                                      {"checks.lua", kChecks},
                                                      {"wrong_compliance.lua", kWrong},
                                                      {"right_other_methods.lua", kRight},
                                                      {"hints.md", kHints},
                                                      {"tasks.fr.lua", kFrenchTasks},
                                                      {"hints.fr.md", kFrenchHints},
                                                      {"checks.fr.po", kFrenchChecks}};
    std::vector<std::string> names;
    make_complete_folder(folder, [&](const fs::path& growing) {
        for (const auto& [name, text] : files) {
            write_file_atomically(growing / name, text);
            names.push_back(name);
        }
    });
    return names;
}

}  // namespace dynlab::inline workflow
