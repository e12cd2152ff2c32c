# What `cmake --install` puts where: the program, the library with its headers and CMake package, the manual pages,
# the document's schema, and the scripts for clusters.
include(CMakePackageConfigHelpers)

set(POPUP_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/popup)

install(TARGETS popupc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS popup EXPORT popup-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/popup DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")

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
