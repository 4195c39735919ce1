# How single sources of course are compiled; included by engine/CMakeLists.txt.

# The linker takes them one by one: runs in sandboxes need neither archives nor documents.
set_source_files_properties(course/sandbox_jobs/sandboxed_document.cpp course/sandbox_jobs/unpack.cpp
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# What compares each script of a class with every other one.
dynlab_optimized(course/similarity/class_similarity.cpp course/similarity/fingerprints.cpp course/similarity/similarity.cpp)
