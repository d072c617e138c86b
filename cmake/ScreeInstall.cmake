# What `cmake --install` puts where, by component: server (with all that its operator needs beside it), tools, viewer,
# client (the C library for programs that run), dev (its header and packages for programs that are built), cpp (the static
# libraries and headers for hosts in C++), web (the page), python (the module; only Debian's package has it, whose Python
# finds it there). Debian's packages are made of the same components (ScreePackages.cmake).
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE AND CMAKE_INSTALL_LIBDIR MATCHES "^(lib)?$")
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE})  # under /usr/local, too, Debian looks there
endif()
include(GNUInstallDirs)
set(SCREE_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/scree)

# scree_component(NAME TARGETS…): the target NAME_component builds what the component installs.
function(scree_component NAME)
  add_custom_target(${NAME}_component DEPENDS ${ARGN})
endfunction()

function(scree_install_programs COMPONENT)
  set(BUILT)
  foreach(PROGRAM IN LISTS ARGN)
    if(TARGET ${PROGRAM})
      install(TARGETS ${PROGRAM} RUNTIME COMPONENT ${COMPONENT})
      list(APPEND BUILT ${PROGRAM})
    endif()
  endforeach()
  scree_component(${COMPONENT} ${BUILT})
endfunction()

scree_install_programs(server scree-server scree-admin scree-token scree-world scree-replay)
scree_install_programs(tools scree-rules scree-import scree-export scree-place scree-bot scree-scene scree-render)
scree_install_programs(viewer scree-viewer)
if(TARGET scree-server)
  # Where the server looks for games and the page: beside its program (web_folder.h).
  install(DIRECTORY games DESTINATION ${CMAKE_INSTALL_DATADIR}/scree COMPONENT server)
  install(DIRECTORY build/web/dist/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scree/web COMPONENT web OPTIONAL)
endif()

if(TARGET scree_client_shared)
  install(
    TARGETS scree_client_shared
    EXPORT screeClient
    LIBRARY COMPONENT client NAMELINK_COMPONENT dev
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY client/library/include/scree DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
  install(EXPORT screeClient NAMESPACE scree:: FILE screeClientTargets.cmake DESTINATION ${SCREE_CMAKE_FOLDER} COMPONENT dev)
  file(RELATIVE_PATH SCREE_UP /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)  # from there to the prefix
  configure_file(cmake/scree-client.pc.in scree-client.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/scree-client.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
  scree_component(client scree_client_shared)
  scree_component(dev scree_client_shared)
endif()

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/screeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/screeConfig.cmake ${PROJECT_BINARY_DIR}/screeConfigVersion.cmake DESTINATION ${SCREE_CMAKE_FOLDER} COMPONENT dev)

# Hosts in C++ include headers as we do, from one folder; proto's own headers know no generated ones.
install(TARGETS ${EXPORTED} EXPORT screeCpp ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/scree COMPONENT cpp)
install(EXPORT screeCpp NAMESPACE scree:: FILE screeTargets.cmake DESTINATION ${SCREE_CMAKE_FOLDER} COMPONENT cpp)
foreach(FOLDER IN ITEMS shared proto crypto content ground transport auth server client)
  install(DIRECTORY ${FOLDER} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scree-cpp COMPONENT cpp
          FILES_MATCHING PATTERN "*.h" PATTERN "programs" EXCLUDE PATTERN "web" EXCLUDE PATTERN "include" EXCLUDE)
endforeach()
scree_component(cpp ${EXPORTED})

if(TARGET scree_python)
  install(TARGETS scree_python LIBRARY DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL)
  install(FILES python/scree.pyi DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL)
  scree_component(python scree_python)
endif()

install(FILES packaging/viewer/scree-viewer.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT viewer)
install(FILES packaging/viewer/scree.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT viewer)
install(FILES client/web/page/mark.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT viewer RENAME scree.svg)
include(${PROJECT_SOURCE_DIR}/cmake/ScreePackages.cmake)
