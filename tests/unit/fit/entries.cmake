# Too long for every edit: many fits of many structures.
set_tests_properties(missed_structure delay_scan PROPERTIES LABELS unit)
set_tests_properties(missed_structure PROPERTIES COST 15)
