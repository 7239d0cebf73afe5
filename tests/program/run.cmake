# What ./run tells the program of how it was called, in a tree where nothing is to be installed or
# built: cmake -DRUN= -DWORK= -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/functions.cmake)
set(tree "${WORK}/a tree")
file(MAKE_DIRECTORY ${WORK}/elsewhere ${tree}/.ci ${tree}/build/release/app)
file(COPY ${RUN} DESTINATION ${tree})
file(TOUCH ${tree}/build/release/build.ninja)
file(WRITE ${tree}/.ci/setup.sh [[
caller=$PWD
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit 1
installPackages() { packages=$*; }
configure() { choices=$*; }
build() { echo "$packages | ${choices:-} | $*" >"$root/built"; }
]])
file(WRITE ${tree}/build/release/app/isochron [[
#!/bin/sh
echo "$ISOCHRON_RUN, $(basename "$PWD"), $*"
]])
file(CHMOD ${tree}/build/release/app/isochron PERMISSIONS OWNER_READ OWNER_EXECUTE)

# expectCall(FOLDER COMMAND SAID): what the program says when a shell in the folder runs the command.
function(expectCall folder command said)
  run("sh -c [==[cd '${WORK}/${folder}' && ${command}]==]")
  if(NOT code EQUAL 0 OR NOT out STREQUAL "${said}\n")
    fail("expected ${said}")
  endif()
endfunction()
expectCall(elsewhere "'../a tree/run' info x.nc" "../a tree/run, elsewhere, info x.nc")
expectCall("a tree" "./run info x.nc" "./run, a tree, info x.nc")
expectCall("a tree" "bash run info x.nc" "./run, a tree, info x.nc")
expectCall(elsewhere "'${tree}/run' info x.nc" "${tree}/run, elsewhere, info x.nc")

# What is installed, how it is configured and what is built: expectBuilt(COMMAND TEXT).
function(expectBuilt command text)
  expectCall("a tree" "${command} info x.nc" "./run, a tree, info x.nc")
  file(READ "${tree}/built" built)
  if(NOT built STREQUAL "${text}\n")
    fail("expected ${text}, found ${built}")
  endif()
endfunction()
expectBuilt("./run" "base |  | release isochron")
expectBuilt("./run --with-vtk" "base vtk | release -DISOCHRON_VTK=ON | release isochron")
expectBuilt("./run --with-mpi --with-vtk"
            "base mpi vtk | release -DISOCHRON_MPI=ON -DISOCHRON_VTK=ON | release isochron")
# What MPI's programs need is built where it was configured, now or once.
file(WRITE "${tree}/build/release/CMakeCache.txt" "ISOCHRON_MPI:STRING=ON\n")
expectBuilt("./run" "base |  | release isochron isochron_step wave")
