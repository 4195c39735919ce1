# Pages in a browser take long: they start first, so that no processor waits for the last of them.
set_tests_properties(${suites} PROPERTIES COST 60)
set_tests_properties(kernel_of_many_cells PROPERTIES LABELS long)
