// The headers that every test includes are compiled with this source; see tests/CMakeLists.txt.
