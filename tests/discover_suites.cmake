# Writes for ctest one test a suite of a program made with GoogleTest; suites whose name begins with "Long" have the
# label `long`. Those that take longest begin first, so that none runs on alone at the end.
# cmake -D PROGRAM=… -D FILE=… [-D PREFIX=…] [-D EXCEPT=…] -P discover_suites.cmake
# PREFIX: what the names of the tests begin with; EXCEPT: a pattern of suites that are left out.
cmake_minimum_required(VERSION 3.25)
# What suites take under the sanitizers, in seconds of CPU, or in Release those that run there alone; others take less
# than five.
set(seconds
    Shipped/Sample=57 Shipped/SampleOutputs=50 Collisions=49 Watch=37 Cli=36 Samples=33 DrawnCard=28 Motion=27
    Collision=27 Forced=24 Progress=22 Config=22 CardsFoldedBack=21 FlatLangPieces=18 BadInput=18 Trace=16
    Shipped/FlatlangSample=16 AssemblyReading=16 Allow=16 Batch=15 Kinds/JobserverOf=14 Shells/Completions=13
    Fold=13 MachineOrderOfSamples=12 Jobserver=12 FlatlangKitGear=12 Drawing=12 Docs/DocPage=12 OutlineFuzz=11
    Layout=11 Oa=10 Assemble=9 RoundTrip=8 ClosedCard=8 BaselineFiles=8 Shipped/SampleDrawing=7 Programs=7 Parts=7
    Nest=7 MirroredDesign=7 MachineOrder=7 DrawingRun=7 Tour=6 EveryRow=6 Check=6 SamplesWithMake=5 KerfLimits=5
    Gltf=5 FlatLangCard=5 DrawnCardFuzz=5 Dependencies=5)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
# Parameters stand behind a # and may hold anything.
string(REGEX REPLACE " *#[^\n]*" "" list "${list}")
string(REPLACE "\n" ";" lines "${list}")
set(suites "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.$")
    list(APPEND suites ${CMAKE_MATCH_1})
  endif()
endforeach()
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} has no tests")
endif()
set(tests "")
foreach(suite IN LISTS suites)
  if(EXCEPT AND "${suite}" MATCHES "${EXCEPT}")
    continue()
  endif()
  set(cost 1)
  if("${seconds}" MATCHES "(^|;)${suite}=([0-9]+)")
    set(cost ${CMAKE_MATCH_2})
  endif()
  set(properties "COST ${cost}")
  if(suite MATCHES "(^|/)Long")
    string(APPEND properties " LABELS long TIMEOUT 3000")
  else()
    string(APPEND properties " TIMEOUT 900")
  endif()
  string(APPEND tests "add_test([=[${PREFIX}${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
                      "set_tests_properties([=[${PREFIX}${suite}]=] PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${FILE} "${tests}")
