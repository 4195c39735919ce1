# The Debian package: what belongs into it beside programs and data, and what CPack is told. Included for portable builds.
set(files ${CMAKE_CURRENT_LIST_DIR})
set(made ${CMAKE_BINARY_DIR}/packaging)

# The manual is made by the program from its own help. Debian wants it packed, and the same bytes each time.
file(READ ${files}/changelog changelog)
string(REGEX MATCH "^dynlab \\(([^)]+)\\)" changelog_begins "${changelog}")
if(NOT CMAKE_MATCH_1 STREQUAL PROJECT_VERSION)
  message(FATAL_ERROR "scripts/packaging/changelog begins with version ${CMAKE_MATCH_1}, the project's is ${PROJECT_VERSION}")
endif()
add_custom_command(OUTPUT ${made}/done
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${made}
  COMMAND dynlab man-pages ${made}/man1
  COMMAND sh -c "gzip -9n ${made}/man1/*.1 && gzip -9nc ${files}/changelog >${made}/changelog.gz && touch ${made}/done"
  DEPENDS dynlab_programs ${files}/changelog VERBATIM)
add_custom_target(dynlab_packaging ALL DEPENDS ${made}/done)

install(DIRECTORY ${made}/man1 DESTINATION share/man)
install(FILES ${made}/changelog.gz ${files}/copyright DESTINATION share/doc/dynlab)
install(FILES ${files}/completions/dynlab.bash DESTINATION share/bash-completion/completions RENAME dynlab)
install(FILES ${files}/completions/dynlab.zsh DESTINATION share/zsh/vendor-completions RENAME _dynlab)
install(FILES ${files}/completions/dynlab.fish DESTINATION share/fish/vendor_completions.d)
install(FILES ${files}/dynlab.desktop DESTINATION share/applications)
install(FILES ${PROJECT_SOURCE_DIR}/report_templates/html/dynlab.svg DESTINATION share/icons/hicolor/scalable/apps)

# What runs it, as scripts/packages.txt lists it; the libraries are found in the programs. libmatio is loaded by name.
# Without a processor of x86-64-v2 it would end with "illegal instruction": sse4.2-support refuses those.
file(STRINGS ${PROJECT_SOURCE_DIR}/scripts/packages.txt lines REGEX "^run ")
foreach(line ${lines})
  separate_arguments(words UNIX_COMMAND "${line}")
  list(POP_FRONT words)
  list(APPEND needed ${words})
endforeach()
file(REAL_PATH ${pkgcfg_lib_MATIO_matio} matio_library)
string(REGEX REPLACE ".*/(libmatio)\\.so\\.([0-9]+).*" "\\1\\2" matio_package ${matio_library})
# Without them dynlab says what to install: measured records, French, the editor of pages, sandboxes, review copies.
set(recommended libslicot-doc texlive-lang-french libjs-codemirror bubblewrap ghostscript)
list(REMOVE_ITEM needed ${recommended})
list(JOIN needed ", " needed)
list(JOIN recommended ", " recommended)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dynlab)
set(CPACK_PACKAGE_CONTACT "the dynlab authors <dynlab@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "laboratory course on data-driven learning of dynamical systems")
set(CPACK_PACKAGE_DESCRIPTION "Continuous-time system identification from step responses to refined
instrumental variables: every lesson is a script in Lua that loads data, fits
models and draws figures; one command turns it into a PDF in which every number
and every figure comes from the run. With a workbench in the browser, checks of
reports, grading of a class and anonymous peer review.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib/dynlab)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${matio_package}, ${needed}")
set(CPACK_DEBIAN_PACKAGE_PREDEPENDS sse4.2-support)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "${recommended}")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "texlive-luatex, fonts-noto-core, fonts-noto-cjk")  # names in all scripts
include(CPack)
