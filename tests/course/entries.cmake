# Each lesson by itself: all of them one after the other would be the last that ends. LABELS "repeats" is what
# scripts/test --sanitize leaves out, for it repeats for long what other tests run.
file(GLOB lessons RELATIVE ${PROJECT_SOURCE_DIR}/lessons CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lessons/*/checks.lua)
list(TRANSFORM lessons REPLACE "/.*" "")
foreach(lesson ${lessons})
  foreach(suite check_tolerances lesson_checks)
    dynlab_entry(${suite}.${lesson} ${name} "*/${suite}.*/${lesson}" "${labels};repeats")
    list(APPEND suites ${suite}.${lesson})
  endforeach()
endforeach()
dynlab_entry(own_records ${name} "own_records.*" "${labels}")
foreach(lesson 03_crane 05_thruster 07_feedback)
  dynlab_entry(own_records.${lesson} ${name} "*/own_records.*/${lesson}" "${labels};repeats")
  list(APPEND suites own_records.${lesson})
endforeach()
# Grading lesson 05 keeps two processors busy: beside another such entry it would miss its time.
set_tests_properties(check_tolerances.05_thruster lesson_checks.05_thruster own_records.05_thruster own_records_of_many
                     PROPERTIES PROCESSORS 2)
set_tests_properties(own_records_of_many PROPERTIES LABELS long TIMEOUT 14400)
set_tests_properties(time_of_submissions PROPERTIES PROCESSORS 2)  # its other processes keep all of them busy
# Classes take long: they start first, so that no processor waits for the last of them.
set_tests_properties(${suites} PROPERTIES COST 60)
set_tests_properties(instructor_guide_marks PROPERTIES LABELS "${labels};repeats")

dynlab_entry(course_faults.every_place ${name} "course_faults.*" long)
set_tests_properties(course_faults.every_place PROPERTIES TIMEOUT 7200)
set_property(TEST course_faults.every_place APPEND PROPERTY ENVIRONMENT DYNLAB_EVERY_PLACE=1)
