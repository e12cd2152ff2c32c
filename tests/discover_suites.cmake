# Writes for ctest one test a suite of a program made with GoogleTest; suites whose name begins with "Long" have the
# label `long`. Those that take longest begin first, so that none runs on alone at the end.
# cmake -D PROGRAM=… -D FILE=… [-D PREFIX=…] [-D EXCEPT=…] [-D TOGETHER=…] -P discover_suites.cmake
# PREFIX: what the names of the tests begin with; EXCEPT: a pattern of suites that are left out; TOGETHER: how many of
# those that do not take long are one test, FIRST_to_LAST, where the program takes longer to start than they do to run.
cmake_minimum_required(VERSION 3.25)
# What suites take in seconds, under the sanitizers or in Release, where they take longer; others take less than five.
set(seconds
    LargePatterns=70 Shipped/SampleOutputs=69 Cli=64 Batch=59 Shipped/Sample=54 Programs=45 Collisions=41
    Gallery=40 Samples=38 Shipped/FlatlangSample=35 Config=34 BaselineFiles=32 Watch=30 Jobserver=29
    Overwriting=28 MachineOrder=27 Tour=27 BadInput=25 FlatLangPieces=24 GalleryInABrowser=23 Trace=22
    DrawnCard=21 FlatlangKitGear=21 RandomEdits=21 Fold=20 FormatsOfRuns=19 Motion=19 Shells/Completions=19
    Collision=18 DrawingRun=18 FortyPanels=18 LivePage=18 View=18 Assemble=17 DxfRoundTrip=17 Forced=17 Gltf=17
    Kinds/JobserverOf=17 LoadedFiles=17 AssemblyReading=15 CardsFoldedBack=15 Defaults=15 Docs/DocPage=15
    Drawing=15 LiveServer=15 Progress=15 DxfFuzz=14 Faults=14 Measures=14 Analysis=13 Dependencies=13
    EditDrawing=13 FlatLangVectors=13 AnyPattern=12 OutlineFuzz=12 Allow=11 Shipped/SampleDrawing=11 EveryRow=10
    ExaminationMemory=10 KitCartons=10 MachineOrderOfSamples=10 Manual=10 Nest=10 ResponseFiles=10 Check=9
    DrawnOutline=9 Fix=9 FlatLangParse=9 Kills=9 DrawnCardFuzz=8 FlatLangCard=8 Layout=8 Mistakes=8
    VerbManuals=8 ViewerLooks=8 ViewerOfSamples=8 Book=7 FlatLangLimits=7 FlatlangKit=7 FreeCollisions=7
    Gluing=7 KerfLimits=7 Oa=7 Parts=7 Samples/ViewerInABrowser=7 Schema=7 TiledPdf=7 XmlWriter=7 ClosedCard=6
    DeniedEdits=6 DxfBlocks=6 FlatLangHostile=6 FlatLangRunFuzz=6 MirroredDesign=6 Oa/OaShared=6 OaFuzz=6
    Regions=6 RenderText=6 RoundTrip=6 Samples/BookOfASample=6 SamplesWithMake=6 UnifiedDiff=6 ViewerStill=6
    Kinds/PdfPicture=5 ProductionPdf=5 Samples/StillRays=5 WrongSide=5)
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
# Adds the suites as one test.
function(add_suites name cost)
  set(properties "COST ${cost}")
  if(name MATCHES "(^|/)Long")
    string(APPEND properties " LABELS long TIMEOUT 3000")
  else()
    string(APPEND properties " TIMEOUT 900")
  endif()
  list(TRANSFORM ARGN APPEND ".*")
  list(JOIN ARGN ":" filter)
  string(APPEND tests "add_test([=[${PREFIX}${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}]=])\n"
                      "set_tests_properties([=[${PREFIX}${name}]=] PROPERTIES ${properties})\n")
  set(tests "${tests}" PARENT_SCOPE)
endfunction()
# Adds the suites of the list `few`, and empties it.
macro(add_few)
  list(LENGTH few count)
  if(count GREATER 0)
    list(GET few 0 first)
    list(GET few -1 last)
    if(count GREATER 1)
      string(APPEND first "_to_${last}")
    endif()
    add_suites("${first}" ${count} ${few})
    set(few "")
  endif()
endmacro()
if(NOT TOGETHER)
  set(TOGETHER 1)
endif()
set(few "")
foreach(suite IN LISTS suites)
  if(EXCEPT AND "${suite}" MATCHES "${EXCEPT}")
    continue()
  endif()
  if("${seconds}" MATCHES "(^|;)${suite}=([0-9]+)")
    add_suites("${suite}" ${CMAKE_MATCH_2} "${suite}")
  elseif(suite MATCHES "(^|/)Long")
    add_suites("${suite}" 1 "${suite}")
  else()
    list(APPEND few "${suite}")
    list(LENGTH few count)
    if(count EQUAL TOGETHER)
      add_few()
    endif()
  endif()
endforeach()
add_few()
file(WRITE ${FILE} "${tests}")
