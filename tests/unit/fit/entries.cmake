# Too long for every edit: many fits of many structures.
set_tests_properties(structure_advice delay_scan PROPERTIES LABELS unit)
set_tests_properties(structure_advice PROPERTIES COST 15)
