# Too long for every edit: stiff equations.
set_tests_properties(grey_simulation PROPERTIES LABELS unit)
