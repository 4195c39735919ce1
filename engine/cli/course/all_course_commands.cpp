#include "cli/commands.h"

namespace dynlab::inline cli {

Commands course_commands() {
    return {add_check,         add_pack,    add_bundle,  add_verify, add_checks,      add_grade, add_gradescope,
            add_export_grades, add_similar, add_answers, add_course, add_test_lesson, add_study, add_sandboxed_version};
}

}  // namespace dynlab::inline cli
