# Installs into an empty directory, then builds and runs a project that knows nothing but that directory.
# cmake -D BUILD=… -D SCRATCH=… -D SOURCE=… -D COMPILER=… -P run.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${SCRATCH})
set(prefix ${SCRATCH}/prefix)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
foreach(file bin/popupc include/popup/compile.h include/popup/write.h share/man/man1/popupc.1 share/man/man1/popupc-build.1 share/man/man5/popup.5 share/man/man7/popupc-cluster.7
        share/man/man7/popupc-flatlang.7
        share/popupc/popup.xsd share/popupc/cluster/submit.sh share/bash-completion/completions/popupc share/zsh/site-functions/_popupc
        share/fish/vendor_completions.d/popupc.fish)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
run(${prefix}/bin/popupc --version)
# Moved after installing: nothing in the package may remember where it was built.
file(RENAME ${prefix} ${SCRATCH}/elsewhere)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${SCRATCH}/elsewhere
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)

# The library writes what the program writes: the same files, with the same bytes.
set(document ${SOURCE}/../../samples/layers.xml)
file(MAKE_DIRECTORY ${SCRATCH}/library ${SCRATCH}/program)
run(${SCRATCH}/build/consumer ${document} ${SCRATCH}/library)
set(card ${SCRATCH}/program/card)
run(${SCRATCH}/elsewhere/bin/popupc build ${document} --copies 4 --sheet a3 --profile k40 --reference 100
    -o ${card}.svg -o ${card}.pdf -o ${card}.glb -o ${card}.json)
file(GLOB written RELATIVE ${SCRATCH}/library ${SCRATCH}/library/*)
file(GLOB expected RELATIVE ${SCRATCH}/program ${SCRATCH}/program/*)
if(NOT written STREQUAL expected OR NOT "card-2.svg" IN_LIST expected)
  message(FATAL_ERROR "the library wrote ${written}, the program ${expected}")
endif()
foreach(file ${expected})
  run(${CMAKE_COMMAND} -E compare_files ${SCRATCH}/library/${file} ${SCRATCH}/program/${file})
endforeach()
