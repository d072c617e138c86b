# Debian's packages, by CPack from the components of ScreeInstall.cmake. packaging/package.sh calls it, for it makes what
# no compiler does: manual pages, completions, changelogs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scree)
set(CPACK_PACKAGE_CONTACT "The Scree maintainers <maintainers@scree.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # of the one library with a soversion
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 2)  # xz makes the same of any number above 1
set(CPACK_COMPONENTS_ALL)

# scree_package(COMPONENT NAME SECTION SUMMARY WORDS [DEPENDS …] [SUGGESTS …]): a component's package. What package.sh makes
# for it lies in packaging/COMPONENT of the build folder.
function(scree_package COMPONENT NAME SECTION SUMMARY WORDS)
  cmake_parse_arguments(PARSE_ARGV 5 PACKAGE "" "" "DEPENDS;SUGGESTS")
  if(NOT TARGET ${COMPONENT}_component AND NOT COMPONENT STREQUAL web)
    return()
  endif()
  install(DIRECTORY ${PROJECT_BINARY_DIR}/packaging/${COMPONENT}/ DESTINATION . COMPONENT ${COMPONENT} EXCLUDE_FROM_ALL OPTIONAL)
  string(TOUPPER ${COMPONENT} UPPER)
  set(CPACK_DEBIAN_${UPPER}_PACKAGE_NAME ${NAME} PARENT_SCOPE)
  set(CPACK_DEBIAN_${UPPER}_PACKAGE_SECTION ${SECTION} PARENT_SCOPE)
  set(CPACK_DEBIAN_${UPPER}_DESCRIPTION "${SUMMARY}\n${WORDS}" PARENT_SCOPE)
  foreach(KIND IN ITEMS DEPENDS SUGGESTS)
    list(JOIN PACKAGE_${KIND} ", " PACKAGES)
    set(CPACK_DEBIAN_${UPPER}_PACKAGE_${KIND} "${PACKAGES}" PARENT_SCOPE)
  endforeach()
  list(APPEND CPACK_COMPONENTS_ALL ${COMPONENT})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} PARENT_SCOPE)
endfunction()

set(SCREE_WORDS "Scree serves terrain that breaks, falls, comes to rest and is terrain again.")
scree_package(server scree-server net "dedicated server for destructible terrain"
  "${SCREE_WORDS}
This is the server, as a service of systemd for any number of worlds, and
the programs by which its operator asks it, makes tokens, saves worlds and
plays recordings."
  DEPENDS adduser SUGGESTS scree-web scree-tools)
set(CPACK_DEBIAN_SERVER_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/server/postinst
    ${PROJECT_SOURCE_DIR}/packaging/server/prerm ${PROJECT_SOURCE_DIR}/packaging/server/postrm)
scree_package(web scree-web web "page of Scree's servers for browsers"
  "${SCREE_WORDS}
A server that finds this page lets people look at its world, and edit it, in
a browser.")
set(CPACK_DEBIAN_WEB_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_WEB_PACKAGE_SHLIBDEPS OFF)
scree_package(tools scree-tools graphics "programs for makers of Scree's worlds"
  "${SCREE_WORDS}
These import and export grounds, put bodies into worlds, check rules in Lua,
make films of recordings, and try a server by a bot."
  SUGGESTS scree-server lua-check ffmpeg)
scree_package(viewer scree-viewer graphics "viewer of Scree's worlds"
  "${SCREE_WORDS}
This is the window in which people look at worlds, and edit them." DEPENDS libegl1 libgl1)
scree_package(client libscree-client0 libs "client of Scree's servers, shared library"
  "${SCREE_WORDS}
By this library, programs in any language join a server and keep an exact
copy of its world.")
scree_package(dev libscree-client-dev libdevel "client of Scree's servers, for programs that are built"
  "${SCREE_WORDS}
This has the header of the client for programs in C, and its packages for
CMake and pkg-config.")
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
scree_package(cpp libscree-dev libdevel "simulation, server and client of Scree for hosts in C++"
  "${SCREE_WORDS}
This has the static libraries and headers for programs in C++ that run
worlds themselves."
  DEPENDS libasio-dev libblosc-dev libboost-dev libboost-iostreams-dev libbullet-dev libcli11-dev libcurl4-openssl-dev libexpected-dev libfmt-dev
          libglm-dev libimath-dev liblua5.4-dev libnats-dev libopenvdb-dev libpng-dev libprotobuf-dev libre2-dev libspdlog-dev libsqlite3-dev
          libssl-dev libsystemd-dev libtbb-dev libtomlplusplus-dev libutf8proc-dev libwslay-dev libxxhash-dev libzstd-dev
          nlohmann-json3-dev voro++-dev zlib1g-dev)
set(CPACK_DEBIAN_CPP_PACKAGE_SHLIBDEPS OFF)
math(EXPR PYTHON_NEXT "0${Python_VERSION_MINOR} + 1")
scree_package(python python3-scree python "worlds of Scree for Python"
  "${SCREE_WORDS}
By this module, scripts run worlds alone or in batches, read recordings, and
join servers."
  DEPENDS python3-numpy "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})" "python3 (<< ${Python_VERSION_MAJOR}.${PYTHON_NEXT})")

# One version of all that comes from one build; package.sh says which.
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/packaging/same_version.cmake)
include(CPack)
