# How single sources of numerics are compiled; included by engine/CMakeLists.txt.

# Random numbers are equal on every machine: no multiplication may be fused with an addition there.
set_source_files_properties(numerics/signals/random.cpp numerics/signals/box_muller.cpp
                            PROPERTIES COMPILE_OPTIONS -ffp-contract=off SKIP_PRECOMPILE_HEADERS ON)
# By itself: what it says depends on nothing but the options that it is compiled with.
set_source_files_properties(numerics/linalg/processor_level.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# Sources whose templates are many by themselves: with others they would keep one core busy while the rest waits.
set_source_files_properties(numerics/filters/delta_loops.cpp numerics/linalg/decompositions.cpp
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
