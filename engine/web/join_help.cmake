# Writes the help pages into one file, as web/scripting/fetched_help.cpp reads it: a line with the name of each, its text, a form feed:
# cmake -DFILES=file|file -DOUTPUT=file -P join_help.cmake
string(REPLACE "|" ";" FILES "${FILES}")
list(SORT FILES COMPARE FILE_BASENAME)
set(text "")
foreach(page IN LISTS FILES)
  get_filename_component(name ${page} NAME)
  string(REGEX REPLACE "\\.md$" "" name ${name})
  file(READ ${page} content)
  string(ASCII 12 feed)
  string(APPEND text "${name}\n${content}${feed}")
endforeach()
file(WRITE ${OUTPUT} "${text}")
