# popup_embed(SOURCES FOLDER ENDS HEADER SPACE FILE TABLE): adds to the list SOURCES the source of a table of files. It
# defines SPACE::TABLE(), which HEADER declares, with the texts of the files of src/FOLDER, or of a folder of the
# system, whose names end in one of ENDS; embed_files.cmake writes it, anew when one of the files changes.
set(POPUP_EMBED_FILES ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)
function(popup_embed sources folder ends header space file table)
  cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src OUTPUT_VARIABLE from)
  set(patterns ${ends})
  list(TRANSFORM patterns PREPEND "${from}/*")
  file(GLOB files CONFIGURE_DEPENDS ${patterns})
  set(output ${PROJECT_BINARY_DIR}/${table}.cpp)
  add_custom_command(OUTPUT ${output}
                     COMMAND ${CMAKE_COMMAND} -D FOLDER=${from} "-DENDS=${ends}" -D HEADER=${header} -D SPACE=${space}
                             -D FILE=${file} -D TABLE=${table} -D OUTPUT=${output} -P ${POPUP_EMBED_FILES}
                     DEPENDS ${files} ${POPUP_EMBED_FILES}
                     COMMENT "Embedding files of ${from}" VERBATIM)
  set(${sources} ${${sources}} ${output} PARENT_SCOPE)
endfunction()
