# How single sources of figures are compiled; included by engine/CMakeLists.txt.

# What looks at each sample of a curve.
dynlab_optimized(figures/axis.cpp figures/curve_traces.cpp figures/decimation.cpp figures/panel_axes.cpp)
