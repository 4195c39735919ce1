# Too long for every edit: many fits of many structures.
set_tests_properties(missed_options delay_scan PROPERTIES LABELS unit)
set_tests_properties(missed_options PROPERTIES COST 15)
