# How single sources of app are compiled; included by engine/CMakeLists.txt.

# Templates of httplib and zmq are many by themselves.
set_source_files_properties(app/server/web_server.cpp app/server/page_connections.cpp app/kernel/kernel.cpp
  PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
