# Too long for every edit.
set_tests_properties(delta_regression PROPERTIES LABELS unit)
