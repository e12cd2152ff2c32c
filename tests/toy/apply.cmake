# Applies PATCH to copies, below SCRATCH, of those files of SOURCE that the toy element's program is compiled from.
# cmake -D SOURCE=… -D SCRATCH=… -D PATCH=… -P apply.cmake
file(REMOVE_RECURSE ${SCRATCH})
file(STRINGS ${PATCH} headers REGEX "^\\+\\+\\+ b/")
list(TRANSFORM headers REPLACE "^\\+\\+\\+ b/" "")
foreach(file ${headers} src/mechanism/registry.cpp)
  if(EXISTS ${SOURCE}/${file})
    configure_file(${SOURCE}/${file} ${SCRATCH}/${file} COPYONLY)
  endif()
endforeach()
execute_process(COMMAND patch --batch --forward -p1 -i ${PATCH} WORKING_DIRECTORY ${SCRATCH}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the patch does not apply any more:\n${output}")
endif()
