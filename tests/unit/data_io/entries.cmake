# Too long for every edit: thousands of damaged files, archives that unpack without end.
set_tests_properties(mat_mutations workbook PROPERTIES LABELS unit)
set_tests_properties(mat_mutations PROPERTIES COST 20)
