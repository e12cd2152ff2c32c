# Writes for ctest one test a suite of a program made with GoogleTest; suites whose name begins with "Long" have the
# label `long`.
# cmake -D PROGRAM=… -D FILE=… -P discover_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${list}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()
set(tests "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[\n.]" "" suite "${suite}")
  set(properties "TIMEOUT 900")
  if(suite MATCHES "(^|/)Long")
    set(properties "LABELS long TIMEOUT 3000")
  endif()
  string(APPEND tests "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
                      "set_tests_properties([=[${suite}]=] PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${FILE} "${tests}")
