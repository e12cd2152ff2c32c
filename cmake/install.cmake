# What `cmake --install` puts where: the program, the library with its headers and CMake package, the manual pages,
# what shells complete its command lines by, the document's schema, and the scripts for clusters.
include(CMakePackageConfigHelpers)

set(POPUP_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/popup)

install(TARGETS popupc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS popup EXPORT popup-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/popup DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")

# The program knows its options itself. One for another machine cannot be asked.
if(NOT CMAKE_CROSSCOMPILING)
  set(POPUP_COMPLETIONS ${PROJECT_BINARY_DIR}/completions)
  file(MAKE_DIRECTORY ${POPUP_COMPLETIONS})
  add_custom_command(OUTPUT ${POPUP_COMPLETIONS}/popupc ${POPUP_COMPLETIONS}/_popupc ${POPUP_COMPLETIONS}/popupc.fish
                     COMMAND popupc completions bash > ${POPUP_COMPLETIONS}/popupc
                     COMMAND popupc completions zsh > ${POPUP_COMPLETIONS}/_popupc
                     COMMAND popupc completions fish > ${POPUP_COMPLETIONS}/popupc.fish
                     DEPENDS popupc VERBATIM)
  add_custom_target(popup_completions ALL DEPENDS ${POPUP_COMPLETIONS}/popupc)
  install(FILES ${POPUP_COMPLETIONS}/popupc DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${POPUP_COMPLETIONS}/_popupc DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${POPUP_COMPLETIONS}/popupc.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()

install(EXPORT popup-targets FILE popup-targets.cmake NAMESPACE popup:: DESTINATION ${POPUP_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/popup-config.cmake.in
                              ${PROJECT_BINARY_DIR}/popup-config.cmake
                              INSTALL_DESTINATION ${POPUP_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/popup-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/popup-config.cmake ${PROJECT_BINARY_DIR}/popup-config-version.cmake
        DESTINATION ${POPUP_PACKAGE_DIR})

foreach(section 1 5 7)
  file(GLOB POPUP_MAN_PAGES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/man/*.${section})
  install(FILES ${POPUP_MAN_PAGES} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section})
endforeach()
file(GLOB POPUP_SCHEMAS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/schemas/*.xsd)
install(FILES ${POPUP_SCHEMAS} DESTINATION ${CMAKE_INSTALL_DATADIR}/popupc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/samples/cluster DESTINATION ${CMAKE_INSTALL_DATADIR}/popupc
        USE_SOURCE_PERMISSIONS)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
