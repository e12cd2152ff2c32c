# Sources compiled in batches: most of what g++ does for a small file, it does for the headers and for the templates that
# its neighbours instantiate too. batches.py says which may stand in one batch.
if(POPUP_BATCHES)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()
set(POPUP_BATCHES_PY ${CMAKE_CURRENT_LIST_DIR}/batches.py)

# popup_batches(OUT NAME FILE...): sets OUT to sources that compile the files in batches, in the build's folder
# batches/NAME. Where POPUP_BATCHES is off, OUT is the files.
function(popup_batches out name)
  set(sources "${ARGN}")
  if(POPUP_BATCHES)
    set(folder ${PROJECT_BINARY_DIR}/batches/${name})
    execute_process(COMMAND ${Python3_EXECUTABLE} ${POPUP_BATCHES_PY} ${PROJECT_SOURCE_DIR} ${folder} ${ARGN}
                    OUTPUT_VARIABLE sources COMMAND_ERROR_IS_FATAL ANY)
    # A name that comes or goes may move its file to another batch.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN} ${POPUP_BATCHES_PY})
    set(batches ${sources})
    list(FILTER batches INCLUDE REGEX "^${folder}/")
    # Types of unnamed namespaces in those of a header: none but this file defines the latter. And what g++ 12 believes of
    # arrays where it inlines a lot (GCC bug 105562).
    set_source_files_properties(${batches} PROPERTIES COMPILE_OPTIONS
                                "$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;-Wno-array-bounds>")
  endif()
  set(${out} "${sources}" PARENT_SCOPE)
endfunction()

# popup_precompile(TARGET): in batches, compiles ahead what most files of TARGET include of the C++ library and fmt: a
# batch has half a second less to read. It may hide a missing include, as batches do. Not for what has warnings:
# optimized, g++ 12 warns of what it sees in headers that are compiled ahead, whatever warnings are off.
function(popup_precompile target)
  if(POPUP_BATCHES)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <charconv> <cmath> <cstddef> <cstdint> <filesystem>
                              <functional> <iterator> <limits> <map> <memory> <numbers> <numeric> <optional> <set>
                              <span> <string> <string_view> <system_error> <tuple> <unordered_map> <utility> <variant>
                              <vector> <fmt/format.h>)
  endif()
endfunction()
