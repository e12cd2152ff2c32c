# popup_link_archives(TARGET): of the libraries that the program TARGET needs, those that Debian ships as archives become
# part of it. A shared library costs each start some ten system calls, the pages that the loader mends in it and the
# symbols it looks up; half of them nothing of popupc ever calls: cairo's connection to X, gnutls' to smart cards.
# The program then has the versions that it was built with: build it again when one of them is mended.
#
# Libraries that have no archive stay shared, and so do those that GEOS loads anyway. Where one archive is missing, all
# stay shared. gnutls, of which qpdf needs its digests alone, is not loaded at all (cmake/qpdf_digests.cpp).
function(popup_link_archives target)
  set(archives)
  foreach(name qpdf cairo pixman-1 fontconfig expat freetype brotlidec brotlicommon png16 turbojpeg jpeg webpmux webp
               gif exif fribidi csv z nettle)
    find_library(POPUP_ARCHIVE_${name} ${CMAKE_STATIC_LIBRARY_PREFIX}${name}${CMAKE_STATIC_LIBRARY_SUFFIX})
    mark_as_advanced(POPUP_ARCHIVE_${name})
    if(NOT POPUP_ARCHIVE_${name})
      message(STATUS "No archive of ${name}: ${target} links shared libraries, and starts slower")
      return()
    endif()
    list(APPEND archives ${POPUP_ARCHIVE_${name}})
  endforeach()
  target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/qpdf_digests.cpp)
  # The libraries that `popup` names follow on the command line; --as-needed drops those that the archives replace.
  target_link_libraries(${target} PRIVATE popup -Wl,--as-needed -Wl,--start-group ${archives} -Wl,--end-group)
endfunction()
