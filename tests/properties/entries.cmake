# Too long for every edit.
set_tests_properties(process_properties PROPERTIES LABELS properties)
