# How single sources of app are compiled; included by engine/CMakeLists.txt.

# Templates of Boost.Beast and zmq are many by themselves.
set_source_files_properties(app/server/http_connection.cpp app/kernel/kernel.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
