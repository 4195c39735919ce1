# Portable builds: all code runs on x86-64-v2 (processors from 2009 on), and numerics, a shared library then, is compiled
# for v3 (AVX2) and v4 (AVX-512), too. Those lie in glibc-hwcaps/ beside it, and the loader takes the best that the
# processor knows (glibc's ld.so(8)).
set(exports ${CMAKE_CURRENT_SOURCE_DIR}/numerics/exported_symbols.map)

# A library's templates are its own (-Bsymbolic and the list of what it exports): those of the program are compiled for
# other processors.
function(dynlab_numerics_library library folder)
  target_compile_options(${library} PRIVATE -fno-semantic-interposition)
  target_link_options(${library} PRIVATE -Wl,-Bsymbolic -Wl,--version-script=${exports} -Wl,--no-undefined)
  set_target_properties(${library} PROPERTIES OUTPUT_NAME dynlab_numerics LINK_DEPENDS ${exports}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/dynlab${folder})
  install(TARGETS ${library} LIBRARY DESTINATION lib/dynlab${folder})
endfunction()

dynlab_numerics_library(dynlab_numerics "")
get_target_property(numerics_sources dynlab_numerics SOURCES)
foreach(level v3 v4)
  set(library dynlab_numerics_${level})
  add_library(${library} SHARED ${numerics_sources})
  dynlab_compiled(${library})
  target_include_directories(${library} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_options(${library} PRIVATE $<$<CONFIG:Release>:-O3> -march=x86-64-${level})
  target_link_libraries(${library} PRIVATE Eigen3::Eigen TBB::tbb)
  target_precompile_headers(${library} PRIVATE ${standard_headers} <Eigen/Core>)
  dynlab_numerics_library(${library} /glibc-hwcaps/x86-64-${level})
  add_dependencies(dynlab_numerics ${library})
endforeach()

set(CMAKE_INSTALL_RPATH "$ORIGIN/../lib/dynlab")
