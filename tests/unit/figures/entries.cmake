# Too long for every edit: gnuplot draws many figures.
set_tests_properties(style gnuplot_renderer gnuplot_renderer_replaced PROPERTIES LABELS unit)
