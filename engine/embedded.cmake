# dynlab_embedded(LAYER HEADER TYPE FUNCTION patterns...): files of this folder become part of a layer, each a TYPE of those that
# FUNCTION of HEADER gives.
set(embedding_folder ${CMAKE_CURRENT_LIST_DIR})
function(dynlab_embedded layer header type function)
  list(TRANSFORM ARGN PREPEND ${embedding_folder}/)
  file(GLOB files CONFIGURE_DEPENDS ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  list(JOIN ARGN "|" patterns)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DLAYER=${layer} -DHEADER=${header} -DTYPE=${type} -DFUNCTION=${function}
            "-DFILES=${patterns}" -DOUTPUT=${source} -P ${embedding_folder}/embed_pages.cmake
    DEPENDS ${files} ${embedding_folder}/embed_pages.cmake
    VERBATIM)
  target_sources(dynlab_${layer} PRIVATE ${source})
endfunction()
