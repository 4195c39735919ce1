# Too long for every edit; the first of them are the longest suites of all, so they start first.
set_tests_properties(delay_profile advice delay_search order_selection PROPERTIES LABELS unit)
set_tests_properties(delay_profile advice delay_search PROPERTIES COST 100)
