# A number for the sources by which files are read: what was kept of a file is of use to programs that
# read it as it was read then. cmake -DROOT=<timeseries> -DOUT=<header> -P readers_version.cmake
file(GLOB_RECURSE sources ${ROOT}/grid/*.h ${ROOT}/grid/*.cpp ${ROOT}/readers/*.h ${ROOT}/readers/*.cpp)
list(SORT sources)
set(all "")
foreach(source IN LISTS sources)
  file(SHA256 ${source} hash)
  string(APPEND all ${hash})
endforeach()
string(SHA256 version "${all}")
string(SUBSTRING ${version} 0 16 version)
file(WRITE ${OUT} "constexpr const char* kReadersVersion = \"${version}\";\n")
